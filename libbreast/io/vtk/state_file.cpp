// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/state_file.hpp"

#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "io/vtk/poly_points.hpp"
#include "io/vtk/xml_file.hpp"

namespace breast {

namespace {

std::vector<Vec3> from(const std::vector<Vec3>& shape, const std::vector<Vec3>& points) {
  std::vector<Vec3> displacement(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) displacement[n] = points[n] - shape[n];
  return displacement;
}

/// One value per cell or point, if there are any.
void add_each(vtkFieldData* data, const char* name, const std::vector<double>& values) {
  if (values.empty()) return;
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  for (const double value : values) array->InsertNextValue(value);
  data->AddArray(array);
}

}  // namespace

void write_state(const std::filesystem::path& file, const HexMesh& mesh) {
  vtkNew<vtkUnstructuredGrid> grid;
  set_points(grid, mesh.points);
  vtkNew<vtkUnsignedCharArray> tissue;
  tissue->SetName("tissue");
  const int type = mesh.order == 1 ? VTK_HEXAHEDRON : VTK_TRIQUADRATIC_HEXAHEDRON;
  std::vector<vtkIdType> nodes(std::size_t(mesh.nodes_per_element()));
  for (int e = 0; e < mesh.elements(); ++e) {
    std::copy(mesh.element(e), mesh.element(e) + mesh.nodes_per_element(), nodes.begin());
    grid->InsertNextCell(type, vtkIdType(nodes.size()), nodes.data());
    tissue->InsertNextValue(static_cast<unsigned char>(mesh.tissue[std::size_t(e)]));
  }
  grid->GetCellData()->AddArray(tissue);
  add_each(grid->GetCellData(), "det_F", mesh.det_F);
  add_each(grid->GetCellData(), "pressure", mesh.pressure);
  add_each(grid->GetPointData(), "contact_pressure", mesh.contact_pressure);
  grid->GetPointData()->AddArray(
      vector_array("displacement_from_scan", from(mesh.imaged, mesh.points)));
  if (!mesh.reference.empty()) {
    grid->GetPointData()->AddArray(
        vector_array("displacement_from_stress_free", from(mesh.reference, mesh.points)));
  }
  add_text(grid->GetFieldData(), "schema", "state/1");
  add_text(grid->GetFieldData(), "units", "mm");
  add_space(grid->GetFieldData());
  add_history(grid->GetFieldData(), mesh.history);
  write_xml(file, grid);
}

}  // namespace breast
