// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of points and point data between libbreast structures and vtkPolyData.
#pragma once

#include <vtkSmartPointer.h>
#include <vtkType.h>

#include <map>
#include <string>
#include <vector>

#include "core/types.hpp"

class vtkDataArray;
class vtkDoubleArray;
class vtkPointSet;
class vtkPolyData;

namespace breast {

void set_points(vtkPointSet* data, const std::vector<Vec3>& points);
void set_scalars(vtkPolyData* data, const std::map<std::string, std::vector<double>>& scalars);
vtkSmartPointer<vtkDoubleArray> vector_array(const std::string& name,
                                             const std::vector<Vec3>& values);

/// All throw Error (input), beginning with `where`, for non-finite values and wrong shapes.
std::vector<Vec3> points_of(vtkPolyData* data, const std::string& where);
std::vector<Vec3> vectors_of(vtkDataArray* array, const std::string& where);
std::map<std::string, std::vector<double>> scalars_of(vtkPolyData* data, const std::string& where);
/// Point index as int, checked against the number of points.
int checked_point(vtkIdType id, vtkPolyData* data, const std::string& where);
/// SHA-256 of points, cells and point data (not of the history).
std::string content_of(vtkPolyData* data);

}  // namespace breast
