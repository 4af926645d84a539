// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/label_file.hpp"

#include "io/hdf5/vtkhdf.hpp"

namespace breast {

namespace {

constexpr const char* maker = "segment";

std::vector<std::size_t> volume_shape(const Grid& grid) {
  return {std::size_t(grid.size[2]), std::size_t(grid.size[1]), std::size_t(grid.size[0])};
}

std::string voxel(const Grid& grid, std::size_t flat) {
  const std::size_t ni = std::size_t(grid.size[0]), nj = std::size_t(grid.size[1]);
  return message("[", flat / (ni * nj), ",", flat / ni % nj, ",", flat % ni, "]");
}

void check_fraction(const Floats& values, const std::string& name, const Grid& grid,
                    const Complaint& complain) {
  if (values.size() != grid.voxels()) {
    throw complain("dataset ", name, " has ", values.size(), " voxels, must be ", grid.voxels());
  }
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (!(values[v] >= 0 && values[v] <= 1)) {
      throw complain("dataset ", name, voxel(grid, v), " is ", values[v], ", must be 0 to 1");
    }
  }
}

void check_labels(const LabelVolume& labels, const Complaint& complain) {
  check_grid(labels.grid, complain);
  const std::string tissue = "/VTKHDF/PointData/tissue";
  if (labels.tissue.size() != labels.grid.voxels()) {
    throw complain("dataset ", tissue, " has ", labels.tissue.size(), " voxels, must be ",
                   labels.grid.voxels());
  }
  for (std::size_t v = 0; v < labels.tissue.size(); ++v) {
    if (labels.tissue[v] >= n_tissues) {
      throw complain("dataset ", tissue, voxel(labels.grid, v), " is ", int(labels.tissue[v]),
                     ", must be 0 to ", n_tissues - 1);
    }
  }
  check_fraction(labels.fibroglandular_fraction, "/VTKHDF/PointData/fibroglandular_fraction",
                 labels.grid, complain);
  check_fraction(labels.chest_wall_confidence, "/VTKHDF/PointData/chest_wall_confidence",
                 labels.grid, complain);
  if (labels.midline_mm && !(std::abs(*labels.midline_mm) <= Fields::farthest_mm)) {
    throw complain("attribute /breast@midline is ", *labels.midline_mm, " mm, must be within ",
                   Fields::farthest_mm);
  }
  if (!(labels.skin_thickness >= 0)) {
    throw complain("attribute /breast/skin@measured_thickness is ", labels.skin_thickness,
                   ", must be 0 or more");
  }
}

bool get_flag(Fields& fields, const std::string& path) {
  const std::int64_t flag = fields.integer(path);
  if (flag != 0 && flag != 1) {
    throw fields.complain()("attribute ", path, " is ", flag, ", must be 0 or 1");
  }
  return flag == 1;
}

}  // namespace

LabelVolume read_labels(const std::filesystem::path& file) {
  Document document = load_document(file, "labels/1", maker);
  LabelVolume labels;
  labels.content_sha256 = content_sha256(document);
  const Complaint complain{ErrorKind::input, file.string(), message("; make it with ", maker)};
  Fields fields(document, complain);
  const FileHeader header = get_header(fields);
  labels.side = header.side;
  labels.history = header.history;
  labels.grid = get_image_grid(fields);
  const auto shape = volume_shape(labels.grid);
  labels.tissue = fields.bytes("/VTKHDF/PointData/tissue", shape);
  labels.fibroglandular_fraction =
      fields.floats("/VTKHDF/PointData/fibroglandular_fraction", shape);
  labels.chest_wall_confidence = fields.floats("/VTKHDF/PointData/chest_wall_confidence", shape);
  labels.skin_thickness = fields.number("/breast/skin@measured_thickness");
  const double midline_mm = fields.number("/breast@midline");
  if (get_flag(fields, "/breast@midline_known")) labels.midline_mm = midline_mm;
  const Texts names = fields.texts("/breast/landmarks/name", {Fields::any});
  const std::vector<Vec3> points = fields.places("/breast/landmarks/imaged", names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    fields.check_name("/breast/landmarks/name", i, names[i]);
    if (!labels.landmarks.emplace(names[i], points[i]).second) {
      throw complain("dataset /breast/landmarks/name[", i, "] repeats '", names[i], "'");
    }
  }
  check_labels(labels, complain);
  return labels;
}

void write_labels(const std::filesystem::path& file, const LabelVolume& labels) {
  LabelVolume whole = labels;
  const std::size_t n = whole.grid.voxels();
  if (whole.fibroglandular_fraction.empty()) whole.fibroglandular_fraction.assign(n, 0);
  if (whole.chest_wall_confidence.empty()) whole.chest_wall_confidence.assign(n, 0);
  check_labels(whole, {ErrorKind::failed, file.string(), ""});
  Document document;
  put_header(document, {"labels/1", whole.side, whole.history});
  put_image_grid(document, whole.grid);
  const auto shape = volume_shape(whole.grid);
  auto& sets = document.datasets;
  sets["/VTKHDF/PointData/tissue"] = reshaped(array_of(std::move(whole.tissue)), shape);
  sets["/VTKHDF/PointData/fibroglandular_fraction"] =
      reshaped(array_of(std::move(whole.fibroglandular_fraction)), shape);
  sets["/VTKHDF/PointData/chest_wall_confidence"] =
      reshaped(array_of(std::move(whole.chest_wall_confidence)), shape);
  document.attributes["/breast/skin@measured_thickness"] = array_of(whole.skin_thickness);
  document.attributes["/breast@midline"] = array_of(whole.midline_mm.value_or(0));
  document.attributes["/breast@midline_known"] = array_of(std::int64_t(whole.midline_mm ? 1 : 0));
  Texts names;
  std::vector<Vec3> points;
  for (const auto& [name, point] : whole.landmarks) {
    names.push_back(name);
    points.push_back(point);
  }
  sets["/breast/landmarks/name"] = array_of(std::move(names));
  sets["/breast/landmarks/imaged"] = array_of(points);
  save_document(file, document);
}

}  // namespace breast
