// Exact and manufactured solutions: patch test, homogeneous deformations, orders of convergence.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <functional>

#include "fem/hex_kernel.hpp"
#include "fem/stress.hpp"
#include "fixtures/block.hpp"
#include "fixtures/laws.hpp"
#include "mechanics/element_order.hpp"
#include "mechanics/scene.hpp"

namespace breast {
namespace {

MechanicsOptions options_of(const Law& law, Element element, Invariants invariants) {
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  for (Law& each : options.materials.laws) each = law;
  options.element = element;
  options.invariants = invariants;
  return options;
}

// Five-point Gauss rule on [-1, 1].
constexpr double gauss_at[5] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                                0.9061798459386640};
constexpr double gauss_weight[5] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                    0.4786286704993665, 0.2369268850561891};

template <class Visit>
void at_gauss_points(const HexMesh& mesh, const Visit& visit) {
  for (int q = 0; q < 125; ++q) {
    const Vec3 local(gauss_at[q % 5], gauss_at[q / 5 % 5], gauss_at[q / 25]);
    const double weight = gauss_weight[q % 5] * gauss_weight[q / 5 % 5] * gauss_weight[q / 25];
    visit(hex_shape(mesh.order, local), weight);
  }
}

Eigen::Matrix3Xd element_nodes(const HexMesh& mesh, const Eigen::VectorXd& nodal, int e) {
  Eigen::Matrix3Xd x(3, mesh.nodes_per_element());
  for (int a = 0; a < x.cols(); ++a) x.col(a) = nodal.segment<3>(3L * mesh.element(e)[a]);
  return x;
}

// f_a = ∫ P(F, p) ∇N_a dV of the exact solution: body force and tractions at once.
Eigen::VectorXd exact_load(const HexMesh& mesh, const Law& law, bool isochoric,
                           const std::function<Mat3(const Vec3&)>& gradient,
                           const std::function<double(const Vec3&)>& pressure) {
  Eigen::VectorXd load = Eigen::VectorXd::Zero(3L * mesh.nodes());
  const Eigen::VectorXd reference = flatten(mesh.reference);
  for (int e = 0; e < mesh.elements(); ++e) {
    const Eigen::Matrix3Xd x = element_nodes(mesh, reference, e);
    at_gauss_points(mesh, [&](const HexShape& shape, double weight) {
      const Mat3 jacobian = x * shape.gradients.transpose();
      const Vec3 at = x * shape.values;
      const Mat3 f = gradient(at), c = f.transpose() * f;
      Stress stress;
      law_stress(law, isochoric, c, f.determinant(), false, stress);
      add_pressure(pressure(at), c, f.determinant(), false, stress);
      const Eigen::Matrix3Xd force =
          f * from_voigt(stress.s) *
          (shape.gradients.transpose() * jacobian.inverse()).transpose() *
          (weight * jacobian.determinant());
      for (int a = 0; a < x.cols(); ++a) load.segment<3>(3L * mesh.element(e)[a]) += force.col(a);
    });
  }
  return load;
}

// Solves from `state` under a load with the wall x = 0 moved to its prescribed positions.
NewtonResult solve_loaded(const Scene& scene, const Eigen::VectorXd& load,
                          const Eigen::VectorXd& targets, SaddleState& state) {
  const ForwardProblem problem(scene, flatten(scene.mesh().reference), load);
  SaddleMatrix matrix = problem.make_matrix();
  SaddleSolver solver(problem.pattern());
  return newton(problem, solver, matrix, scene.walls(), &targets, state);
}

// ∂²W/∂(ln J)² of the plain form at rest, Pa.
double plain_bulk_stiffness(const Law& law) {
  const LawValue w = law.evaluate(3, 3);
  return 4 * w.w11 + 16 * w.w12 + 16 * w.w22 + (4 * w.w2 - 2 * w.w1) / 3;
}

// An affine motion without volume change is reproduced on a distorted mesh by every law and
// element.
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
    for (const Law& law : laws()) {
      for (const Invariants invariants : {Invariants::isochoric, Invariants::plain}) {
        // With a negative pointwise bulk stiffness the plain form is unstable between Gauss points.
        if (invariants == Invariants::plain && plain_bulk_stiffness(law) < 0) continue;
        const Scene scene(mesh,
                          options_of(law, order == 1 ? Element::q1p0 : Element::q2p1, invariants));
        SaddleState state{exact, scene.assembly().rest_pressure()};
        for (long i = 0; i < exact.size(); ++i) state.u[i] += 0.2 * fixtures::noise(int(i));
        const double extra = -100;  // a pull, so that the dead tractions are stable
        const bool isochoric = invariants == Invariants::isochoric;
        const double rest = scene.assembly().rest_pressure()[0];
        const Eigen::VectorXd load = exact_load(
            mesh, law, isochoric, [&](const Vec3&) { return f; },
            [&](const Vec3&) { return rest + extra; });
        const NewtonResult result = solve_loaded(scene, load, exact, state);
        EXPECT_TRUE(result.converged) << law.describe() << ": " << result.reason;
        EXPECT_LT((state.u - exact).lpNorm<Eigen::Infinity>(), 1e-8)
            << law.describe() << " order " << order;
        for (const double p : scene.assembly().mean_pressure(state.p)) {
          EXPECT_NEAR(p, rest + extra, 1e-5) << law.describe() << " order " << order;
        }
      }
    }
  }
}

