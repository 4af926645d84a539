// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/slicer/field.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "mesh/locate.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

// Local coordinates of a point in an element's map extrapolated beyond its faces; no value if
// Newton's method fails or if the point is farther away than the width of the element.
std::optional<Vec3> continued_local(const HexTopology& mesh, const std::vector<Vec3>& nodal,
                                    int element, const Vec3& point) {
  constexpr double farthest = 3, tolerance = 1e-9;
  const int* nodes = mesh.element(element);
  Vec3 local = Vec3::Zero();
  for (int iteration = 0; iteration < 25; ++iteration) {
    const HexShape shape = hex_shape(mesh.order, local);
    Vec3 x = Vec3::Zero();
    Mat3 jacobian = Mat3::Zero();
    for (int a = 0; a < mesh.nodes_per_element(); ++a) {
      x += shape.values[a] * nodal[nodes[a]];
      jacobian += nodal[nodes[a]] * shape.gradients.col(a).transpose();
    }
    const Vec3 step = jacobian.partialPivLu().solve(point - x);
    local += step;
    if (!(local.cwiseAbs().maxCoeff() <= farthest)) return std::nullopt;
    if (step.cwiseAbs().maxCoeff() < tolerance) return local;
  }
  return std::nullopt;
}

// Rounded to 2⁻¹³ mm (0.0001 mm), because smaller digits are noise that does not compress.
std::array<float, 3> as_float(const Vec3& v) {
  constexpr double steps = 8192;
  const auto rounded = [](double x) { return float(std::round(x * steps) / steps); };
  return {rounded(v[0]), rounded(v[1]), rounded(v[2])};
}

// Fills a field in two passes and stores the element that contains every grid point of the body.
class Sampler {
 public:
  Sampler(const HexTopology& mesh, const std::vector<Vec3>& from, const std::vector<Vec3>& to,
          const Grid& grid)
      : mesh_(mesh), from_(from), to_(to), element_(grid.voxels(), -1) {
    field_.grid = grid;
    field_.vectors.assign(grid.voxels(), {0, 0, 0});
    field_.part.assign(grid.voxels(), FieldPart::continued);
  }

  void sample_body(Progress& progress, const std::string& stage) {
    const Locator source(mesh_, from_), target(mesh_, to_);
    const auto& size = field_.grid.size;
    std::atomic<int> done = 0;
#pragma omp parallel for schedule(dynamic)
    for (int k = 0; k < size[2]; ++k) {
      for (int j = 0; j < size[1]; ++j) sample_row(source, target, j, k);
      const int slices = ++done;
#pragma omp critical(slicer_field_progress)
      progress.update(stage, double(slices) / size[2], "");
    }
  }

  void sample_border() {
    const auto& size = field_.grid.size;
#pragma omp parallel for schedule(dynamic)
    for (int k = 0; k < size[2]; ++k) {
      for (int j = 0; j < size[1]; ++j) {
        for (int i = 0; i < size[0]; ++i) {
          if (element_[field_.grid.offset(i, j, k)] < 0) continue_from_neighbours(i, j, k);
        }
      }
    }
  }

  DisplacementField take() {
    return std::move(field_);
  }
  bool empty() const {
    return std::all_of(element_.begin(), element_.end(), [](int e) { return e < 0; });
  }

 private:
  void sample_row(const Locator& source, const Locator& target, int j, int k) {
    int hint = -1;
    for (int i = 0; i < field_.grid.size[0]; ++i) {
      const Vec3 point = field_.grid.to_patient(Vec3(i, j, k));
      const auto found = source.find(point, hint);
      if (!found) continue;
      hint = found->element;
      const std::size_t at = field_.grid.offset(i, j, k);
      element_[at] = hint;
      field_.vectors[at] = as_float(target.position(hint, found->local) - point);
      field_.part[at] = FieldPart::body;
    }
  }

