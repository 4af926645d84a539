// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/slicer/field_check.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <random>

#include "mesh/locate.hpp"

namespace breast {

namespace {

struct BodyPoint {
  Vec3 at;
  Location location;
};

// Random points by rejection from the bounding box. Only the engine of the standard library is
// used, because the values of its distributions depend on the implementation.
std::vector<BodyPoint> random_points(const Locator& body, int count) {
  std::mt19937_64 engine(20);
  const auto uniform = [&] { return double(engine() >> 11) * 0x1p-53; };
  std::vector<BodyPoint> points;
  const Vec3 extent = body.upper() - body.lower();
  while (int(points.size()) < count) {
    const double a = uniform(), b = uniform(), c = uniform();
    const Vec3 at = body.lower() + extent.cwiseProduct(Vec3(a, b, c));
    if (const auto found = body.find(at)) points.push_back({at, *found});
  }
  return points;
}

double smallest_determinant(const DisplacementField& field) {
  const Grid& grid = field.grid;
  const Mat3 to_index = Mat3(grid.spacing.cwiseInverse().asDiagonal()) * grid.direction.inverse();
  const auto in_body = [&](int i, int j, int k) {
    return grid.contains(i, j, k) && field.part[grid.offset(i, j, k)] == FieldPart::body;
  };
  double least = 1e300;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!in_body(i, j, k) || !in_body(i + 1, j, k) || !in_body(i, j + 1, k) ||
            !in_body(i, j, k + 1)) {
          continue;
        }
        const auto u = [&](int a, int b, int c) {
          const auto& v = field.vectors[grid.offset(a, b, c)];
          return Vec3(v[0], v[1], v[2]);
        };
        Mat3 by_index;
        by_index << u(i + 1, j, k) - u(i, j, k), u(i, j + 1, k) - u(i, j, k),
            u(i, j, k + 1) - u(i, j, k);
        least = std::min(least, (Mat3::Identity() + by_index * to_index).determinant());
      }
    }
  }
  return least;
}

double outside_into_body(const DisplacementField& field, const Locator& target) {
  const Grid& grid = field.grid;
  std::size_t outside = 0, into = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : outside, into)
  for (int k = 0; k < grid.size[2]; ++k) {
    int hint = -1;
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::size_t at = grid.offset(i, j, k);
        if (field.part[at] == FieldPart::body) continue;
        outside += 1;
        const auto& u = field.vectors[at];
        const auto found =
            target.find(grid.to_patient(Vec3(i, j, k)) + Vec3(u[0], u[1], u[2]), hint);
        if (!found) continue;
        hint = found->element;
        into += 1;
      }
    }
  }
  return outside == 0 ? 0 : 100.0 * double(into) / double(outside);
}

}  // namespace

FieldCheck check_field(const DisplacementField& field, const HexTopology& mesh,
                       const std::vector<Vec3>& from, const std::vector<Vec3>& to, int count) {
  const Locator source(mesh, from), target(mesh, to);
  FieldCheck check;
  for (const BodyPoint& point : random_points(source, count)) {
    const Vec3 exact = target.position(point.location.element, point.location.local);
    const double distance = (field.moved(point.at) - exact).norm();
    check.mean_mm += distance / count;
    check.max_mm = std::max(check.max_mm, distance);
    if (distance > accuracy_mm) check.beyond_percent += 100.0 / count;
  }
  check.points = count;
  check.smallest_det = smallest_determinant(field);
  check.outside_into_body_percent = outside_into_body(field, target);
  return check;
}

RoundTrip check_round_trip(const DisplacementField& field, const DisplacementField& inverse,
                           const HexTopology& mesh, const std::vector<Vec3>& from, int count) {
  RoundTrip trip;
  for (const BodyPoint& point : random_points(Locator(mesh, from), count)) {
    const double distance = (inverse.moved(field.moved(point.at)) - point.at).norm();
    trip.mean_mm += distance / count;
    trip.max_mm = std::max(trip.max_mm, distance);
  }
  return trip;
}

}  // namespace breast
