// SPDX-License-Identifier: GPL-3.0-or-later
// Thickness of the skin, from the command line or the scan, and its assignment to the mesh.
#pragma once

#include <string>

#include "image/label_volume.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// Parses a thickness in mm from 0 (no skin) to 10. Throws Error (input).
double parse_skin_thickness(const std::string& text);

/// Thickness measured by the segmentation; throws Error (input) if neither file contains one.
double measured_skin_thickness(const LabelVolume& labels, const BreastGeometry& geometry);

/// Sets a membrane of uniform thickness on every skin face (cut faces have none); 0 removes the
/// skin.
void set_membrane_skin(double thickness, HexMesh& mesh);

}  // namespace breast
