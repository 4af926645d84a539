// SPDX-License-Identifier: GPL-3.0-or-later
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <numeric>

#include "core/error.hpp"
#include "io/surface_file.hpp"
#include "io/vtk/poly_points.hpp"
#include "io/vtk/xml_file.hpp"

namespace breast {

namespace {
constexpr const char* curves_schema = "curves/1";

void append_cells(vtkPolyData* data, vtkCellArray* cells, const std::string& where,
                  PolyLines& lines) {
  vtkNew<vtkIdList> nodes;
  for (vtkIdType c = 0; c < cells->GetNumberOfCells(); ++c) {
    cells->GetCellAtId(c, nodes);
    std::vector<int> line;
    for (vtkIdType k = 0; k < nodes->GetNumberOfIds(); ++k) {
      line.push_back(checked_point(nodes->GetId(k), data, where + ": line " + std::to_string(c)));
    }
    if (line.empty()) throw input_error(where, ": line ", c, " has no points");
    lines.lines.push_back(line);
  }
}

// VTK has no line of one point: such a marker is a vertex, and VTK numbers vertices before lines.
std::vector<std::size_t> markers_first(const PolyLines& lines) {
  std::vector<std::size_t> order(lines.lines.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t i) { return lines.lines[i].size() == 1; });
  return order;
}

PolyLines parse_polylines(const std::filesystem::path& file) {
  const std::string where = file.string();
  const auto data = read_poly_data(file);
  check_schema(data->GetFieldData(), curves_schema, false, where);
  PolyLines lines;
  lines.points = points_of(data, where);
  append_cells(data, data->GetVerts(), where, lines);
  append_cells(data, data->GetLines(), where, lines);
  if (lines.lines.empty()) throw input_error(where, ": has no lines");
  auto* names = vtkStringArray::SafeDownCast(data->GetCellData()->GetAbstractArray("name"));
  if (names == nullptr) throw input_error(where, ": CellData name is missing, or no text");
  if (names->GetNumberOfValues() != vtkIdType(lines.lines.size())) {
    throw input_error(where, ": CellData name has ", names->GetNumberOfValues(), " texts for ",
                      lines.lines.size(), " lines");
  }
  for (vtkIdType c = 0; c < names->GetNumberOfValues(); ++c) {
    lines.line_names.push_back(names->GetValue(c));
  }
  lines.point_data = scalars_of(data, where);
  for (int a = 0; a < data->GetPointData()->GetNumberOfArrays(); ++a) {
    vtkDataArray* array = data->GetPointData()->GetArray(a);
    if (array == nullptr || array->GetName() == nullptr || array->GetNumberOfComponents() != 3) {
      continue;
    }
    lines.point_vectors[array->GetName()] =
        vectors_of(array, where + ": PointData " + array->GetName());
  }
  lines.history = history_field(data->GetFieldData(), where);
  lines.content_sha256 = content_of(data);
  return lines;
}

}  // namespace

PolyLines read_polylines(const std::filesystem::path& file) {
  return read_guarded(file, [&] { return parse_polylines(file); });
}

void write_polylines(const std::filesystem::path& file, const PolyLines& lines) {
  vtkNew<vtkPolyData> data;
  set_points(data, lines.points);
  vtkNew<vtkCellArray> vertices, cells;
  const std::vector<std::size_t> order = markers_first(lines);
  for (const std::size_t i : order) {
    const std::vector<int>& line = lines.lines[i];
    vtkCellArray* list = line.size() == 1 ? vertices : cells;
    list->InsertNextCell(int(line.size()));
    for (const int point : line) list->InsertCellPoint(point);
  }
  data->SetVerts(vertices);
  data->SetLines(cells);
  if (!lines.line_names.empty()) {
    vtkNew<vtkStringArray> names;
    names->SetName("name");
    for (const std::size_t i : order) names->InsertNextValue(lines.line_names[i]);
    data->GetCellData()->AddArray(names);
  }
  set_scalars(data, lines.point_data);
  for (const auto& [name, values] : lines.point_vectors) {
    data->GetPointData()->AddArray(vector_array(name, values));
  }
  add_text(data->GetFieldData(), "schema", curves_schema);
  add_text(data->GetFieldData(), "units", "mm");
  add_space(data->GetFieldData());
  add_history(data->GetFieldData(), lines.history);
  write_xml(file, data);
}

}  // namespace breast
