// SPDX-License-Identifier: GPL-3.0-or-later
// Torsion of a cylinder, inflation of a thick sphere and tube, bending of a block: exact solutions
// of finite elasticity for every W(I1, I2) (Rivlin 1948–49; Green and Zerna 1968), their forces by
// one-dimensional integrals, and the same states inverted by backward.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "fixtures/block.hpp"
#include "fixtures/elastic_scene.hpp"
#include "fixtures/in_place.hpp"
#include "fixtures/other_inverses.hpp"

namespace breast {
namespace {

const Law fat{"polynomial", {310, 300, 2250, 3800, 4720}};

// ∫ f over [low, high], Simpson's rule.
double integral(double low, double high, const std::function<double(double)>& f) {
  constexpr int steps = 200;
  const double h = (high - low) / steps;
  double sum = f(low) + f(high);
  for (int i = 1; i < steps; ++i) sum += (i % 2 ? 4 : 2) * f(low + i * h);
  return sum * h / 3;
}

LawValue law_at(double i1, double i2) {
  return fat.evaluate(i1, i2);
}

/// A body of n³ elements, how it is held, where every point goes, and one force with a closed form.
struct Exact {
  std::function<Vec3(const Vec3&)> shape;   ///< unit cube → reference; u = 0 is the wall
  std::function<Vec3(const Vec3&)> motion;  ///< reference → deformed
  std::function<bool(const Vec3&)> moved;   ///< at unit-cube points: all three components given
  /// Planes a node slides in (unit normals), at unit-cube points.
  std::function<std::vector<Vec3>(const Vec3&)> rollers = [](const Vec3&) {
    return std::vector<Vec3>{};
  };
  /// From a node's unit-cube point, position and reaction (µN) to its share of the measured force.
  std::function<double(const Vec3&, const Vec3&, const Vec3&)> share;
  double force = 0;  ///< closed form of the sum of the shares
};

struct Solved {
  double error_mm = 0;      ///< root mean square over the volume
  double force_error = 0;   ///< relative
  double inversion_mm = 0;  ///< worst node of backward's reference shape
  bool inverted = false;
};

bool is(double a, double b) {
  return std::abs(a - b) < 1e-9;
}

Constraints constraints_of(const Exact& exact, const std::vector<Vec3>& unit) {
  Constraints held(int(unit.size()));
  for (int i = 0; i < int(unit.size()); ++i) {
    const std::vector<Vec3> normals = exact.rollers(unit[i]);
    if (exact.moved(unit[i])) {
      held.hold(i);
    } else if (normals.size() == 1) {
      held.hold_normal(i, normals[0]);
    } else if (normals.size() == 2) {
      NodeConstraint line;
      line.axes.col(2) = normals[0].cross(normals[1]).normalized();
      line.axes.col(0) = normals[0];
      line.axes.col(1) = line.axes.col(2).cross(normals[0]);
      line.held = {true, true, false};
      held.set(i, line);
    }
  }
  return held;
}

double rms_error(const HexMesh& mesh, const Eigen::VectorXd& u,
                 const std::function<Vec3(const Vec3&)>& motion) {
  double square = 0, total = 0;
  const Eigen::VectorXd reference = flatten(mesh.reference);
  for (int e = 0; e < mesh.elements(); ++e) {
    const Eigen::Matrix3Xd from = fixtures::element_nodes(mesh, reference, e),
                           to = fixtures::element_nodes(mesh, u, e);
    fixtures::at_gauss_points(mesh, [&](const HexShape& shape, double weight) {
      const double volume = weight * (from * shape.gradients.transpose()).determinant();
      square += volume * (to * shape.values - motion(from * shape.values)).squaredNorm();
      total += volume;
    });
  }
  return std::sqrt(square / total);
}

// The state just solved and its nodal forces, given to backward with a wrong first guess.
void invert(const HexMesh& mesh, const Eigen::VectorXd& u, const Eigen::VectorXd& forces,
            Solved& out) {
  HexMesh inverse = mesh;
  inverse.imaged = unflatten(u);
  const std::vector<int> wall = nodes_of(mesh, mesh.pectoral_faces);
  for (int i = 0; i < mesh.nodes(); ++i) {
    if (std::binary_search(wall.begin(), wall.end(), i)) continue;
    inverse.reference[i] += 0.2 * (inverse.imaged[i] - mesh.reference[i]);
  }
  const SolveSummary summary =
      fixtures::backward_under_into(inverse, forces, fixtures::options_of(fat));
  out.inverted = summary.load_reached == 1;
  for (int i = 0; i < mesh.nodes(); ++i) {
    out.inversion_mm =
        std::max(out.inversion_mm, (inverse.reference[i] - mesh.reference[i]).norm());
  }
}

Solved solve(const Exact& exact, int n, int order, bool with_inverse) {
  fixtures::BlockSettings settings;
  settings.elements = {n, n, n};
  settings.size = Vec3::Ones();
  settings.order = order;
  HexMesh mesh = fixtures::block(settings);
  const std::vector<Vec3> unit = mesh.imaged;
  Eigen::VectorXd targets(3L * mesh.nodes());
  for (int i = 0; i < mesh.nodes(); ++i) {
    mesh.imaged[i] = exact.shape(unit[i]);
    targets.segment<3>(3L * i) = exact.motion(mesh.imaged[i]);
  }
  mesh.points = mesh.reference = mesh.imaged;
  const Scene scene(mesh, fixtures::options_of(fat, order == 1 ? Element::q1p0 : Element::q2p1));
  State state = scene.at_rest(flatten(mesh.reference));
  const EquilibriumResult result = fixtures::solve_held(
      scene, Eigen::VectorXd::Zero(targets.size()), constraints_of(exact, unit), targets, state);
  EXPECT_TRUE(result.converged) << result.reason;
  EXPECT_LE(result.iterations.size(), 9u);
  Solved out;
  out.error_mm = rms_error(mesh, state.x, exact.motion);
  double force = 0;
  for (int i = 0; i < mesh.nodes(); ++i) {
    force += exact.share(unit[i], state.x.segment<3>(3L * i), result.forces.r.segment<3>(3L * i));
  }
  out.force_error = std::abs(force / exact.force - 1);
  if (with_inverse) invert(mesh, state.x, result.forces.r, out);
  return out;
}

struct Bounds {
  double error_mm, force_error;  ///< of the finer mesh
};

// Orders between n and 2n, absolute bounds, and the inverse.
void check(const Exact& exact, Bounds linear, Bounds quadratic) {
  const Solved coarse = solve(exact, 4, 1, true), fine = solve(exact, 8, 1, false);
  EXPECT_NEAR(std::log2(coarse.error_mm / fine.error_mm), 2, 0.3);
  EXPECT_NEAR(std::log2(coarse.force_error / fine.force_error), 2, 0.5);
  EXPECT_LT(fine.error_mm, linear.error_mm);
  EXPECT_LT(fine.force_error, linear.force_error);
  EXPECT_TRUE(coarse.inverted);
  EXPECT_LT(coarse.inversion_mm, 1e-8);
  const Solved rough = solve(exact, 2, 2, false), smooth = solve(exact, 4, 2, false);
  EXPECT_GT(std::log2(rough.error_mm / smooth.error_mm), 2.6);
  EXPECT_LT(smooth.error_mm, quadratic.error_mm);
  EXPECT_LT(smooth.force_error, quadratic.force_error);
}

Exact torsion(bool axial) {
  constexpr double radius = 20, length = 20, twist = 0.025;  // mm, mm, 1/mm
  Exact exact;
  exact.shape = [](const Vec3& u) {
    const double a = 2 * u.y() - 1, b = 2 * u.z() - 1;
    return Vec3(radius * a * std::sqrt(1 - b * b / 2), radius * b * std::sqrt(1 - a * a / 2),
                length * u.x());
  };
  exact.motion = [](const Vec3& x) {
    return Vec3(Eigen::AngleAxisd(twist * x.z(), Vec3::UnitZ()) * x);
  };
  exact.moved = [](const Vec3& u) { return is(u.x(), 0) || is(u.x(), 1); };
  const auto over_disc = [](const std::function<double(double, const LawValue&)>& f) {
    return integral(0, radius, [&](double r) {
      const double i = 3 + twist * twist * r * r;
      return r * r * r * f(r, law_at(i, i));
    });
  };
  if (axial) {
    exact.force = -2 * std::numbers::pi * twist * twist *
                  over_disc([](double, const LawValue& w) { return w.w1 + 2 * w.w2; });
    exact.share = [](const Vec3& u, const Vec3&, const Vec3& f) {
      return is(u.x(), 1) ? f.z() : 0;
    };
  } else {
    exact.force = 4 * std::numbers::pi * twist *
                  over_disc([](double, const LawValue& w) { return w.w1 + w.w2; });
    exact.share = [](const Vec3& u, const Vec3& x, const Vec3& f) {
      return is(u.x(), 1) ? x.x() * f.y() - x.y() * f.x() : 0;
    };
  }
  return exact;
}

// Sector of a hollow sphere between planes through its centre; the inner surface is moved.
Exact sphere() {
  constexpr double inner = 10, outer = 20, blown = 12, slope = 0.5;
  const double grown = std::pow(blown, 3) - std::pow(inner, 3);
  Exact exact;
  exact.shape = [](const Vec3& u) {
    const Vec3 towards(1, slope * (2 * u.y() - 1), slope * (2 * u.z() - 1));
    return Vec3((inner + (outer - inner) * u.x()) * towards.normalized());
  };
  exact.motion = [grown](const Vec3& x) {
    const double r = x.norm();
    return Vec3(x * (std::cbrt(r * r * r + grown) / r));
  };
  exact.moved = [](const Vec3& u) { return is(u.x(), 0); };
  exact.rollers = [](const Vec3& u) {
    std::vector<Vec3> normals;
    if (is(u.y(), 0) || is(u.y(), 1))
      normals.push_back(Vec3(is(u.y(), 0) ? slope : -slope, 1, 0).normalized());
    if (is(u.z(), 0) || is(u.z(), 1))
      normals.push_back(Vec3(is(u.z(), 0) ? slope : -slope, 0, 1).normalized());
    return normals;
  };
  exact.share = [](const Vec3& u, const Vec3& x, const Vec3& f) {
    return is(u.x(), 0) ? f.dot(x.normalized()) : 0;
  };
  const double pressure =
      integral(std::cbrt(std::pow(outer, 3) + grown) / outer, blown / inner, [](double l) {
        const LawValue w = law_at(2 * l * l + std::pow(l, -4), 2 / (l * l) + std::pow(l, 4));
        return 4 * (l - std::pow(l, -5)) * (w.w1 + l * l * w.w2) / (l * l * l - 1);
      });
  const double angle = 4 * std::atan(slope * slope / std::sqrt(1 + 2 * slope * slope));  // solid
  exact.force = pressure * blown * blown * angle;
  return exact;
}

// Sector of a thick tube in plane strain.
Exact tube() {
  constexpr double inner = 10, outer = 20, blown = 12, angle = 0.8, length = 10;
  const double grown = blown * blown - inner * inner;
  Exact exact;
  exact.shape = [](const Vec3& u) {
    const double r = inner + (outer - inner) * u.x(), theta = angle * u.y();
    return Vec3(r * std::cos(theta), r * std::sin(theta), length * u.z());
  };
  exact.motion = [grown](const Vec3& x) {
    const double r = std::hypot(x.x(), x.y()), factor = std::sqrt(r * r + grown) / r;
    return Vec3(x.x() * factor, x.y() * factor, x.z());
  };
  exact.moved = [](const Vec3& u) { return is(u.x(), 0); };
  exact.rollers = [](const Vec3& u) {
    std::vector<Vec3> normals;
    if (is(u.y(), 0)) normals.push_back(Vec3::UnitY());
    if (is(u.y(), 1)) normals.push_back(Vec3(-std::sin(angle), std::cos(angle), 0));
    if (is(u.z(), 0) || is(u.z(), 1)) normals.push_back(Vec3::UnitZ());
    return normals;
  };
  exact.share = [](const Vec3& u, const Vec3& x, const Vec3& f) {
    return is(u.x(), 0) ? f.dot(Vec3(x.x(), x.y(), 0).normalized()) : 0;
  };
  const double pressure =
      integral(std::sqrt(outer * outer + grown) / outer, blown / inner, [](double l) {
        const double i = 1 + l * l + 1 / (l * l);
        const LawValue w = law_at(i, i);
        return 2 * (l - std::pow(l, -3)) * (w.w1 + w.w2) / (l * l - 1);
      });
  exact.force = pressure * blown * angle * length;
  return exact;
}

// A block of thickness 10 bent by end moments into a sector, plane strain;
// its curved faces are free.
Exact bending() {
  constexpr double thick = 10, half = 15, width = 10, alpha = 1.0 / 30;
  const double beta = std::sqrt(std::pow(alpha, -4) + thick * thick / (alpha * alpha));
  const double low = std::sqrt(beta - thick / alpha), high = std::sqrt(beta + thick / alpha);
  Exact exact;
  exact.shape = [](const Vec3& u) {
    return Vec3(thick * (u.z() - 0.5), half * (2 * u.x() - 1), width * u.y());
  };
  exact.motion = [beta](const Vec3& x) {
    const double r = std::sqrt(2 * x.x() / alpha + beta);
    return Vec3(r * std::cos(alpha * x.y()), r * std::sin(alpha * x.y()), x.z());
  };
  exact.moved = [](const Vec3& u) { return is(u.x(), 0) || is(u.x(), 1); };
  exact.rollers = [](const Vec3& u) {
    std::vector<Vec3> normals;
    if (is(u.y(), 0) || is(u.y(), 1)) normals.push_back(Vec3::UnitZ());
    return normals;
  };
  exact.share = [](const Vec3& u, const Vec3& x, const Vec3& f) {
    return is(u.x(), 1) ? x.x() * f.y() - x.y() * f.x() : 0;
  };
  const auto energy = [](double r) {
    const double l = alpha * r, i = 1 + l * l + 1 / (l * l);
    return law_at(i, i).w;
  };
  exact.force =
      -width * integral(low, high, [&](double r) { return r * (energy(r) - energy(low)); });
  return exact;
}

TEST(Curved, TorsionOfACylinder) {
  check(torsion(false), {0.05, 0.03}, {0.005, 1e-3});
}
TEST(Curved, AxialForceOfTorsion) {  // the Poynting effect
  const Exact exact = torsion(true);
  EXPECT_LT(solve(exact, 8, 1, false).force_error, 0.1);
  EXPECT_LT(solve(exact, 4, 2, false).force_error, 0.01);
}
TEST(Curved, InflationOfASphere) {
  check(sphere(), {0.02, 0.02}, {0.001, 2e-3});
}
TEST(Curved, InflationOfATube) {
  check(tube(), {0.02, 0.02}, {0.001, 2e-3});
}
TEST(Curved, BendingOfABlock) {
  check(bending(), {0.05, 0.07}, {0.004, 0.008});
}

}  // namespace
}  // namespace breast
