// SPDX-License-Identifier: GPL-3.0-or-later
// Exact and manufactured solutions: patch test, homogeneous deformations, orders of convergence.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "fem/stress.hpp"
#include "fixtures/block.hpp"
#include "fixtures/elastic_scene.hpp"
#include "fixtures/in_place.hpp"
#include "fixtures/laws.hpp"
#include "fixtures/map_gradient.hpp"
#include "mechanics/scene.hpp"
#include "mesh/element_order.hpp"

namespace breast {
namespace {

using fixtures::element_nodes, fixtures::options_of;

// First Piola–Kirchhoff stress of a deformation and a pressure.
Mat3 stress_of(const Law& law, bool isochoric, const Mat3& f, double pressure) {
  const Mat3 c = f.transpose() * f;
  Stress stress;
  law_stress(law, isochoric, c, f.determinant(), false, stress);
  add_pressure(pressure, c, f.determinant(), false, stress);
  return f * from_voigt(stress.s);
}

// ∂²W/∂(ln J)² of the plain form at rest, Pa.
double plain_bulk_stiffness(const Law& law) {
  const LawValue w = law.evaluate(3, 3);
  return 4 * w.w11 + 16 * w.w12 + 16 * w.w22 + (4 * w.w2 - 2 * w.w1) / 3;
}

// An affine motion without volume change is reproduced on a distorted mesh
// by every law and element.
TEST(Patch, AffineMotionOnDistortedMesh) {
  Mat3 f;
  f << 1.1, 0.15, -0.05, 0.04, 0.95, 0.1, 0.08, -0.06, 1.02;
  f /= std::cbrt(f.determinant());
  for (const int order : {1, 2}) {
    fixtures::BlockSettings settings;
    settings.elements = {3, 3, 3};
    settings.size = Vec3(30, 30, 30);
    settings.distortion = order == 1 ? 0.2 : 0.15;
    settings.order = order;
    const HexMesh mesh = fixtures::block(settings);
    Eigen::VectorXd exact = flatten(mesh.reference);
    for (int i = 0; i < mesh.nodes(); ++i) exact.segment<3>(3L * i) = f * mesh.reference[i];
    for (const Law& law : every_law()) {
      for (const Invariants invariants : {Invariants::isochoric, Invariants::plain}) {
        // With a negative pointwise bulk stiffness the plain form is unstable between Gauss points.
        if (invariants == Invariants::plain && plain_bulk_stiffness(law) < 0) continue;
        const Scene scene(mesh,
                          options_of(law, order == 1 ? Element::q1p0 : Element::q2p1, invariants));
        State state{flatten(mesh.reference), exact, scene.solid().rest_pressure()};
        for (long i = 0; i < exact.size(); ++i) state.x[i] += 0.2 * fixtures::noise(int(i));
        const double extra = -100;  // a pull, so that the dead tractions are stable
        const bool isochoric = invariants == Invariants::isochoric;
        const double rest = scene.solid().rest_pressure()[0];
        const Mat3 stress = stress_of(law, isochoric, f, rest + extra);
        const Eigen::VectorXd load =
            fixtures::exact_load(mesh, [&](const Vec3&) { return stress; });
        const NewtonResult result = fixtures::solve_held(scene, load, scene.walls(), exact, state);
        EXPECT_TRUE(result.converged) << law.describe() << ": " << result.reason;
        EXPECT_LT((state.x - exact).lpNorm<Eigen::Infinity>(), 1e-8)
            << law.describe() << " order " << order;
        for (const double p : scene.solid().mean_pressure(state.p)) {
          EXPECT_NEAR(p, rest + extra, 1e-5) << law.describe() << " order " << order;
        }
      }
    }
  }
}

// Composition of shears: det F = 1 everywhere, by construction.
struct Manufactured {
  static constexpr double side = 40, a = 1.0;
  static Vec3 map(const Vec3& at) {
    const double k = 3.0 / side;
    Vec3 x = at;
    x.x() += a * std::sin(k * x.y() + 0.3) * std::cos(k * x.z());
    x.y() += a * std::sin(k * x.x()) * std::cos(k * x.z() + 0.2);
    x.z() += a * std::sin(k * x.x() + 0.1) * std::sin(k * x.y());
    return x;
  }
  static Mat3 gradient(const Vec3& at) { return fixtures::map_gradient(map, at); }
  static double pressure(const Vec3& at) {
    return 400 * std::cos(2 * at.x() / side) * at.z() / side;
  }
};

struct FieldError {
  double l2 = 0, h1 = 0;
};
FieldError field_error(const HexMesh& mesh, const Eigen::VectorXd& solved) {
  FieldError error;
  const Eigen::VectorXd reference = flatten(mesh.reference);
  for (int e = 0; e < mesh.elements(); ++e) {
    const Eigen::Matrix3Xd x = element_nodes(mesh, reference, e),
                           u = element_nodes(mesh, solved, e);
    fixtures::at_gauss_points(mesh, [&](const HexShape& shape, double weight) {
      const Mat3 jacobian = x * shape.gradients.transpose();
      const Vec3 at = x * shape.values;
      const double volume = weight * jacobian.determinant();
      const Mat3 f = u * shape.gradients.transpose() * jacobian.inverse();
      error.l2 += volume * (u * shape.values - Manufactured::map(at)).squaredNorm();
      error.h1 += volume * (f - Manufactured::gradient(at)).squaredNorm();
    });
  }
  return {std::sqrt(error.l2), std::sqrt(error.h1)};
}

FieldError manufactured_error(int n, int order, const Law& law) {
  fixtures::BlockSettings settings;
  settings.elements = {n, n, n};
  settings.size = Vec3::Constant(Manufactured::side);
  settings.order = order;
  const HexMesh mesh = fixtures::block(settings);
  const Scene scene(
      mesh, options_of(law, order == 1 ? Element::q1p0 : Element::q2p1, Invariants::isochoric));
  Eigen::VectorXd targets(3L * mesh.nodes());
  for (int i = 0; i < mesh.nodes(); ++i)
    targets.segment<3>(3L * i) = Manufactured::map(mesh.reference[i]);
  State state = scene.at_rest(flatten(mesh.reference));
  const Eigen::VectorXd load = fixtures::exact_load(mesh, [&](const Vec3& at) {
    return stress_of(law, true, Manufactured::gradient(at), Manufactured::pressure(at));
  });
  const NewtonResult result = fixtures::solve_held(scene, load, scene.walls(), targets, state);
  EXPECT_TRUE(result.converged) << result.reason;
  return field_error(mesh, state.x);
}

double order_of(double coarse, double fine) {
  return std::log2(coarse / fine);
}

TEST(Convergence, LinearElement) {
  const Law& law = every_law()[0];
  const FieldError coarse = manufactured_error(5, 1, law), fine = manufactured_error(10, 1, law);
  EXPECT_NEAR(order_of(coarse.l2, fine.l2), 2, 0.2);
  EXPECT_NEAR(order_of(coarse.h1, fine.h1), 1, 0.2);
  EXPECT_LT(fine.l2, 0.02 * std::pow(Manufactured::side, 1.5));
}

TEST(Convergence, QuadraticElement) {
  const Law& law = every_law()[3];
  const FieldError coarse = manufactured_error(4, 2, law), fine = manufactured_error(8, 2, law);
  EXPECT_NEAR(order_of(coarse.l2, fine.l2), 3, 0.3);
  EXPECT_NEAR(order_of(coarse.h1, fine.h1), 2, 0.25);
  EXPECT_LT(fine.l2, manufactured_error(14, 1, law).l2);  // with about the same nodes, better
}

// Volume is kept to rounding in every element although the solver goes through a penalty.
TEST(Exact, VolumeOfEveryElement) {
  fixtures::BlockSettings settings;
  settings.distortion = 0.15;
  HexMesh mesh = fixtures::block(settings);
  const MechanicsOptions options = options_of(every_law()[0], Element::q1p0, Invariants::isochoric);
  const SolveSummary summary = fixtures::forward_into(mesh, Vec3(0, 3000, -9000), options);
  ASSERT_TRUE(summary.converged());
  EXPECT_LT(summary.max_volume_error, 1e-10);
  EXPECT_LT(summary.residual, 1e-10);
}

TEST(RaisedOrder, IsTheSameBody) {
  fixtures::BlockSettings settings;
  settings.distortion = 0.2;
  settings.skin_mm = 1;
  const HexMesh mesh = fixtures::block(settings), raised = raise_order(mesh);
  EXPECT_EQ(raised.nodes(), 9 * 9 * 9);
  EXPECT_EQ(boundary_faces(raised).size(), boundary_faces(mesh).size());
  for (int e = 0; e < mesh.elements(); e += 7) {
    const Vec3 local(0.3, -0.7, 0.2);
    EXPECT_LT((element_position(mesh, mesh.imaged, e, local) -
               element_position(raised, raised.imaged, e, local))
                  .norm(),
              1e-12);
  }
}

}  // namespace
}  // namespace breast
