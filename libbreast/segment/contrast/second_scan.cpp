// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/contrast/second_scan.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "core/table.hpp"

namespace breast {

namespace {

constexpr double most_residual = 4;  // mm
constexpr double far_away = 1e3;     // mm: beside the grid

/// The foremost voxel of every column, patient mm: there signed_distance() is zero.
std::vector<Vec3> front_of(const Mask& mask) {
  std::vector<Vec3> points;
  const Grid& grid = mask.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      int j = 0;
      while (j < grid.size[1] && !mask.at(i, j, k)) ++j;
      if (j > 0 && j < grid.size[1]) points.push_back(grid.to_patient(Vec3(i, j, k)));
    }
  }
  return points;
}

/// Distances (mm) of moved points from the skin of the first scan; those beside it, or behind the
/// front of the chest, are not a number.
std::vector<double> distances(const TorsoFront& torso, const Volume<float>& distance,
                              const std::vector<Vec3>& points, const RigidMotion& motion) {
  constexpr double behind_sternum = 20;  // mm
  std::vector<double> found;
  for (const Vec3& point : points) {
    const Vec3 there = motion.origin_of(point);
    const Vec3 index = distance.grid.to_index(there);
    const int k = int(std::lround(index[2]));
    double d = no_depth;
    if (k >= 0 && k < distance.grid.size[2] &&
        index[1] * distance.grid.spacing[1] < torso.cleft[std::size_t(k)] + behind_sternum) {
      d = sample_linear(distance, there, far_away);
      if (d >= 0.5 * far_away) d = no_depth;
    }
    found.push_back(d);
  }
  return found;
}

/// Root of the mean square of the distances, but for the twentieth that is largest: markers, cables.
double residual_of(const std::vector<double>& all) {
  constexpr double counted = 0.95;
  std::vector<double> squares;
  for (const double d : all)
    if (!std::isnan(d)) squares.push_back(d * d);
  if (squares.empty()) return far_away;
  const auto end = squares.begin() + std::ptrdiff_t(std::ceil(counted * double(squares.size())));
  std::nth_element(squares.begin(), end - 1, squares.end());
  return std::sqrt(std::accumulate(squares.begin(), end, 0.0) / double(end - squares.begin()));
}

Vec3 gradient(const Volume<float>& distance, const Vec3& at) {
  constexpr double step = 2;  // mm
  Vec3 out;
  for (int d = 0; d < 3; ++d) {
    Vec3 shift = Vec3::Zero();
    shift[d] = step;
    out[d] = (sample_linear(distance, at + shift, 0) - sample_linear(distance, at - shift, 0)) /
             (2 * step);
  }
  return out;
}

/// One step of Gauss-Newton: the motion with smaller distances.
RigidMotion improved(const RigidMotion& motion, const Volume<float>& distance,
                     const std::vector<Vec3>& points, const std::vector<double>& off) {
  std::vector<double> sizes;
  for (const double d : off)
    if (!std::isnan(d)) sizes.push_back(std::abs(d));
  const double tukey = 4.685 * std::max(1.0, 1.4826 * median(sizes, 0));
  Eigen::Matrix<double, 6, 6> normal = 1e-6 * Eigen::Matrix<double, 6, 6>::Identity();
  Eigen::Matrix<double, 6, 1> right = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t n = 0; n < points.size(); ++n) {
    if (std::isnan(off[n]) || std::abs(off[n]) >= tukey) continue;
    const double share = 1 - off[n] * off[n] / (tukey * tukey);
    const Vec3 there = motion.origin_of(points[n]), slope = gradient(distance, there);
    Eigen::Matrix<double, 6, 1> row;  // of the point's place in the first scan
    row << slope, (there - motion.centre).cross(slope) * RigidMotion::radians;
    normal += share * share * row * row.transpose();
    right -= share * share * off[n] * row;
  }
  const Eigen::Matrix<double, 6, 1> by = normal.ldlt().solve(right);
  // Moving the point in the first scan is the inverse of moving the body to the second.
  const RigidMotion back{motion.centre, by.head<3>(), by.tail<3>()};
  RigidMotion inverse{motion.centre, Vec3::Zero(), -back.turn};
  inverse.shift = -(inverse.rotation() * back.shift);
  return motion.after(inverse);
}

}  // namespace

