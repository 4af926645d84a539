// SPDX-License-Identifier: GPL-3.0-or-later
#include "identification/wall_alignment.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "core/table.hpp"
#include "identification/observations.hpp"
#include "identification/wall_map.hpp"

namespace breast {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr double spacing_mm = 12, least_deviation = 1;  // mm
// Errors of a segmented wall are correlated over this length, so that this many places count as
// one.
constexpr double hangs_together_mm = 30, places_a_datum = (hangs_together_mm / spacing_mm) *
                                                          (hangs_together_mm / spacing_mm);
constexpr double beyond = 4.685;  // Tukey's constant, in deviations
constexpr double same_frame_mm = 15;
constexpr int least_places = 20, most_rounds = 60;
// Largest residual of two segmentations of the same wall, mm.
constexpr double worst_residual_mm = 4;
constexpr const char* names[6] = {"shift to the side",
                                  "shift from front to back",
                                  "shift along the body",
                                  "rotation about the left-right axis",
                                  "rotation about the front-back axis",
                                  "rotation about the body's long axis"};

struct Compared {
  std::vector<double> distances;
  std::vector<Vector6> slopes;  // derivatives with respect to shift (mm) and rotation (degrees)
};

// The places of the second wall in the first scan, where that has a wall.
Compared compare(const WallMap& wall, const std::vector<Vec3>& places, const RigidMotion& motion) {
  Compared out;
  const Mat3 rotation = motion.rotation();
  for (const Vec3& place : places) {
    const Vec3 x = motion.origin_of(place);
    const auto found = wall.distance(x);
    if (!found) continue;
    Vector6 slope;
    slope << -(rotation * found->normal),
        -RigidMotion::radians * (rotation * (x - motion.centre).cross(found->normal));
    out.distances.push_back(found->value);
    out.slopes.push_back(slope);
  }
  if (int(out.distances.size()) < least_places) {
    throw input_error(
        "the chest walls of both scans can be compared at ", out.distances.size(),
        " places 12 mm apart, at least ", least_places,
        " are needed: do both scans show the same patient and side, in frames that differ by less "
        "than a hand along the body?");
  }
  return out;
}

double deviation_of(const std::vector<double>& distances) {
  std::vector<double> sizes;
  for (const double d : distances) sizes.push_back(std::abs(d));
  return std::max(least_deviation, 1.4826 * median(sizes));
}

double tukey(double distance, double deviation) {
  const double u = distance / (beyond * deviation);
  return std::abs(u) < 1 ? (1 - u * u) * (1 - u * u) : 0;
}

void turn_by(RigidMotion& motion, const Vec3& degrees) {
  RigidMotion more;
  more.turn = degrees;
  const Eigen::AngleAxisd both(more.rotation() * motion.rotation());
  motion.turn = both.angle() / RigidMotion::radians * both.axis();
}

// Median depth of the wall near the midline.
std::optional<double> sternum(const std::vector<Vec3>& places, double midline) {
  std::vector<double> depths;
  for (const Vec3& place : places)
    if (std::abs(place.x() - midline) < 30) depths.push_back(place.y());
  if (depths.empty()) return {};
  return median(depths);
}

// The frames of two scans may differ by the height of the table and the patient's position on it.
Vec3 frames_differ_by(const LabelVolume& first, const LabelVolume& second,
                      const std::vector<Vec3>& first_places,
                      const std::vector<Vec3>& second_places) {
  if (!first.midline_mm || !second.midline_mm) return Vec3::Zero();
  const auto from = sternum(first_places, *first.midline_mm),
             to = sternum(second_places, *second.midline_mm);
  Vec3 shift(*second.midline_mm - *first.midline_mm, from && to ? *to - *from : 0, 0);
  const auto middle = [](const Grid& grid) {
    return grid.to_patient(0.5 * Vec3(grid.size[0] - 1, grid.size[1] - 1, grid.size[2] - 1)).z();
  };
  const double along = middle(second.grid) - middle(first.grid);
  if (std::abs(along) > 60) shift.z() = along;
  return shift.norm() > same_frame_mm ? shift : Vec3(0, 0, 0);
}

}  // namespace

std::vector<std::string> WallAlignment::words() const {
  std::vector<std::string> list;
  for (int k = 0; k < 6; ++k) {
    const double share = from_walls[std::size_t(k)];
    const std::string size =
        format_fixed(deviation(k), deviation(k) < 1 ? 2 : 1) + (k < 3 ? " mm" : " degrees");
    list.push_back(std::string(names[k]) +
                   (share < 0.5 ? " not determined by the walls: " : " known to ") + size + ", " +
                   format_fixed(100 * share, 0) + " % of it from them");
  }
  return list;
}

WallAlignment align_walls(const LabelVolume& first, const LabelVolume& second, const Vec3& centre,
                          double shift_mm, double turn_deg) {
  const WallMap wall(first);
  const std::vector<Vec3> places = WallMap(second).places(spacing_mm);
  WallAlignment out;
  const Vec3 start = frames_differ_by(first, second, wall.places(spacing_mm), places);
  out.laid_over = {start.x(), start.y(), start.z()};
  out.motion.centre = centre, out.motion.shift = start;
  Vector6 prior;
  prior << Vec3::Constant(coordinate_deviation(shift_mm)),
      Vec3::Constant(coordinate_deviation(turn_deg));
  if (start.norm() > 0) prior.head<3>() = Vec3(5, 5, 30).cwiseMax(prior.head<3>());
  const Vector6 information = prior.cwiseInverse().cwiseAbs2();
  Matrix6 walls;
  for (int round = 0; round < most_rounds; ++round) {
    const Compared now = compare(wall, places, out.motion);
    const double deviation = deviation_of(now.distances);
    walls.setZero();
    Vector6 right, gone;
    gone << out.motion.shift - start, out.motion.turn;
    right = -information.cwiseProduct(gone);
    double squares = 0, weights = 0, left_out = 0;
    for (std::size_t i = 0; i < now.distances.size(); ++i) {
      const double weight =
          tukey(now.distances[i], deviation) / (deviation * deviation * places_a_datum);
      walls += weight * now.slopes[i] * now.slopes[i].transpose();
      right -= weight * now.distances[i] * now.slopes[i];
      squares += weight * now.distances[i] * now.distances[i], weights += weight;
      left_out += weight == 0;
    }
    const Matrix6 whole = walls + Matrix6(information.asDiagonal());
    const Vector6 step = whole.ldlt().solve(right);
    out.covariance = whole.ldlt().solve(Matrix6::Identity());
    out.places = int(now.distances.size());
    out.residual_mm = std::sqrt(squares / weights);
    out.left_out_percent = 100 * left_out / double(now.distances.size());
    out.motion.shift += step.head<3>();
    turn_by(out.motion, step.tail<3>());
    if (step.cwiseQuotient(prior).norm() < 1e-4) break;
  }
  if (!(out.residual_mm < worst_residual_mm)) {
    throw input_error(
        "the chest walls of both scans do not agree: ", format_fixed(out.residual_mm, 1),
        " mm rms at ", out.places, " places, at most ", worst_residual_mm,
        " expected: do both scans show the same patient, and are their chest walls right (segment "
        "--overlay)?");
  }
  for (int k = 0; k < 6; ++k)
    out.from_walls[std::size_t(k)] = std::max(0.0, 1 - out.covariance(k, k) * information[k]);
  return out;
}

}  // namespace breast
