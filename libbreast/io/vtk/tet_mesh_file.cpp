// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/tet_mesh_file.hpp"

#include <vtkCellData.h>
#include <vtkNew.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>

#include "io/vtk/poly_points.hpp"
#include "io/vtk/xml_file.hpp"

namespace breast {

void write_tet_mesh(const std::filesystem::path& file, const TetMesh& mesh) {
  constexpr unsigned char no_part = 255;
  vtkNew<vtkUnstructuredGrid> grid;
  set_points(grid, mesh.points);
  vtkNew<vtkUnsignedCharArray> tissue, part;
  tissue->SetName("tissue");
  part->SetName("part");
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const auto& c = mesh.tetrahedra[t];
    const vtkIdType corners[4] = {c[0], c[1], c[2], c[3]};
    grid->InsertNextCell(VTK_TETRA, 4, corners);
    tissue->InsertNextValue(static_cast<unsigned char>(mesh.tissue[t]));
    part->InsertNextValue(no_part);
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto& c = mesh.triangles[t];
    const vtkIdType corners[3] = {c[0], c[2], c[1]};  // outwards, as other solvers expect
    grid->InsertNextCell(VTK_TRIANGLE, 3, corners);
    tissue->InsertNextValue(static_cast<unsigned char>(Tissue::air));
    part->InsertNextValue(mesh.part[t]);
  }
  grid->GetCellData()->AddArray(tissue);
  grid->GetCellData()->AddArray(part);
  add_text(grid->GetFieldData(), "schema", "tetrahedra/1");
  add_text(grid->GetFieldData(), "units", "mm");
  add_space(grid->GetFieldData());
  add_history(grid->GetFieldData(), mesh.history);
  write_xml(file, grid);
}

}  // namespace breast
