// SPDX-License-Identifier: GPL-3.0-or-later
// A layer of muscle behind the breast, between the chest wall that the scan shows and the ribs.
#pragma once

#include <string>

#include "image/label_volume.hpp"
#include "mesh/hex_mesh.hpp"
#include "surface/level_surface.hpp"

namespace breast {

/// Where the labels do not show the back of the muscle: a stated value, mm.
inline constexpr double usual_muscle_mm = 8;

struct MuscleThickness {
  double mm = usual_muscle_mm;
  bool seen = false;  ///< in the labels; otherwise mm is the usual value
};
/// Median length of the run of muscle from the chest wall towards the ribs, where something else lies
/// behind it within 30 mm; at least half of the wall's nodes must show that.
MuscleThickness measured_muscle_thickness(const LabelVolume& labels, const HexMesh& mesh);

/// mm of "MM"; "measured" is for measured_muscle_thickness. Throws Error (input) for anything else than a
/// number from 0 to 30.
double parse_muscle_thickness(const std::string& text);

/// Adds one layer of muscle elements of `thickness` mm behind the chest-wall faces. Its back becomes
/// the chest wall of the mesh, its rim part of the cut, and geometry->thorax the surface of the ribs,
/// on which the body now slides. The gradient of `wall` points the way, or of the geometry's thorax,
/// or the nodes' own normals. Throws Error (input) where the layer folds.
void add_muscle_layer(double thickness, HexMesh& mesh, const LevelSurface* wall = nullptr);

}  // namespace breast
