// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/surface_file.hpp"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include "core/error.hpp"
#include "io/vtk/poly_points.hpp"
#include "io/vtk/xml_file.hpp"

namespace breast {

namespace {

constexpr const char* surface_schema = "surface/1";

// Quads and triangle strips of other programs would need a choice of diagonal: refused by name.
std::vector<std::array<int, 3>> triangles_of(vtkPolyData* data, const std::string& where) {
  if (data->GetNumberOfStrips() > 0) {
    throw input_error(where, ": has triangle strips; triangulate the surface first");
  }
  std::vector<std::array<int, 3>> triangles;
  vtkNew<vtkIdList> corners;
  vtkCellArray* polygons = data->GetPolys();
  for (vtkIdType c = 0; c < polygons->GetNumberOfCells(); ++c) {
    polygons->GetCellAtId(c, corners);
    if (corners->GetNumberOfIds() != 3) {
      throw input_error(where, ": polygon ", c, " has ", corners->GetNumberOfIds(),
                        " corners, 3 expected; triangulate the surface first");
    }
    std::array<int, 3> triangle{};
    for (int k = 0; k < 3; ++k) {
      triangle[k] =
          checked_point(corners->GetId(k), data, where + ": polygon " + std::to_string(c));
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

TriMesh parse_surface(const std::filesystem::path& file) {
  const std::string where = file.string();
  const auto data = read_poly_data(file);
  check_schema(data->GetFieldData(), surface_schema, false, where);
  TriMesh surface;
  surface.points = points_of(data, where);
  if (surface.points.empty()) throw input_error(where, ": has no points");
  surface.triangles = triangles_of(data, where);
  surface.point_data = scalars_of(data, where);
  if (vtkDataArray* normals = data->GetPointData()->GetArray("Normals")) {
    surface.normals = vectors_of(normals, where + ": PointData Normals");
  }
  surface.history = history_field(data->GetFieldData(), where);
  surface.content_sha256 = content_of(data);
  return surface;
}

}  // namespace

TriMesh read_surface(const std::filesystem::path& file) {
  return read_guarded(file, [&] { return parse_surface(file); });
}

void write_surface(const std::filesystem::path& file, const TriMesh& surface) {
  vtkNew<vtkPolyData> data;
  set_points(data, surface.points);
  vtkNew<vtkCellArray> cells;
  if (surface.triangles.empty()) {
    for (std::size_t i = 0; i < surface.points.size(); ++i) {
      const auto point = vtkIdType(i);
      cells->InsertNextCell(1, &point);
    }
    data->SetVerts(cells);
  } else {
    for (const auto& triangle : surface.triangles) {
      const vtkIdType corners[3] = {triangle[0], triangle[1], triangle[2]};
      cells->InsertNextCell(3, corners);
    }
    data->SetPolys(cells);
  }
  set_scalars(data, surface.point_data);
  if (!surface.normals.empty()) {
    const auto normals = vector_array("Normals", surface.normals);
    data->GetPointData()->SetNormals(normals);
  }
  add_text(data->GetFieldData(), "schema", surface_schema);
  add_text(data->GetFieldData(), "units", "mm");
  add_space(data->GetFieldData());
  add_history(data->GetFieldData(), surface.history);
  write_xml(file, data);
}

}  // namespace breast
