#include "meshing/skin.hpp"

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

double parse_skin_thickness(const std::string& text) {
  const double thickness = parse_number(text, "--skin");
  if (!(thickness >= 0 && thickness <= 10)) {
    throw input_error("--skin ", text, " mm: must be from 0 (none) to 10, or 'measured'");
  }
  return thickness;
}

double measured_skin_thickness(const LabelVolume& labels, const BreastGeometry& geometry) {
  const double thickness =
      labels.skin_thickness > 0 ? labels.skin_thickness : geometry.skin_thickness;
  if (!(thickness > 0)) {
    throw input_error(
        "--skin measured: neither labels nor geometry carry a measured thickness; give "
        "millimetres (breast CT: 1.45)");
  }
  return thickness;
}

void set_membrane_skin(double thickness, HexMesh& mesh) {
  mesh.skin_model = thickness > 0 ? SkinModel::membrane : SkinModel::none;
  mesh.skin_thickness.clear();
  if (thickness > 0) mesh.skin_thickness.assign(mesh.skin_faces.size(), thickness);
}

}  // namespace breast
