// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/chest/rib_spline.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "phantom/chest/rib_surface.hpp"

namespace breast {

namespace {

constexpr double widest = 3.0, farthest = 300;  // radians from the front, mm from the origin
constexpr int angles = 240, heights = 60, samples = 2;  // intervals; samples of each

double at_sample(int i, int count, double low, double high) {
  return low + (high - low) * i / (samples * count);
}

/// Weights of the splines at the samples, one row per sample: a least-squares fit of the samples is
/// as accurate as interpolation and needs no end conditions.
Eigen::MatrixXd weights(int count, double low, double high) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(samples * count + 1, count + 3);
  for (int i = 0; i < rows.rows(); ++i) {
    const SplinePlace at = spline_place(at_sample(i, count, low, high), low, high, count);
    const CubicSpline spline = cubic_spline(at.t);
    for (int k = 0; k < 4; ++k) rows(i, at.interval + k) = spline.value[k];
  }
  return rows;
}

/// Intersection of the ray from the axis with the ribs. The level function is convex along it:
/// Newton's method starts from outside.
double radius(const RibSurface& ribs, const ThoraxSurface& about, double outside, double angle,
              double height) {
  const Vec3 out(elementary::sin(angle), -elementary::cos(angle), 0);
  const Vec3 axis = about.origin + Vec3(0, about.slope * height, height);
  double r = outside;
  for (int i = 0; i < 60; ++i) {
    const std::optional<Level> level = ribs.at(axis + r * out);
    const double slope = level ? level->gradient.dot(out) : 0;
    if (!(slope > 0)) break;
    const double step = level->value / slope;
    r -= step;
    if (std::abs(step) < 1e-12 * outside) return r;
  }
  throw input_error("phantom torso: at height ", height,
                    " mm the ribs do not surround the axis; reduce tilt or bend");
}

}  // namespace

ThoraxSurface rib_spline(const TorsoParameters& torso) {
  const RibSurface ribs(torso);
  ThoraxSurface thorax;
  thorax.origin = Vec3(0, torso.half_depth, 0);
  thorax.slope = torso.tilt;
  thorax.angle_low = -widest, thorax.angle_high = widest;
  thorax.height_low = -farthest, thorax.height_high = farthest;
  thorax.angles = angles, thorax.heights = heights;
  const double outside = 2 * std::max(torso.half_width, torso.half_depth);
  Eigen::MatrixXd radii(samples * angles + 1, samples * heights + 1);
  for (int j = 0; j < radii.cols(); ++j)
    for (int i = 0; i < radii.rows(); ++i)
      radii(i, j) = radius(ribs, thorax, outside, at_sample(i, angles, -widest, widest),
                           at_sample(j, heights, -farthest, farthest));
  const Eigen::MatrixXd along = weights(angles, -widest, widest).householderQr().solve(radii);
  const Eigen::MatrixXd both = weights(heights, -farthest, farthest)
                                   .householderQr()
                                   .solve(Eigen::MatrixXd(along.transpose()));
  for (int j = 0; j < both.rows(); ++j)
    for (int i = 0; i < both.cols(); ++i) thorax.coefficients.push_back(both(j, i));
  return thorax;
}

}  // namespace breast
