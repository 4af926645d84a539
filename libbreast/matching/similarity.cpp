// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/similarity.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"

namespace breast {

namespace {

constexpr double degree = std::numbers::pi / 180;
// Standard deviations of the information other than the outlines.
constexpr double marked_nipple = 2, anterior_part = 5, edge_place = 10;  // mm
constexpr double edge_direction = 3 * degree, log_scale = 0.05;
// Length of outline with correlated errors, mm: shapes differ in long waves.
constexpr double correlation = 30;
constexpr double finest = 0.05;      // smallest standard deviation of an outline, mm
constexpr double border_margin = 1;  // mm: outlines end at the image's border
constexpr int most_iterations = 200;
// Another reading of the image is better above this residual, and below this part of it.
constexpr double least_mm = 1, part = 0.5;

Eigen::Matrix2d turn(double rotation) {
  Eigen::Matrix2d r;
  r << std::cos(rotation), -std::sin(rotation), std::sin(rotation), std::cos(rotation);
  return r;
}

// Middle of the outline's most anterior 5 mm, at its most anterior depth.
template <class Points, class Place>
Vec2 most_anterior(const Points& points, const Place& place) {
  constexpr double depth = 5;  // mm
  double u = -std::numeric_limits<double>::infinity();
  for (const auto& point : points) u = std::max(u, place(point).x());
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& point : points) {
    const Vec2 at = place(point);
    if (at.x() < u - depth) continue;
    low = std::min(low, at.y());
    high = std::max(high, at.y());
  }
  return {u, 0.5 * (low + high)};
}

// Similarity about a pivot near the breast's middle, so that its four numbers
// hardly depend on each other.
struct Pose {
  Vec2 pivot, place;  // simulated mm; image mm
  double rotation = 0, scale = 1;
  Vec2 apply(const Vec2& uv) const { return place + scale * (turn(rotation) * (uv - pivot)); }
  // ∂ apply / ∂ (place, rotation, log scale)
  Eigen::Matrix<double, 2, 4> slope(const Vec2& at) const {
    const Vec2 arm = at - place;
    Eigen::Matrix<double, 2, 4> j;
    j << 1, 0, -arm.y(), arm.x(), 0, 1, arm.x(), arm.y();
    return j;
  }
};

struct Pairing {
  Vec2 at;  // the simulated point in the image
  const OutlinePoint* real;
  double distance;  // signed, along the real normal
};

struct Normal {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
  Eigen::Vector4d right = Eigen::Vector4d::Zero();
  void add(const Eigen::Vector4d& row, double residual, double deviation, double weight = 1) {
    const double w = weight / (deviation * deviation);
    matrix += w * row * row.transpose();
    right -= w * residual * row;
  }
};

class Fit {
 public:
  Fit(const AlignmentData& data, const ImageAxes& axes) : data_(data), axes_(axes) {
    pose_.pivot.setZero();
    for (const Vec2& uv : data.simulated) pose_.pivot += uv / double(data.simulated.size());
    const auto same = [](const Vec2& x) { return x; };
    const auto at = [](const OutlinePoint& p) { return p.at; };
    real_anterior_ = most_anterior(data.real, at);
    const Vec2 from = data.nipple ? data.nipple->first : most_anterior(data.simulated, same),
               to = data.nipple ? data.nipple->second : real_anterior_;
    pose_.scale = data.scale;
    pose_.place = to - data.scale * (from - pose_.pivot);
  }

  // One Gauss-Newton step; its length in mm.
  double step() {
    pair();
    const Normal normal = equations(std::max(finest, spread()));
    const Eigen::Vector4d change = normal.matrix.ldlt().solve(normal.right);
    pose_.place += change.head<2>();
    pose_.rotation += std::clamp(change[2], -0.1, 0.1);
    pose_.scale *= std::exp(std::clamp(change[3], -0.1, 0.1));
    constexpr double arm = 100;  // mm
    return change.head<2>().norm() + arm * (std::abs(change[2]) + std::abs(change[3]));
  }

  double used() const { return double(pairs_.size()) / double(data_.simulated.size()); }

  Alignment result() {
    pair();
    Alignment found;
    found.used = used();
    found.map.scale = pose_.scale;
    found.map.rotation_deg = pose_.rotation / degree;
    found.map.shift = pose_.apply(Vec2::Zero());
    double squares = 0;
    for (const Pairing& p : pairs_) squares += p.distance * p.distance;
    found.residual_mm = std::sqrt(squares / double(pairs_.size()));
    // Compensates for the part of the residual that the four parameters have absorbed.
    const double independent = double(pairs_.size()) * data_.spacing / correlation;
    const double deviation =
        found.residual_mm * std::sqrt(independent / std::max(independent - 4, 1.0));
    const Eigen::Matrix4d covariance = equations(std::max(finest, deviation)).matrix.inverse();
    double variance = 0;
    for (const Pairing& p : pairs_) {
      const auto j = pose_.slope(p.at);
      variance += 0.5 * (j * covariance * j.transpose()).trace() / double(pairs_.size());
    }
    found.pose_mm = std::sqrt(variance);
    found.rotation_sd_deg = std::sqrt(covariance(2, 2)) / degree;
    found.scale_sd = std::sqrt(covariance(3, 3));
    found.nipple_mm = nipple_apart().norm();
    found.edge_mm = edge_at().x() - axes_.posterior_border();
    return found;
  }

