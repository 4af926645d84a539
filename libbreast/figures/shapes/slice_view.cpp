// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/shapes/slice_view.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace breast {

namespace {

constexpr double slice_raster_mm = 0.6;
/// Labels are averaged over at least this length, and over this many voxels in the plane, so that
/// contours do not follow the steps of voxels.
constexpr double smoothing_mm = 0.9, smoothing_voxels = 0.6;
/// Contours are shown up to this far from the breast.
constexpr double near_breast_mm = 2.5;
/// Mid-greys are lifted a little, as a viewer's default window does.
constexpr double grey_gamma = 0.8;

/// Patient to voxel coordinates as one affine map: to_index inverts a matrix at every call.
struct ToIndex {
  Mat3 matrix;
  Vec3 offset;
  explicit ToIndex(const Grid& grid) : offset(grid.to_index(Vec3::Zero())) {
    for (int d = 0; d < 3; ++d) matrix.col(d) = grid.to_index(Vec3::Unit(d)) - offset;
  }
  Vec3 operator()(const Vec3& x) const { return matrix * x + offset; }
};

/// Trilinear interpolation between the eight voxels around a position; voxels outside have the
/// value of the nearest one inside.
template <class Value>
double trilinear(const Grid& grid, const Vec3& index, const Value& value) {
  double sum = 0;
  const Vec3 low = index.array().floor();
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<int, 3> at;
    for (int d = 0; d < 3; ++d) {
      const bool upper = corner >> d & 1;
      const double f = index[d] - low[d];
      weight *= upper ? f : 1 - f;
      at[std::size_t(d)] =
          std::clamp(int(low[d]) + (upper ? 1 : 0), 0, grid.size[std::size_t(d)] - 1);
    }
    if (weight > 0) sum += weight * value(grid.offset(at[0], at[1], at[2]));
  }
  return sum;
}

template <class Value>
PlaneField sampled(const LabelVolume& labels, const SliceFrame& frame, const Value& value) {
  const ToIndex to_index(labels.grid);
  PlaneField field(1 + int(frame.width / slice_raster_mm), 1 + int(frame.height / slice_raster_mm),
                   slice_raster_mm);
  for (int row = 0; row < field.height; ++row) {
    for (int column = 0; column < field.width; ++column) {
      const Vec3 index = to_index(frame.at(slice_raster_mm * Vec2(column, row)));
      field.at(column, row) = float(trilinear(labels.grid, index, value));
    }
  }
  return field;
}

/// Averaging length along the coarser of the plane's two axes, mm.
double smoothing_in(const Grid& grid, const SliceFrame& frame) {
  double coarsest = 0;
  for (int d = 0; d < 3; ++d) {
    const Vec3 step = grid.spacing[d] * grid.direction.col(d);
    coarsest = std::max({coarsest, std::abs(step.dot(frame.right)), std::abs(step.dot(frame.up))});
  }
  return std::max(smoothing_mm, smoothing_voxels * coarsest);
}

/// The parts of the lines where the field `near` is above a threshold.
std::vector<PlaneSegment> beside(const PlaneField& near, std::vector<PlaneSegment> lines) {
  constexpr double trace = 0.05;
  std::erase_if(lines, [&](const PlaneSegment& line) {
    return near.near(0.5 * (line[0] + line[1])) < trace;
  });
  return lines;
}

}  // namespace

SliceFrame::SliceFrame(SlicePlane shown, const Vec3& centre, const Vec2& size)
    : plane(shown), width(size.x()), height(size.y()) {
  right = plane == SlicePlane::sagittal ? Vec3(0, 1, 0) : Vec3(1, 0, 0);
  up = plane == SlicePlane::axial ? Vec3(0, -1, 0) : Vec3(0, 0, 1);
  corner = centre - 0.5 * width * right - 0.5 * height * up;
}

double SliceFrame::distance(const Vec3& x) const {
  return std::abs((x - corner).dot(right.cross(up)));
}