  // The mean of the maps of the elements at the 26 neighbouring grid points, with larger weights
  // for nearer ones: cells crossed by the boundary are then interpolated as if the body continued.
  void continue_from_neighbours(int i, int j, int k) {
    const Grid& grid = field_.grid;
    const Vec3 point = grid.to_patient(Vec3(i, j, k));
    Vec3 sum = Vec3::Zero();
    double weights = 0;
    for (int n = 0; n < 27; ++n) {
      const int di = n % 3 - 1, dj = n / 3 % 3 - 1, dk = n / 9 - 1;
      if (n == 13 || !grid.contains(i + di, j + dj, k + dk)) continue;
      const int element = element_[grid.offset(i + di, j + dj, k + dk)];
      if (element < 0) continue;
      const auto local = continued_local(mesh_, from_, element, point);
      if (!local) continue;
      const double weight = 1 / grid.spacing.cwiseProduct(Vec3(di, dj, dk)).squaredNorm();
      sum += weight * (element_position(mesh_, to_, element, *local) - point);
      weights += weight;
    }
    if (weights == 0) return;
    const std::size_t at = grid.offset(i, j, k);
    field_.vectors[at] = as_float(sum / weights);
    field_.part[at] = FieldPart::border;
  }

  const HexTopology& mesh_;
  const std::vector<Vec3>&from_, &to_;
  DisplacementField field_;
  std::vector<int> element_;  // per grid point, -1 outside the body
};

}  // namespace

Vec3 DisplacementField::moved(const Vec3& point) const {
  const Vec3 index = grid.to_index(point);
  std::array<int, 3> low{};
  Vec3 weight;
  for (int d = 0; d < 3; ++d) {
    const double x = std::clamp(index[d], 0.0, double(grid.size[std::size_t(d)] - 1));
    low[std::size_t(d)] = std::min(int(x), std::max(grid.size[std::size_t(d)] - 2, 0));
    weight[d] = x - low[std::size_t(d)];
  }
  Vec3 sum = point;
  for (int corner = 0; corner < 8; ++corner) {
    const int a = corner & 1, b = corner >> 1 & 1, c = corner >> 2;
    const double factor = (a ? weight[0] : 1 - weight[0]) * (b ? weight[1] : 1 - weight[1]) *
                          (c ? weight[2] : 1 - weight[2]);
    if (factor == 0) continue;
    const auto& u = vectors[grid.offset(low[0] + a, low[1] + b, low[2] + c)];
    sum += factor * Vec3(u[0], u[1], u[2]);
  }
  return sum;
}

DisplacementField displacement_field(const HexTopology& mesh, const std::vector<Vec3>& from,
                                     const std::vector<Vec3>& to, const Grid& grid,
                                     Progress& progress, const std::string& stage) {
  Sampler sampler(mesh, from, to, grid);
  sampler.sample_body(progress, stage);
  if (sampler.empty()) {
    throw input_error("displacement field: no point of its grid (", grid.spacing.transpose(),
                      " mm apart) lies in the body: choose a finer grid");
  }
  sampler.sample_border();
  DisplacementField field = sampler.take();
  continue_field(field);
  return field;
}

Grid covering_grid(const Grid& lattice, const std::vector<const std::vector<Vec3>*>& shapes,
                   double margin, double spacing) {
  Grid grid = lattice;
  if (spacing > 0) grid.spacing = Vec3::Constant(spacing);
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const auto* shape : shapes) {
    for (const Vec3& point : *shape) {
      const Vec3 index = grid.to_index(point);
      low = low.cwiseMin(index);
      high = high.cwiseMax(index);
    }
  }
  constexpr double most_points = 1e8;
  Vec3 first;
  double points = 1;
  for (int d = 0; d < 3; ++d) {
    first[d] = std::floor(low[d] - margin / grid.spacing[d]);
    const double count = std::ceil(high[d] + margin / grid.spacing[d]) - first[d] + 1;
    points *= count;
    if (!(points >= 1 && points <= most_points)) {
      throw input_error("displacement field: more than ", most_points, " grid points ",
                        grid.spacing.transpose(), " mm apart: choose a coarser --spacing");
    }
    grid.size[std::size_t(d)] = int(count);
  }
  grid.origin = grid.to_patient(first);
  return grid;
}

}  // namespace breast
