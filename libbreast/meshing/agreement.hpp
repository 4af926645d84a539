// SPDX-License-Identifier: GPL-3.0-or-later
// Check that a geometry and labels describe the same body: distances between their surfaces.
#pragma once

#include <optional>
#include <string>

#include "core/distances.hpp"
#include "image/label_volume.hpp"
#include "meshing/body_mesh.hpp"

namespace breast {

/// Distances (mm) of a sheet inside the rim from the same surface of the labels.
struct SurfaceAgreement {
  Distances distance;
  Vec3 worst{0, 0, 0};  ///< patient mm: where the distance is largest
  double seen = 0;      ///< part of the sheet's area at which the labels show the surface
};

struct Agreement {
  SurfaceAgreement skin, wall;
};

/// Follows the normals of a polar raster of both sheets to the border between air and body, and to the
/// front of the labels' muscle. What half a voxel explains does not count. Where the labels' chest wall
/// is unsure (confidence below one half) it is no measure of the sheet.
Agreement agreement_of(const BreastGeometry& geometry, const LabelVolume& labels);

/// One sentence if skin or wall of the geometry lie elsewhere than those of the labels: farther than
/// 2 mm in the mean, or 5 mm over more than 5 % of the area. It names the surface and the place of the
/// largest distance.
std::optional<std::string> mismatch(const Agreement& agreement);

/// A warning if the mesh's flat faces lose more than 2 % of the volume between the sheets.
std::optional<std::string> too_coarse(const BodyMeshReport& body);

}  // namespace breast
