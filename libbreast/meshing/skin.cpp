// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/skin.hpp"

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

double parse_skin_thickness(const std::string& text) {
  const double thickness = parse_number(text, "--skin");
  constexpr double least = 0.1, most = 10;  // mm; skin of the breast is 0.5 to 3 mm thick
  if (thickness == 0 || (thickness >= least && thickness <= most)) return thickness;
  std::string meant;
  for (const double factor : {1000.0, 0.001}) {  // given in metres, in micrometres
    const double other = factor * thickness;
    if (other >= least && other <= most) meant = "; did you mean " + format_number(other) + "?";
  }
  throw input_error("--skin ", text, " mm: must be 0 (none), from 0.1 to 10, or 'measured'", meant);
}

double measured_skin_thickness(const LabelVolume& labels, const BreastGeometry& geometry) {
  const double thickness =
      labels.skin_thickness > 0 ? labels.skin_thickness : geometry.skin_thickness;
  if (!(thickness > 0)) {
    throw input_error(
        "--skin measured: neither the labels nor the geometry have a measured thickness; give "
        "millimetres (1.45 in breast CT)");
  }
  return thickness;
}

void set_membrane_skin(double thickness, HexMesh& mesh) {
  mesh.skin_model = thickness > 0 ? SkinModel::membrane : SkinModel::none;
  mesh.skin_thickness.clear();
  if (thickness > 0) mesh.skin_thickness.assign(mesh.skin_faces.size(), thickness);
}

}  // namespace breast
