// SPDX-License-Identifier: GPL-3.0-or-later
// Pose and extent of the mammogram of a compressed breast.
#pragma once

#include "mesh/hex_mesh.hpp"
#include "projection/mammogram.hpp"

namespace breast {

enum class Beam { parallel, cone };
inline constexpr double source_distance_mm = 650;  ///< source to detector, cone beam

/// Detector pose and image extent. They follow only from the mesh and its compression record, not
/// from the pixel size, so that every tool finds the same (u,v). The posterior edge u = 0 is the
/// most anterior point of the chest-wall and cut surfaces: as in the paper, no column of the image
/// then leaves the mesh through its back. Landmarks are not considered: an X-ray unit does not know
/// where the tumour is, and an image enlarged to show it would hide that it may be missed. The
/// detector plane is that of its plate.
struct ImageFrame {
  ViewPose pose;
  View view = View::cc;
  double width = 0, height = 0;  ///< mm along u and v
  double plate_edge_u = 0;       ///< mm, where the plates' flats begin
};

/// Computes the framing. Throws Error (input) if the mesh has no compression record or lies
/// completely behind u = 0.
ImageFrame image_frame(const HexMesh& compressed, Beam beam = Beam::parallel);

}  // namespace breast
