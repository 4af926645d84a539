// SPDX-License-Identifier: GPL-3.0-or-later
// A body pressed on a curved wall and drawn along it, against an exact motion; and sliding that does
// not depend on how nodes are numbered.
#include <gtest/gtest.h>

#include <cmath>

#include "core/units.hpp"
#include "fem/stress.hpp"
#include "fixtures/elastic_scene.hpp"
#include "fixtures/in_place.hpp"
#include "fixtures/map_gradient.hpp"
#include "fixtures/renumbered.hpp"
#include "fixtures/sliding_cap.hpp"

namespace breast {
namespace {

// A sector of a ring about z: every circle turns by an angle of its own, the inner one, which lies on
// the wall, by up to 11 mm. No volume changes. The pressure presses the ring on the wall.
struct Drawn {
  static constexpr double inner = 50, outer = 70, arc = 0.9, length = 24;
  static double angle(double r, double z) {
    return 0.12 + 0.3 * std::pow((r - inner) / inner, 2) + 0.1 * std::sin(2 * z / length);
  }
  static Vec3 map(const Vec3& at) {
    const double turn = angle(std::hypot(at.x(), at.y()), at.z());
    const double c = std::cos(turn), s = std::sin(turn);
    return {c * at.x() - s * at.y(), s * at.x() + c * at.y(), at.z()};
  }
  static Mat3 gradient(const Vec3& at) { return fixtures::map_gradient(map, at); }
  static double pressure(const Vec3& at) { return 600 + 200 * std::cos(3 * at.z() / length); }
};

HexMesh ring(int n) {
  fixtures::BlockSettings settings;
  settings.elements = {n, 3 * n, n};
  settings.size = Vec3(Drawn::outer - Drawn::inner, Drawn::arc, Drawn::length);
  HexMesh mesh = fixtures::block(settings);  // its wall becomes the inner cylinder
  for (Vec3& p : mesh.imaged) {
    const double r = Drawn::inner + p.x();
    p = Vec3(r * std::cos(p.y()), r * std::sin(p.y()), p.z());
  }
  mesh.points = mesh.reference = mesh.imaged;
  return mesh;
}

/// Root mean square of the nodes' distances from their exact places (mm). Nodes of the outer face go
/// to theirs; everything else follows, pressed on the wall with forces that leave out the wall's own.
double distance_from_exact(int n) {
  const HexMesh mesh = ring(n);
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  fixtures::let_slide(options, std::make_shared<fixtures::Cylinder>(Drawn::inner), 0);
  const Law fat = options.materials.law(Tissue::fat);
  Eigen::VectorXd load = fixtures::exact_load(mesh, [&](const Vec3& at) {
    const Mat3 f = Drawn::gradient(at), c = f.transpose() * f;
    Stress stress;
    law_stress(fat, true, c, f.determinant(), false, stress);
    add_pressure(Drawn::pressure(at), c, f.determinant(), false, stress);
    return Mat3(f * from_voigt(stress.s));
  });
  double pressed = 0;
  for (const int node : nodes_of(mesh, mesh.pectoral_faces)) {
    Vec3 out = Drawn::map(mesh.reference[std::size_t(node)]);
    out.z() = 0;
    out.normalize();
    auto force = load.segment<3>(3L * node);
    pressed = std::max(pressed, std::abs(force.dot(out)));
    force -= force.dot(out) * out;
  }
  const double most = load.lpNorm<Eigen::Infinity>();
  EXPECT_GT(pressed, 0.03 * most);  // the wall carries forces worth turning

  const Scene scene(mesh, options);
  Constraints held(mesh.nodes());
  Eigen::VectorXd exact(3L * mesh.nodes());
  for (int node = 0; node < mesh.nodes(); ++node) {
    const Vec3& x = mesh.reference[std::size_t(node)];
    exact.segment<3>(3L * node) = Drawn::map(x);
    if (std::hypot(x.x(), x.y()) > Drawn::outer - 1e-9) held.hold(node);
  }
  State state = scene.at_rest(flatten(mesh.reference));
  const EquilibriumResult result = fixtures::solve_held(scene, load, held, exact, state);
  EXPECT_TRUE(result.converged) << result.reason;
  double off = 0, slid = 0;
  for (const int node : nodes_of(mesh, mesh.pectoral_faces)) {
    const Vec3 x = state.x.segment<3>(3L * node);
    off = std::max(off, std::abs(std::hypot(x.x(), x.y()) - Drawn::inner));
    slid = std::max(slid, (x - mesh.reference[std::size_t(node)]).norm());
  }
  EXPECT_LT(off, 1e-9);
  EXPECT_GT(slid, 5);
  return (state.x - exact).norm() / std::sqrt(double(mesh.nodes()));
}

// Linear elements: second order in the mesh size, on a curved wall as elsewhere.
TEST(CurvedWall, SecondOrderOfABodyPressedAlongIt) {
  const double coarse = distance_from_exact(2), middle = distance_from_exact(4),
               fine = distance_from_exact(8);
  EXPECT_NEAR(std::log2(coarse / middle), 2, 0.4);
  EXPECT_NEAR(std::log2(middle / fine), 2, 0.25);
  EXPECT_LT(fine, 0.02);
}

TEST(CurvedWall, NumberingDoesNotMatter) {
  const Vec3 prone(0, -gravity_mm_s2, 0), oblique(4000, 7000, 3000);
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  scale_materials(options.materials, {"fat=20", "fibroglandular=20"});
  fixtures::let_slide(options, fixtures::sphere(), 0.02);
  options.cut = cut_support("spring:0.01");
  HexMesh a = fixtures::cap_on_sphere();
  auto [b, nodes] = fixtures::renumbered(a);
  for (HexMesh* mesh : {&a, &b}) {
    ASSERT_TRUE(fixtures::backward_into(*mesh, prone, options).converged());
    ASSERT_TRUE(fixtures::forward_into(*mesh, oblique, options).converged());
  }
  for (int i = 0; i < a.nodes(); ++i) {
    const std::size_t before = std::size_t(nodes[std::size_t(i)]), now = std::size_t(i);
    EXPECT_LT((b.reference[now] - a.reference[before]).norm(), 1e-9);
    EXPECT_LT((b.points[now] - a.points[before]).norm(), 1e-9);
  }
}

}  // namespace
}  // namespace breast