SecondScan align_skins(const TorsoFront& torso, const Volume<float>& distance, const Mask& mask) {
  constexpr int steps = 15;
  const std::vector<Vec3> points = front_of(mask);
  SecondScan found;
  const Grid& grid = distance.grid;
  found.motion.centre =
      grid.to_patient(0.5 * Vec3(grid.size[0] - 1, grid.size[1] - 1, grid.size[2] - 1));
  std::vector<double> off = distances(torso, distance, points, found.motion);
  found.residual_mm = residual_of(off);
  const bool moved = found.residual_mm > most_residual;
  for (int step = 0; moved && step < steps; ++step) {
    found.motion = improved(found.motion, distance, points, off);
    off = distances(torso, distance, points, found.motion);
    found.residual_mm = residual_of(off);
  }
  const auto compared =
      std::count_if(off.begin(), off.end(), [](double d) { return !std::isnan(d); });
  if (compared * 4 < std::ptrdiff_t(points.size()) || found.residual_mm > most_residual) {
    throw input_error("--also: the skins of the two scans are ", format_fixed(found.residual_mm, 1),
                      " mm apart (rms, aligned; at most ", most_residual, ") on ",
                      100 * compared / std::max<std::ptrdiff_t>(1, std::ptrdiff_t(points.size())),
                      " % of the front that the second shows (at least 25): give a scan of the "
                      "same woman in the same position, and with --side its breast");
  }
  return found;
}

SharedField shared_field(const Volume<float>& first, const Mask& body, const Volume<float>& second,
                         const RigidMotion& motion) {
  constexpr double least_shared = 50;  // % of the body
  const Grid &grid = first.grid, &other = second.grid;
  // Corners of the second scan, seen in the first: of the eight coordinates along an axis four
  // belong to its low face and four to its high one.
  std::array<std::vector<double>, 3> along;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 index;
    for (int d = 0; d < 3; ++d) index[d] = (corner >> d & 1) ? other.size[d] - 0.5 : -0.5;
    const Vec3 seen = grid.to_index(motion.origin_of(other.to_patient(index)));
    for (int d = 0; d < 3; ++d) along[d].push_back(seen[d]);
  }
  Grid shared = grid;
  Vec3 start = Vec3::Zero(), end;
  for (int d = 0; d < 3; ++d) {
    std::sort(along[d].begin(), along[d].end());
    start[d] = std::max(0.0, std::ceil(along[d][3]));
    end[d] = std::min(double(grid.size[d] - 1), std::floor(along[d][4]));
    shared.size[d] = std::max(0, int(end[d] - start[d]) + 1);
  }
  shared.origin = grid.to_patient(start);
  double all = 0, within = 0;
  for (int k = 0; k < body.grid.size[2]; ++k) {
    for (int j = 0; j < body.grid.size[1]; ++j) {
      for (int i = 0; i < body.grid.size[0]; ++i) {
        if (!body.at(i, j, k)) continue;
        const Vec3 index = grid.to_index(body.grid.to_patient(Vec3(i, j, k)));
        all += 1;
        within += (index.array() >= start.array() - 0.5).all() &&
                  (index.array() <= end.array() + 0.5).all();
      }
    }
  }
  const double percent = all > 0 ? 100 * within / all : 0;
  if (percent < least_shared) {
    throw input_error("--also: the second scan shows ", std::lround(percent),
                      " % of the body in the first (at least ", least_shared,
                      "): give a scan of the same field of view");
  }
  SharedField field{Volume<float>(shared), Volume<float>(shared), percent};
#pragma omp parallel for
  for (int k = 0; k < shared.size[2]; ++k) {
    for (int j = 0; j < shared.size[1]; ++j) {
      for (int i = 0; i < shared.size[0]; ++i) {
        field.first.at(i, j, k) = first.at(i + int(start[0]), j + int(start[1]), k + int(start[2]));
        field.second.at(i, j, k) =
            float(sample_linear(second, motion(shared.to_patient(Vec3(i, j, k))), 0));
      }
    }
  }
  return field;
}

}  // namespace breast
