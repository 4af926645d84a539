// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5/vtkhdf.hpp"

#include <cmath>

namespace breast {

namespace {
constexpr std::int64_t most_nodes = 200'000'000;
constexpr std::int64_t most_voxels_per_axis = 16384;

void put_type(Document& document, const std::string& type) {
  document.attributes["/VTKHDF@Version"] = array_of(Integers{1, 0});
  document.attributes["/VTKHDF@Type"] = array_of(type);
}

void check_type(Fields& fields, const std::string& wanted) {
  const std::string type = fields.text("/VTKHDF@Type");
  if (type != wanted) {
    throw fields.complain()("attribute /VTKHDF@Type is '", type, "', must be '", wanted, "'");
  }
}

std::int64_t count(Fields& fields, const std::string& path) {
  const std::int64_t n = fields.integers(path, {1}).front();
  if (!(n >= 1 && n <= most_nodes)) {
    throw fields.complain()("dataset ", path, " is ", n, ", must be 1 to ", most_nodes);
  }
  return n;
}
}  // namespace

void put_unstructured_grid(Document& document, const std::vector<Vec3>& points,
                           Integers connectivity, Integers offsets, Bytes types) {
  put_type(document, "UnstructuredGrid");
  auto& sets = document.datasets;
  sets["/VTKHDF/NumberOfPoints"] = array_of(Integers{std::int64_t(points.size())});
  sets["/VTKHDF/NumberOfCells"] = array_of(Integers{std::int64_t(types.size())});
  sets["/VTKHDF/NumberOfConnectivityIds"] = array_of(Integers{std::int64_t(connectivity.size())});
  sets["/VTKHDF/Points"] = array_of(points);
  sets["/VTKHDF/Connectivity"] = array_of(std::move(connectivity));
  sets["/VTKHDF/Offsets"] = array_of(std::move(offsets));
  sets["/VTKHDF/Types"] = array_of(std::move(types));
}

void check_unstructured_grid(Fields& fields) {
  check_type(fields, "UnstructuredGrid");
  const std::int64_t points = count(fields, "/VTKHDF/NumberOfPoints");
  const std::int64_t cells = count(fields, "/VTKHDF/NumberOfCells");
  const std::int64_t ids = count(fields, "/VTKHDF/NumberOfConnectivityIds");
  fields.require("/VTKHDF/Points", {std::size_t(points), 3});
  fields.require("/VTKHDF/Types", {std::size_t(cells)});
  fields.check_range("/VTKHDF/Connectivity", {std::size_t(ids)}, 0, points);
  const Integers& offsets =
      fields.check_range("/VTKHDF/Offsets", {std::size_t(cells) + 1}, 0, ids + 1);
  for (std::size_t c = 0; c + 1 < offsets.size(); ++c) {
    if (offsets[c] >= offsets[c + 1]) {
      throw fields.complain()("dataset /VTKHDF/Offsets[", c + 1, "] is ", offsets[c + 1],
                              ", must exceed ", offsets[c]);
    }
  }
  if (offsets.front() != 0 || offsets.back() != ids) {
    throw fields.complain()("dataset /VTKHDF/Offsets runs from ", offsets.front(), " to ",
                            offsets.back(), ", must run from 0 to ", ids);
  }
}

void put_image_grid(Document& document, const Grid& grid) {
  put_type(document, "ImageData");
  auto& attributes = document.attributes;
  attributes["/VTKHDF@WholeExtent"] =
      array_of(Integers{0, grid.size[0] - 1, 0, grid.size[1] - 1, 0, grid.size[2] - 1});
  attributes["/VTKHDF@Origin"] = array_of(grid.origin);
  attributes["/VTKHDF@Spacing"] = array_of(grid.spacing);
  Doubles direction;  // row-major, columns are the directions of i, j, k
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) direction.push_back(grid.direction(r, c));
  }
  attributes["/VTKHDF@Direction"] = array_of(std::move(direction));
}

Grid get_image_grid(Fields& fields) {
  check_type(fields, "ImageData");
  const Integers extent = fields.integer_list("/VTKHDF@WholeExtent", 6);
  Grid grid;
  for (std::size_t d = 0; d < 3; ++d) {
    // Bounds first: the difference of two wild numbers overflows.
    if (extent[2 * d] != 0 ||
        !(extent[2 * d + 1] >= 0 && extent[2 * d + 1] < most_voxels_per_axis)) {
      throw fields.complain()("attribute /VTKHDF@WholeExtent is ", extent[2 * d], " to ",
                              extent[2 * d + 1], " along axis ", d, ", must be 0 to at most ",
                              most_voxels_per_axis - 1);
    }
    grid.size[d] = int(extent[2 * d + 1]) + 1;
  }
  grid.origin = fields.place("/VTKHDF@Origin");
  grid.spacing = fields.vector("/VTKHDF@Spacing");
  const Doubles direction = fields.numbers("/VTKHDF@Direction", 9);
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) grid.direction(r, c) = direction[std::size_t(3 * r + c)];
  }
  check_grid(grid, fields.complain());
  return grid;
}

void check_grid(const Grid& grid, const Complaint& complain) {
  constexpr double orthonormal = 1e-3;
  for (int d = 0; d < 3; ++d) {
    // VTK 9.1 crashes on a volume of a single slice.
    if (!(grid.size[d] >= 2 && grid.size[d] <= most_voxels_per_axis)) {
      throw complain("volume has ", grid.size[d], " voxels along axis ", d, ", must be 2 to ",
                     most_voxels_per_axis);
    }
    constexpr double least_mm = 0.01, most_mm = 50;
    if (!(grid.spacing[d] >= least_mm && grid.spacing[d] <= most_mm)) {
      throw complain("attribute /VTKHDF@Spacing[", d, "] is ", grid.spacing[d], ", must be ",
                     least_mm, " to ", most_mm, " mm");
    }
  }
  const double error =
      (grid.direction.transpose() * grid.direction - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (!(error < orthonormal)) {
    throw complain("attribute /VTKHDF@Direction is not orthonormal (off by ", error,
                   ", must be below ", orthonormal, ")");
  }
}

}  // namespace breast
