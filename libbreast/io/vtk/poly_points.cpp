// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/vtk/poly_points.hpp"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPointSet.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>

#include "core/error.hpp"
#include "core/sha256.hpp"
#include "io/vtk/xml_file.hpp"

namespace breast {

void set_points(vtkPointSet* data, const std::vector<Vec3>& points) {
  vtkNew<vtkPoints> list;
  list->SetDataTypeToDouble();
  list->SetNumberOfPoints(vtkIdType(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) list->SetPoint(vtkIdType(i), points[i].data());
  data->SetPoints(list);
}

void set_scalars(vtkPolyData* data, const std::map<std::string, std::vector<double>>& scalars) {
  for (const auto& [name, values] : scalars) {
    if (vtkIdType(values.size()) != data->GetNumberOfPoints()) {
      throw failed_error("point data ", name, " has ", values.size(), " values for ",
                         data->GetNumberOfPoints(), " points");
    }
    vtkNew<vtkDoubleArray> array;
    array->SetName(name.c_str());
    for (const double value : values) array->InsertNextValue(value);
    data->GetPointData()->AddArray(array);
  }
}

vtkSmartPointer<vtkDoubleArray> vector_array(const std::string& name,
                                             const std::vector<Vec3>& values) {
  auto array = vtkSmartPointer<vtkDoubleArray>::New();
  array->SetName(name.c_str());
  array->SetNumberOfComponents(3);
  for (const Vec3& value : values) array->InsertNextTuple(value.data());
  return array;
}

std::vector<Vec3> vectors_of(vtkDataArray* array, const std::string& where) {
  if (array->GetNumberOfComponents() != 3) {
    throw input_error(where, " has ", array->GetNumberOfComponents(), " components, 3 expected");
  }
  const std::vector<double> values = finite_values(array, where);
  std::vector<Vec3> vectors(values.size() / 3);
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    vectors[i] = Vec3(values[3 * i], values[3 * i + 1], values[3 * i + 2]);
  }
  return vectors;
}

std::vector<Vec3> points_of(vtkPolyData* data, const std::string& where) {
  if (data->GetNumberOfPoints() == 0) return {};
  constexpr double farthest_mm = 1e6;  // beyond it squares overflow and searches find nothing
  std::vector<Vec3> points = vectors_of(data->GetPoints()->GetData(), where + ": Points");
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].cwiseAbs().maxCoeff() <= farthest_mm) continue;
    throw input_error(where, ": point ", i, " is ", points[i].transpose(), " mm, must be within ",
                      farthest_mm);
  }
  return points;
}

std::map<std::string, std::vector<double>> scalars_of(vtkPolyData* data, const std::string& where) {
  std::map<std::string, std::vector<double>> scalars;
  for (int a = 0; a < data->GetPointData()->GetNumberOfArrays(); ++a) {
    vtkDataArray* array = data->GetPointData()->GetArray(a);
    if (array == nullptr || array->GetName() == nullptr) continue;
    const std::string place = where + ": PointData " + array->GetName();
    if (array->GetNumberOfTuples() != data->GetNumberOfPoints()) {
      throw input_error(place, " has ", array->GetNumberOfTuples(), " tuples for ",
                        data->GetNumberOfPoints(), " points");
    }
    if (array->GetNumberOfComponents() == 1)
      scalars[array->GetName()] = finite_values(array, place);
  }
  return scalars;
}

int checked_point(vtkIdType id, vtkPolyData* data, const std::string& where) {
  if (id < 0 || id >= data->GetNumberOfPoints()) {
    throw input_error(where, ": point index ", id, " outside 0..", data->GetNumberOfPoints() - 1);
  }
  return int(id);
}

std::string content_of(vtkPolyData* data) {
  Sha256 hash;
  const auto add = [&hash](vtkDataArray* array) {
    if (array == nullptr) return;
    if (array->GetName() != nullptr) hash.update(std::string_view(array->GetName()));
    const std::vector<double> values = finite_values(array, "content");
    hash.update(values.data(), values.size() * sizeof(double));
  };
  if (data->GetNumberOfPoints() > 0) add(data->GetPoints()->GetData());
  vtkNew<vtkIdList> cell;
  for (vtkCellArray* cells : {data->GetVerts(), data->GetLines(), data->GetPolys()}) {
    for (vtkIdType c = 0; c < cells->GetNumberOfCells(); ++c) {
      cells->GetCellAtId(c, cell);
      const auto count = std::size_t(cell->GetNumberOfIds());
      hash.update(&count, sizeof count);
      hash.update(cell->GetPointer(0), count * sizeof(vtkIdType));
    }
  }
  for (int a = 0; a < data->GetPointData()->GetNumberOfArrays(); ++a) {
    add(data->GetPointData()->GetArray(a));
  }
  return hash.hex();
}

}  // namespace breast