 private:
  void pair() {
    pairs_.clear();
    for (const Vec2& uv : data_.simulated) {
      const Vec2 at = pose_.apply(uv);
      if (!axes_.contains(at, border_margin)) continue;
      const OutlinePoint* nearest = nullptr;
      double least = std::numeric_limits<double>::infinity();
      for (const OutlinePoint& real : data_.real) {
        const double apart = (real.at - at).squaredNorm();
        if (apart < least) {
          least = apart;
          nearest = &real;
        }
      }
      pairs_.push_back({at, nearest, (at - nearest->at).dot(nearest->normal)});
    }
  }

  // Robust spread of the distances: of a normal one its standard deviation.
  double spread() const {
    if (pairs_.empty()) return finest;
    std::vector<double> apart;
    for (const Pairing& p : pairs_) apart.push_back(std::abs(p.distance));
    return 1.4826 * median(std::move(apart));
  }

  Vec2 nipple_apart() const {
    if (data_.nipple) return pose_.apply(data_.nipple->first) - data_.nipple->second;
    return most_anterior(data_.simulated, [&](const Vec2& uv) { return pose_.apply(uv); }) -
           real_anterior_;
  }
  // Centre of the simulated plate's edge in the image.
  Vec2 edge_at() const { return pose_.apply(Vec2(data_.plate_edge_u, pose_.pivot.y())); }

  Normal equations(double deviation) const {
    Normal normal;
    const double together = std::max(1.0, correlation / data_.spacing);
    for (const Pairing& p : pairs_) {
      const double huber = std::min(1.0, 2 * deviation / std::max(std::abs(p.distance), 1e-12));
      normal.add(pose_.slope(p.at).transpose() * p.real->normal, p.distance, deviation,
                 huber / together);
    }
    const Vec2 apart = nipple_apart(),
               nipple = data_.nipple ? data_.nipple->second : real_anterior_;
    for (int k = 0; k < 2; ++k) {
      normal.add(pose_.slope(nipple).row(k).transpose(), apart[k],
                 data_.nipple ? marked_nipple : anterior_part);
    }
    const Vec2 edge = edge_at();
    normal.add(pose_.slope(edge).row(0).transpose(), edge.x() - axes_.posterior_border(),
               edge_place);
    normal.add(Eigen::Vector4d(0, 0, 1, 0), pose_.rotation, edge_direction);
    normal.add(Eigen::Vector4d(0, 0, 0, 1), std::log(pose_.scale / data_.scale), log_scale);
    return normal;
  }

  const AlignmentData& data_;
  const ImageAxes& axes_;
  Pose pose_;
  Vec2 real_anterior_;
  std::vector<Pairing> pairs_;
};

}  // namespace

Vec2 Similarity::apply(const Vec2& uv) const {
  return shift + scale * (turn(rotation_deg * degree) * uv);
}

Vec2 Similarity::invert(const Vec2& mm) const {
  return turn(-rotation_deg * degree) * (mm - shift) / scale;
}

bool fits_better(double residual_mm, double than_mm) {
  return than_mm > least_mm && residual_mm < part * than_mm;
}

double Alignment::deviation_mm() const {
  return std::hypot(residual_mm, pose_mm);
}

Alignment align_outlines(const AlignmentData& data, const ImageAxes& axes,
                         const std::string& where) {
  if (data.simulated.size() < 50 || data.real.size() < 50) {
    throw input_error(where, ": outlines of ", data.simulated.size(), " and ", data.real.size(),
                      " points: too short to be registered");
  }
  Fit fit(data, axes);
  double moved = std::numeric_limits<double>::infinity();
  // Converged when the nearest points no longer change: a hundredth of a millimetre at the rim of
  // the image.
  for (int i = 0; i < most_iterations && !(moved < 0.01); ++i) moved = fit.step();
  const Alignment found = fit.result();
  if (!(found.used >= 0.4)) {
    throw input_error(where, ": only ", int(100 * found.used),
                      " % of the simulated outline lies within this image: it may show another "
                      "breast; otherwise mark the nipple in both images");
  }
  if (!(moved < 0.5)) {
    throw input_error(where, ": the outlines cannot be registered (the last step is still ", moved,
                      " mm); mark the nipple in both images");
  }
  return found;
}

void check_upright(const AlignmentData& data, const ImageAxes& axes, const Alignment& found,
                   const std::string& where) {
  if (!(found.residual_mm > least_mm)) return;
  const auto reverse = [](Vec2& uv) { uv.y() *= -1; };
  AlignmentData reversed = data;
  for (OutlinePoint& point : reversed.real) {
    reverse(point.at);
    reverse(point.normal);
  }
  if (reversed.nipple) reverse(reversed.nipple->second);
  double residual = 0;
  try {
    residual = align_outlines(reversed, axes.upside_down(), where).residual_mm;
  } catch (const Error&) {
    return;  // it does not fit at all
  }
  if (!fits_better(residual, found.residual_mm)) return;
  throw input_error(where, ": fits upside down (", residual,
                    " mm) better than as its patient orientation says (", found.residual_mm,
                    " mm): its rows were reversed after the header was written");
}

void check_scale(const AlignmentData& data, const ImageAxes& axes, const Alignment& found,
                 const std::string& where) {
  if (!(found.residual_mm > least_mm)) return;
  for (const double scale : {1.5, 1.8, 0.65, 0.55}) {  // factors of magnification stands
    AlignmentData scaled = data;
    scaled.scale = scale;
    Alignment other;
    try {
      other = align_outlines(scaled, axes, where);
    } catch (const Error&) {
      continue;  // it does not fit at all
    }
    if (!fits_better(other.residual_mm, found.residual_mm)) continue;
    throw input_error(where, ": fits ", other.map.scale, " times as large (", other.residual_mm,
                      " mm) better than with the pixels that its header states (",
                      found.residual_mm,
                      " mm): a magnified view that does not state its factor, or a spacing that "
                      "is already divided by it");
  }
}

}  // namespace breast
