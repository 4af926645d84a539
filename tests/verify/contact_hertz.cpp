// SPDX-License-Identifier: GPL-3.0-or-later
// Hertz's contact: a soft ball of large radius against a rigid flat, F = 4/3 E* √R d^(3/2).
//
// Meshed is a quarter of the ball near the pole, 30 mm deep and wide, with the top surface
// z = −r²/2R. What lies farther out is half-space: its far field under the same force is prescribed
// on the outer faces (Boussinesq's, incompressible). Small loads: a/R < 0.007.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/units.hpp"
#include "fixtures/block.hpp"
#include "fixtures/pressed_body.hpp"
#include "fixtures/wide_plates.hpp"

using namespace breast;

namespace {

constexpr double radius = 1000, size = 30;  // mm
constexpr double fine_width = 6;            // mm of equal elements from the axis and the surface on

/// n equal elements to fine_width, then each longer than the one before: positions of the nodes.
std::vector<double> graded(int fine) {
  constexpr double growth = 1.5;
  const double h = fine_width / fine;
  std::vector<double> at;
  for (int i = 0; i <= fine; ++i) at.push_back(i * h);
  for (double step = growth * h; at.back() < size - 1e-9; step *= growth) {
    at.push_back(at.back() + 1.5 * step > size ? size : at.back() + step);
  }
  return at;
}

/// Quarter of the ball's pole: axis x = y = 0, surface z = −r²/2R at the top.
HexMesh pole(int fine) {
  const std::vector<double> at = graded(fine);
  const int n = int(at.size()) - 1;
  HexMesh mesh = fixtures::block({.elements = {n, n, n}, .size = Vec3(n, n, n)});
  for (Vec3& x : mesh.reference) {
    const double r_x = at[std::size_t(std::lround(x.x()))],
                 r_y = at[std::size_t(std::lround(x.y()))];
    const double depth = at[std::size_t(std::lround(n - x.z()))];
    const double sag = (r_x * r_x + r_y * r_y) / (2 * radius);
    x = Vec3(r_x, r_y, -depth - sag * (1 - depth / size));
  }
  mesh.imaged = mesh.points = mesh.reference;
  return mesh;
}

bool on_outer_face(const Vec3& x) {
  return x.x() > size - 1e-9 || x.y() > size - 1e-9 || x.z() < -size + 1e-9;
}

/// Displacement of an incompressible half-space z < 0 under a force F (µN) down at the origin.
Vec3 far_field(double force, double shear_modulus, const Vec3& x) {
  const double rho = x.norm(), depth = -x.z();
  const double scale = force / (4 * std::numbers::pi * shear_modulus);
  return {scale * depth * x.x() / (rho * rho * rho), scale * depth * x.y() / (rho * rho * rho),
          -scale * (1 / rho + depth * depth / (rho * rho * rho))};
}

struct Hertz {
  double approach = 0, force = 0, exact = 0;  ///< mm, µN of the whole ball
};

/// Forces at contact radii a (mm), approach a²/R.
std::vector<Hertz> press(int fine, const std::vector<double>& contact_radii) {
  const HexMesh mesh = pole(fine);
  MechanicsOptions options;
  options.materials = load_materials("wellman");  // neo-Hookean
  const double shear = options.materials.law(Tissue::fat).shear_modulus();
  Constraints held = fixtures::mirror_planes(mesh);
  std::vector<int> surface, outer;
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Vec3& x = mesh.reference[std::size_t(node)];
    if (on_outer_face(x)) {
      held.hold(node);
      outer.push_back(node);
    } else if (x.z() > -x.head<2>().squaredNorm() / (2 * radius) - 1e-9) {
      surface.push_back(node);
    }
  }
  fixtures::PressedBody body(mesh, options, held, surface, fixtures::wide_plates(-size, 0));
  std::vector<Hertz> results;
  for (const double a : contact_radii) {
    Hertz at;
    at.approach = a * a / radius;
    at.exact = 16.0 / 3 * shear * std::sqrt(radius) * std::pow(at.approach, 1.5);  // E* = 4 μ
    for (const int node : outer) {
      const Vec3& x = mesh.reference[std::size_t(node)];
      body.state.x.segment<3>(3L * node) = x + far_field(at.exact, shear, x);
    }
    body.plates.close_to(body.plates.initial_thickness - 2 * at.approach);  // both move by half
    const ContactStep step = body.solve(1e-9);
    EXPECT_TRUE(step.converged) << describe(step.stop) << " a " << a;
    for (const NodalContact& contact : step.contacts) at.force += 4 * contact.normal;
    results.push_back(at);
  }
  return results;
}

/// Slope of log force against log approach.
double exponent(const std::vector<Hertz>& results) {
  double sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (const Hertz& h : results) {
    const double x = std::log(h.approach), y = std::log(h.force);
    sx += x;
    sy += y;
    sxx += x * x;
    sxy += x * y;
  }
  const double n = double(results.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Mean of force over Hertz's, minus one.
double constant_error(const std::vector<Hertz>& results) {
  double sum = 0;
  for (const Hertz& h : results) sum += h.force / h.exact;
  return sum / double(results.size()) - 1;
}

}  // namespace

TEST(Hertz, ForceGrowsWithTheApproachToThreeHalvesAndTheRightConstant) {
  const std::vector<double> radii{3, 3.5, 4, 4.5, 5, 5.5};
  const std::vector<Hertz> coarse = press(3, radii), fine = press(6, radii);
  for (const Hertz& h : fine) {
    SCOPED_TRACE(h.approach);
    EXPECT_NEAR(h.force / h.exact, 1, 0.06);
  }
  RecordProperty("coarse", std::to_string(constant_error(coarse)));
  RecordProperty("fine", std::to_string(constant_error(fine)));
  RecordProperty("exponent", std::to_string(exponent(fine)));
  EXPECT_LT(std::abs(constant_error(fine)), 0.03);
  EXPECT_LT(std::abs(constant_error(fine)), 0.6 * std::abs(constant_error(coarse)));
  EXPECT_NEAR(exponent(fine), 1.5, 0.03);
}
