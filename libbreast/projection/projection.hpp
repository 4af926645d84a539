// SPDX-License-Identifier: GPL-3.0-or-later
// Simulation of a mammogram: tissue along every ray, sampled in the MR scan from which the mesh was
// made.
#pragma once

#include "core/progress.hpp"
#include "image/label_volume.hpp"
#include "mesh/hex_mesh.hpp"
#include "projection/attenuation.hpp"
#include "projection/framing.hpp"
#include "projection/mammogram.hpp"

namespace breast {

struct ProjectionOptions {
  double pixel = 0.25;  ///< mm
  Beam beam = Beam::parallel;
  Energy energy{};
  /// Labels in which the tissue at points of the ray, mapped to the imaged shape, is looked up, so
  /// that the image has the detail of the scan; null: one tissue per element, as in the paper's
  /// Fig. 6.
  const LabelVolume* labels = nullptr;
};

struct ProjectionReport {
  double mesh_volume = 0;    ///< mm³ of the compressed mesh
  double imaged_volume = 0;  ///< mm³ = Σ thickness · pixel area (parallel beam)
  TissuePath volumes;        ///< mm³ per tissue in the image
  double unlabelled =
      0;  ///< part of the path in voxels labelled air, muscle or other (taken as fat)
  int muscle_columns = 0;  ///< pixels that show muscle
  int back_columns =
      0;  ///< pixels with a column that leaves through the back or lies behind one; not included in the volumes
};

/// Throws Error (input) for a mesh without compression record or an image
/// beyond 100 million pixels.
Mammogram project_mammogram(const HexMesh& compressed, const ProjectionOptions& options,
                            ProjectionReport* report = nullptr, Progress& progress = no_progress());

}  // namespace breast
