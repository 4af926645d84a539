// SPDX-License-Identifier: GPL-3.0-or-later
// A layer of muscle elements behind the breast, between the chest wall of the scan and the ribs.
#pragma once

#include <string>

#include "image/label_volume.hpp"
#include "mesh/hex_mesh.hpp"
#include "surface/level_surface.hpp"

namespace breast {

/// Thickness that is assumed if the labels do not show the back of the muscle, mm.
inline constexpr double usual_muscle_mm = 8;

struct MuscleThickness {
  double mm = usual_muscle_mm;
  bool seen = false;  ///< whether it was measured in the labels; otherwise mm is the assumed value
};
/// Median length of the run of muscle from the chest wall towards the ribs, over nodes of the wall
/// where other tissue lies behind it within 30 mm; at least half of the nodes must be such.
MuscleThickness measured_muscle_thickness(const LabelVolume& labels, const HexMesh& mesh);

/// Parses "MM" as a thickness in mm ("measured" is handled by measured_muscle_thickness). Throws
/// Error (input) for anything but a number from 0 to 30.
double parse_muscle_thickness(const std::string& text);

/// Adds one layer of muscle elements of `thickness` mm behind the chest-wall faces. Its back
/// becomes the chest wall of the mesh, its rim part of the cut, and geometry->thorax the surface of
/// the ribs, on which the body then slides. The direction of the layer is the gradient of `wall`,
/// otherwise that of the geometry's thorax, otherwise the nodes' own normals. Throws Error (input)
/// if the layer folds.
void add_muscle_layer(double thickness, HexMesh& mesh, const LevelSurface* wall = nullptr);

}  // namespace breast