SliceContours slice_contours(const LabelVolume& labels, const SliceFrame& frame) {
  const auto tissue = [&](std::size_t n) { return static_cast<Tissue>(labels.tissue[n]); };
  const PlaneField breast = smoothed(
      sampled(labels, frame, [&](std::size_t n) { return is_breast(tissue(n)) ? 1.0 : 0.0; }),
      near_breast_mm);
  const auto body = [&](std::size_t n) { return tissue(n) == Tissue::air ? 0.0 : 1.0; };
  const auto muscle = [&](std::size_t n) { return tissue(n) == Tissue::muscle ? 1.0 : 0.0; };
  const auto gland = [&](std::size_t n) { return double(labels.fibroglandular_fraction[n]); };
  const double sigma = smoothing_in(labels.grid, frame);
  const auto half = [&](const PlaneField& field) {
    return contour_lines(smoothed(field, sigma), 0.5);
  };
  return {beside(breast, half(sampled(labels, frame, body))),
          beside(breast, half(sampled(labels, frame, muscle))),
          contour_lines(smoothed(sampled(labels, frame, gland), smoothing_mm), 0.5)};
}

ShownBox breast_box(const LabelVolume& labels, double margin) {
  ShownBox box{Vec3::Constant(1e9), Vec3::Constant(-1e9)};
  const Grid& grid = labels.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!is_breast(labels.at(i, j, k))) continue;
        const Vec3 x = grid.to_patient(Vec3(i, j, k));
        box.low = box.low.cwiseMin(x);
        box.high = box.high.cwiseMax(x);
      }
    }
  }
  if (!(box.high.x() >= box.low.x())) throw input_error("labels: there is no breast to show");
  box.low -= Vec3::Constant(margin);
  box.high += Vec3::Constant(margin);
  return box;
}

Vec3 breast_centre(const LabelVolume& labels) {
  Vec3 gland = Vec3::Zero(), breast = Vec3::Zero();
  double gland_weight = 0, breast_weight = 0;
  const Grid& grid = labels.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!is_breast(labels.at(i, j, k))) continue;
        const Vec3 x = grid.to_patient(Vec3(i, j, k));
        const double fraction = labels.fibroglandular_fraction[grid.offset(i, j, k)];
        gland += fraction * x;
        gland_weight += fraction;
        breast += x;
        breast_weight += 1;
      }
    }
  }
  if (gland_weight > 0) return gland / gland_weight;
  return breast / std::max(1.0, breast_weight);
}

double white_level(const Volume<float>& scan, const LabelVolume& labels) {
  std::vector<float> sample;
  const Grid& grid = labels.grid;
  for (int k = 0; k < grid.size[2]; k += 2) {
    for (int j = 0; j < grid.size[1]; j += 3) {
      for (int i = 0; i < grid.size[0]; i += 3) {
        if (!is_breast(labels.at(i, j, k))) continue;
        sample.push_back(float(sample_linear(scan, grid.to_patient(Vec3(i, j, k)), 0)));
      }
    }
  }
  if (sample.empty()) return 1;
  const auto high = sample.begin() + std::ptrdiff_t(0.995 * double(sample.size() - 1));
  std::nth_element(sample.begin(), high, sample.end());
  if (!(*high > 0))
    throw input_error("scan: it is dark where the labels have the breast; is it another scan?");
  return *high;
}

SliceImage slice_image(const Volume<float>& scan, const SliceFrame& frame, double pixel,
                       double white) {
  SliceImage image;
  image.width = 1 + int(frame.width / pixel);
  image.height = 1 + int(frame.height / pixel);
  image.grey.reserve(std::size_t(image.width) * std::size_t(image.height));
  for (int row = image.height - 1; row >= 0; --row) {
    for (int column = 0; column < image.width; ++column) {
      const double value = sample_linear(scan, frame.at(pixel * Vec2(column, row)), 0);
      const double shown = std::pow(std::clamp(value / white, 0.0, 1.0), grey_gamma);
      image.grey.push_back(std::uint16_t(std::lround(65535 * shown)));
    }
  }
  return image;
}

}  // namespace breast
