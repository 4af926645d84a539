// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/mammogram_file.hpp"

#include <vtkFloatArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnsignedShortArray.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/sha256.hpp"
#include "io/vtk/xml_file.hpp"
#include "projection/display.hpp"

namespace breast {

namespace {

constexpr const char* mammogram_schema = "mammogram/1";

std::vector<double> as_list(const Vec3& v) {
  return {v.x(), v.y(), v.z()};
}

Vec3 vector_field(vtkFieldData* fields, const std::string& name, const std::string& where) {
  const std::vector<double> v = number_field(fields, name, 3, where);
  return {v[0], v[1], v[2]};
}

template <class Array, class Value>
void add_image(vtkImageData* data, const std::string& name, const std::vector<Value>& values) {
  if (vtkIdType(values.size()) != data->GetNumberOfPoints()) {
    throw failed_error("mammogram array ", name, " has ", values.size(), " values for ",
                       data->GetNumberOfPoints(), " pixels");
  }
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfValues(vtkIdType(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  data->GetPointData()->AddArray(array);
}

std::vector<float> image_array(vtkImageData* data, const std::string& name,
                               const std::string& where) {
  vtkDataArray* array = data->GetPointData()->GetArray(name.c_str());
  const std::string place = where + ": PointData " + name;
  if (array == nullptr) throw input_error(place, " is missing; project-mammogram writes it");
  if (array->GetNumberOfComponents() != 1 ||
      array->GetNumberOfTuples() != data->GetNumberOfPoints()) {
    throw input_error(place, " is not one value per pixel");
  }
  const std::vector<double> values = finite_values(array, place);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] < 0) throw input_error(place, ", pixel ", i, ": ", values[i], " is negative");
  }
  return {values.begin(), values.end()};
}

void check_pose(const ViewPose& pose, const std::string& where) {
  Mat3 axes;
  axes << pose.e_u, pose.e_v, pose.n;
  if (!((axes.transpose() * axes - Mat3::Identity()).norm() < 1e-6)) {
    throw input_error(where, ": FieldData n, e_u, e_v are not orthonormal");
  }
}

/// As shown, but in the order of the other arrays: a right breast is hung turned by half a circle.
std::vector<std::uint16_t> grey_of(const Mammogram& image) {
  std::vector<std::uint16_t> grey = hang(image).grey;
  if (image.side == Side::right) std::ranges::reverse(grey);
  return grey;
}

std::string content_of_image(const Mammogram& image) {
  Sha256 hash;
  for (const Vec3& v : {image.pose.n, image.pose.e_u, image.pose.e_v, image.pose.origin}) {
    hash.update(v.data(), sizeof(double) * 3);
  }
  const double numbers[] = {double(image.width), double(image.height), image.pixel,
                            image.plate_edge_u,  image.pose.angle_deg, image.pose.source_distance,
                            image.pose.source_v};
  hash.update(numbers, sizeof numbers);
  hash.update(view_name(image.view) + "/" + std::string(side_name(image.side)) + "/" +
              image.energy);
  for (const auto* array : {&image.path, &image.thickness, &image.fibroglandular}) {
    hash.update(array->data(), array->size() * sizeof(float));
  }
  hash.update(image.through_back.data(), image.through_back.size());
  return hash.hex();
}

Mammogram parse_mammogram(const std::filesystem::path& file) {
  const std::string where = file.string();
  const auto data = read_image_data(file);
  vtkFieldData* fields = data->GetFieldData();
  check_schema(fields, mammogram_schema, true, where);
  Mammogram image;
  int size[3];
  data->GetDimensions(size);
  if (size[0] < 1 || size[1] < 1 || size[2] != 1) {
    throw input_error(where, ": ", size[0], " x ", size[1], " x ", size[2],
                      " points; one slice is expected");
  }
  image.width = size[0];
  image.height = size[1];
  image.pixel = number_field(fields, "pixel", 1, where)[0];
  if (!(image.pixel > 0) || !(std::abs(image.pixel - data->GetSpacing()[0]) < 1e-9)) {
    throw input_error(where, ": FieldData pixel ", image.pixel,
                      " mm does not agree with the spacing ", data->GetSpacing()[0], " mm");
  }
  image.pose.n = vector_field(fields, "n", where);
  image.pose.e_u = vector_field(fields, "e_u", where);
  image.pose.e_v = vector_field(fields, "e_v", where);
  image.pose.origin = vector_field(fields, "origin", where);
  check_pose(image.pose, where);
  image.pose.angle_deg = number_field(fields, "angle", 1, where)[0];
  image.pose.source_distance = number_field(fields, "source_distance", 1, where)[0];
  image.pose.source_v = number_field(fields, "source_v", 1, where)[0];
  image.plate_edge_u = number_field(fields, "plate_edge_u", 1, where)[0];
  const std::string view = text_field(fields, "view", where);
  const std::optional<View> known = view_from_name(view);
  if (!known) throw input_error(where, ": FieldData view '", view, "' is unknown: CC, MLO or ML");
  image.view = *known;
  image.side = side_from_name(text_field(fields, "side", where));
  image.energy = text_field(fields, "energy", where);
  image.path = image_array(data, "path", where);
  image.thickness = image_array(data, "thickness", where);
  image.fibroglandular = image_array(data, "fibroglandular", where);
  for (const float flag : image_array(data, "through_back", where)) {
    image.through_back.push_back(flag != 0 ? 1 : 0);
  }
  image.history = history_field(fields, where);
  image.content_sha256 = content_of_image(image);
  return image;
}

}  // namespace

Mammogram read_mammogram(const std::filesystem::path& file) {
  return read_guarded(file, [&] { return parse_mammogram(file); });
}

void write_mammogram(const std::filesystem::path& file, const Mammogram& image) {
  vtkNew<vtkImageData> data;
  data->SetDimensions(image.width, image.height, 1);
  data->SetSpacing(image.pixel, image.pixel, image.pixel);
  data->SetOrigin(0, 0, 0);
  add_image<vtkFloatArray>(data, "path", image.path);
  add_image<vtkFloatArray>(data, "thickness", image.thickness);
  add_image<vtkFloatArray>(data, "fibroglandular", image.fibroglandular);
  add_image<vtkUnsignedCharArray>(data, "through_back", image.through_back);
  add_image<vtkUnsignedShortArray>(data, "grey", grey_of(image));
  vtkFieldData* fields = data->GetFieldData();
  add_text(fields, "schema", mammogram_schema);
  add_numbers(fields, "n", as_list(image.pose.n));
  add_numbers(fields, "e_u", as_list(image.pose.e_u));
  add_numbers(fields, "e_v", as_list(image.pose.e_v));
  add_numbers(fields, "origin", as_list(image.pose.origin));
  add_numbers(fields, "pixel", {image.pixel});
  add_numbers(fields, "plate_edge_u", {image.plate_edge_u});
  add_numbers(fields, "angle", {image.pose.angle_deg});
  add_numbers(fields, "source_distance", {image.pose.source_distance});
  add_numbers(fields, "source_v", {image.pose.source_v});
  add_text(fields, "view", view_name(image.view));
  add_text(fields, "side", std::string(side_name(image.side)));
  add_text(fields, "energy", image.energy);
  add_history(fields, image.history);
  write_xml(file, data);
}

}  // namespace breast