// Uniaxial stretch between rollers: P = 2(λ − λ⁻²)(W1 + W2/λ).
TEST(Exact, UniaxialForceOfEveryLaw) {
  const double stretch = 0.75, side = 20;
  for (const int order : {1, 2}) {
    fixtures::BlockSettings settings;
    settings.elements = {2, 2, 2};
    settings.size = Vec3(side, side, side);
    settings.distortion = 0.1;
    settings.order = order;
    const HexMesh mesh = fixtures::block(settings);
    for (const Law& law : laws()) {
      const Scene scene(
          mesh, options_of(law, order == 1 ? Element::q1p0 : Element::q2p1, Invariants::isochoric));
      const ForwardProblem problem(scene, flatten(mesh.reference),
                                   Eigen::VectorXd::Zero(3L * mesh.nodes()));
      Constraints held(mesh.nodes());
      Eigen::VectorXd targets = flatten(mesh.reference);
      for (int i = 0; i < mesh.nodes(); ++i) {
        NodeConstraint c;
        const Vec3& x = mesh.reference[i];
        for (int k = 0; k < 3; ++k) c.held[k] = std::abs(x[k]) < 1e-9;
        if (std::abs(x.x() - side) < 1e-9) {
          c.held[0] = true;
          targets[3L * i] = stretch * side;
        }
        if (c.held[0] || c.held[1] || c.held[2]) held.set(i, c);
      }
      SaddleState state{flatten(mesh.reference), scene.assembly().rest_pressure()};
      SaddleMatrix matrix = problem.make_matrix();
      SaddleSolver solver(problem.pattern());
      const NewtonResult result = newton(problem, solver, matrix, held, &targets, state);
      ASSERT_TRUE(result.converged) << law.describe() << ": " << result.reason;
      double force = 0;
      for (int i = 0; i < mesh.nodes(); ++i) {
        if (std::abs(mesh.reference[i].x() - side) < 1e-9) force += result.forces.r[3L * i];
      }
      const LawValue w =
          law.evaluate(stretch * stretch + 2 / stretch, 2 * stretch + 1 / (stretch * stretch));
      const double exact =
          side * side * 2 * (stretch - 1 / (stretch * stretch)) * (w.w1 + w.w2 / stretch);
      EXPECT_NEAR(force, exact, 1e-8 * std::abs(exact)) << law.describe();
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
  static Mat3 gradient(const Vec3& at) {
    Mat3 f;
    for (int k = 0; k < 3; ++k) {
      const double h = 1e-3;
      const Vec3 e = h * Vec3::Unit(k);
      f.col(k) = (8 * (map(at + e) - map(at - e)) - (map(at + 2 * e) - map(at - 2 * e))) / (12 * h);
    }
    return f;
  }
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
    at_gauss_points(mesh, [&](const HexShape& shape, double weight) {
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
  SaddleState state{flatten(mesh.reference), scene.assembly().rest_pressure()};
  const NewtonResult result = solve_loaded(
      scene, exact_load(mesh, law, true, Manufactured::gradient, Manufactured::pressure), targets,
      state);
  EXPECT_TRUE(result.converged) << result.reason;
  return field_error(mesh, state.u);
}

double order_of(double coarse, double fine) {
  return std::log2(coarse / fine);
}

TEST(Convergence, LinearElement) {
  const Law& law = laws()[0];
  const FieldError coarse = manufactured_error(5, 1, law), fine = manufactured_error(10, 1, law);
  EXPECT_NEAR(order_of(coarse.l2, fine.l2), 2, 0.2);
  EXPECT_NEAR(order_of(coarse.h1, fine.h1), 1, 0.2);
  EXPECT_LT(fine.l2, 0.02 * std::pow(Manufactured::side, 1.5));
}

TEST(Convergence, QuadraticElement) {
  const Law& law = laws()[3];
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
  const MechanicsOptions options = options_of(laws()[0], Element::q1p0, Invariants::isochoric);
  const SolveSummary summary = solve_forward(mesh, Vec3(0, 3000, -9000), options);
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
