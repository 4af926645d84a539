// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/body_map.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace breast {

namespace {

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

// The centroid of the polygon's area rather than of its points, because unevenly spaced points must
// not move the pole.
Vec2 area_centroid(const std::vector<Vec2>& curve) {
  Vec2 sum = Vec2::Zero();
  double area = 0;
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2 a = curve[i] - curve[0], b = curve[(i + 1) % curve.size()] - curve[0];
    area += cross(a, b);
    sum += cross(a, b) * (a + b) / 3;
  }
  if (!(std::abs(area) > 0)) throw input_error("rim of the wall encloses no area");
  return curve[0] + sum / area;
}

// The first rim point from which the curve does not run counter-clockwise around the centre; −1 if
// there is none.
int star_shaped_at(const std::vector<Vec2>& curve, const Vec2& centre) {
  for (std::size_t i = 0; i < curve.size(); ++i) {
    const Vec2 a = curve[i] - centre, b = curve[(i + 1) % curve.size()] - centre;
    if (!(cross(a, b) > 0)) return int(i);
  }
  return -1;
}

void check_star_shaped(const std::vector<Vec2>& curve, const Vec2& centre, const char* sheet) {
  const int i = star_shaped_at(curve, centre);
  if (i >= 0) {
    throw input_error("rim on the ", sheet, " sheet reverses its direction at point ", i, " of ",
                      curve.size(), " seen from its pole (", centre.x(), ", ", centre.y(),
                      "): it must be star-shaped and counter-clockwise; run fit-hermite again with "
                      "more smoothing");
  }
}

}  // namespace

BodyMap::BodyMap(const BreastGeometry& geometry) : geometry_(geometry) {
  const std::size_t n = geometry.rim_skin.size();
  if (n < 32 || geometry.rim_wall.size() != n) {
    throw input_error("rim has ", n, " skin and ", geometry.rim_wall.size(),
                      " wall points: both must be equal and at least 32");
  }
  wall_pole_ = area_centroid(geometry.rim_wall);
  check_star_shaped(geometry.rim_skin, geometry.centre, "skin");
  check_star_shaped(geometry.rim_wall, wall_pole_, "wall");
  cumulative_.assign(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = (i + 1) % n;
    const auto step = [&](const HermiteSheet& sheet, const std::vector<Vec2>& curve) {
      return (sheet.position(curve[j]) - sheet.position(curve[i])).norm();
    };
    cumulative_[i + 1] = cumulative_[i] + 0.5 * (step(geometry.skin, geometry.rim_skin) +
                                                 step(geometry.wall, geometry.rim_wall));
  }
  const double length = cumulative_.back();
  if (!(length > 0)) throw input_error("rim has no length");
  for (double& value : cumulative_) value /= length;
  choose_pole();
  choose_start();
}

// The nipple, if it is closer to the centre than a third of the way to the rim in every direction.
void BodyMap::choose_pole() {
  skin_pole_ = geometry_.centre;
  double nearest = (geometry_.rim_skin[0] - geometry_.centre).norm();
  for (const Vec2& point : geometry_.rim_skin) {
    nearest = std::min(nearest, (point - geometry_.centre).norm());
  }
  const bool central = (geometry_.nipple_st - geometry_.centre).norm() < nearest / 3 &&
                       star_shaped_at(geometry_.rim_skin, geometry_.nipple_st) < 0;
  if (central) skin_pole_ = geometry_.nipple_st;
}

void BodyMap::choose_start() {
  constexpr int around = 720;
  std::vector<Vec3> points(around);
  Vec3 centre = Vec3::Zero();
  for (int i = 0; i < around; ++i) {
    points[i] = skin_sheet().position(rim(geometry_.rim_skin, double(i) / around));
    centre += points[i] / around;
  }
  double best = -2;
  for (int i = 0; i < around; ++i) {
    const Vec3 way = points[i] - centre;
    const double towards = -(way.x() + way.z()) / std::hypot(way.x(), way.z());
    if (towards > best) best = towards, start_ = double(i) / around;
  }
}

// Cubic (Catmull-Rom) through the rim points: smooth whatever the number of template nodes.
Vec2 BodyMap::rim(const std::vector<Vec2>& curve, double u) const {
  u += start_;
  u -= std::floor(u);
  const int n = int(curve.size());
  const auto after = std::upper_bound(cumulative_.begin(), cumulative_.end(), u);
  const int i = std::clamp(int(after - cumulative_.begin()) - 1, 0, n - 1);
  const double t = (u - cumulative_[i]) / (cumulative_[i + 1] - cumulative_[i]);
  const Vec2 &a = curve[(i + n - 1) % n], &b = curve[i], &c = curve[(i + 1) % n],
             &d = curve[(i + 2) % n];
  return b + 0.5 * t * ((c - a) + t * ((2 * a - 5 * b + 4 * c - d) + t * (3 * (b - c) + d - a)));
}

Vec2 BodyMap::skin(double rho, double u) const {
  return skin_pole_ + rho * (rim(geometry_.rim_skin, u) - skin_pole_);
}

Vec2 BodyMap::wall(double rho, double u) const {
  return wall_pole_ + rho * (rim(geometry_.rim_wall, u) - wall_pole_);
}

Vec3 BodyMap::cut(double height, double u) const {
  return (1 - height) * wall_sheet().position(wall(1, u)) +
         height * skin_sheet().position(skin(1, u));
}

double BodyMap::volume() const {
  constexpr int around = 256, rings = 48, rows = 8;
  const Vec3 origin = skin_sheet().position(skin_pole_);  // near the body, for less cancellation
  double six_volumes = 0;
  // Rings of quads from the skin's pole to its rim, down the cut, and back to the wall's pole.
  const auto ring = [&](int r) {
    std::vector<Vec3> points(around);
    for (int i = 0; i < around; ++i) {
      const double u = double(i) / around;
      if (r <= rings) {
        points[i] = skin_sheet().position(skin(double(r) / rings, u));
      } else if (r <= rings + rows) {
        points[i] = cut(1 - double(r - rings) / rows, u);
      } else {
        points[i] = wall_sheet().position(wall(1 - double(r - rings - rows) / rings, u));
      }
      points[i] -= origin;
    }
    return points;
  };
  std::vector<Vec3> before = ring(0);
  for (int r = 1; r <= 2 * rings + rows; ++r) {
    const std::vector<Vec3> now = ring(r);
    for (int i = 0; i < around; ++i) {
      const int j = (i + 1) % around;
      six_volumes += before[i].dot(now[i].cross(now[j])) + before[i].dot(now[j].cross(before[j]));
    }
    before = now;
  }
  return six_volumes / 6;
}

Eigen::Matrix<double, 3, 2> BodyMap::cut_slopes(double height, double u) const {
  constexpr double step =
      1e-5;  // the rim is C1: central differences are good to 1e-9 of its length
  Eigen::Matrix<double, 3, 2> slopes;
  slopes.col(0) = (cut(height, u + step) - cut(height, u - step)) / (2 * step);
  slopes.col(1) = cut(1, u) - cut(0, u);
  return slopes;
}

double BodyMap::cut_height(double u) const {
  return (cut(1, u) - cut(0, u)).norm();
}

}  // namespace breast
