// SPDX-License-Identifier: GPL-3.0-or-later
// Every term against finite differences: forces against energy, tangents against forces. A new term
// is tested by being added to the list.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <functional>
#include <set>

#include "contact/terms/friction.hpp"
#include "contact/terms/plate.hpp"
#include "contact/terms/surface_pressure.hpp"
#include "fixtures/block.hpp"
#include "fixtures/level_surfaces.hpp"
#include "fixtures/wide_plates.hpp"
#include "mechanics/scene.hpp"
#include "mechanics/terms/attachment.hpp"
#include "mechanics/terms/membrane.hpp"
#include "mesh/element_order.hpp"
#include "solve/problem.hpp"

namespace breast {
namespace {

/// A term at a state, with what it belongs to.
struct Case {
  HexMesh mesh;
  std::unique_ptr<Scene> scene;
  std::shared_ptr<const Term> term;
  State state;
  std::function<Eigen::VectorXd(const Eigen::VectorXd&)> directions;  ///< those that are tested
  bool energy_sees_reference = true;
};

struct Named {
  std::string name;
  std::function<Case()> make;
};
void PrintTo(const Named& named, std::ostream* out) {
  *out << named.name;
}

Case body(Element element, double bulk_ratio, Invariants invariants, bool curved,
          const std::string& wall = "spring:0.5,0.2", double corner_bulk = 0) {
  fixtures::BlockSettings settings;
  settings.elements = {2, 2, 2};
  settings.size = Vec3(20, 20, 20);
  settings.distortion = 0.2;
  settings.order = element == Element::q1p0 ? 1 : 2;
  settings.skin_mm = 1;
  Case out;
  out.mesh = fixtures::block(settings);
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  options.materials.corner_bulk.fill(corner_bulk);
  options.element = element;
  options.bulk_ratio = bulk_ratio;
  options.invariants = invariants;
  options.wall = wall_support(wall);
  if (curved) {
    // The wall x = 0 as a sphere, and skin that wrinkles.
    options.wall_surface = std::make_shared<fixtures::Sphere>(Vec3(-60, 10, 10), 60);
    options.materials.skin = {0.05, 0.02, 0.03};
  }
  out.scene = std::make_unique<Scene>(out.mesh, options);
  out.state = out.scene->at_rest(flatten(out.mesh.reference));
  for (long i = 0; i < out.state.x.size(); ++i) {
    out.state.x[i] += 0.3 * fixtures::noise(int(i));
    out.state.reference[i] += 0.1 * fixtures::noise(int(i) + 999);
  }
  for (long i = 0; i < out.state.p.size(); ++i) out.state.p[i] += 50 * fixtures::noise(int(i) + 5);
  return out;
}

Case term_of_scene(const std::string& name, Element element = Element::q1p0, double bulk_ratio = 0,
                   Invariants invariants = Invariants::isochoric, bool curved = false) {
  Case out = body(element, bulk_ratio, invariants, curved);
  const Eigen::VectorXd load = out.scene->gravity_force(Vec3(100, -9000, 400));
  const LoadedProblem loaded = out.scene->problem(load);
  for (const auto& term : loaded.problem.terms()) {
    if (term->name() == name) out.term = term;
  }
  return out;
}

Case corner_volume(Element element) {
  Case out = body(element, 0, Invariants::isochoric, false, "spring:0.5,0.2", 3000);
  const LoadedProblem loaded = out.scene->problem(Eigen::VectorXd::Zero(3L * out.mesh.nodes()));
  for (const auto& term : loaded.problem.terms()) {
    if (term->name() == "corner volume") out.term = term;
  }
  return out;
}

/// The term of a support of the wall.
Case term_of_wall(const std::string& name, const std::string& wall) {
  Case out = body(Element::q1p0, 0, Invariants::isochoric, false, wall);
  for (const auto& springs : out.scene->supports().springs) {
    if (springs.term->name() == name) out.term = springs.term;
  }
  return out;
}

// Nodes that it does not pull, that it begins to pull, and that it pulls with its full stiffness.
Case attachment() {
  Case out = body(Element::q1p0, 0, Invariants::isochoric, false);
  const Vec3 towards = Vec3(0.6, -0.3, 0.8).normalized();
  for (int n = 0; n < out.mesh.nodes(); ++n) {
    out.state.x.segment<3>(3L * n) -= 0.7 * (n % 4 - 1) * towards;
  }
  out.term = std::make_shared<Attachment>(out.mesh, out.mesh.pectoral_faces, 0.2, towards,
                                          [](const Vec3&, const Vec3&) { return 1.0; });
  return out;
}

/// The skin nodes at the top of the block, near a paddle whose edge runs through the middle of them.
std::vector<int> top_nodes(const HexMesh& mesh) {
  std::vector<int> nodes;
  for (int n = 0; n < mesh.nodes(); ++n) {
    if (mesh.reference[std::size_t(n)].z() > 19.9) nodes.push_back(n);
  }
  return nodes;
}

PlatePair plates_at_the_top(double edge_radius) {
  Plate plate = plate_facing(view_pose(Side::left, 0));
  plate.edge_start = edge_radius > 0 ? -10 : -100;
  plate.far_edge = 200;
  plate.half_width = 200;
  plate.mid_depth = 0;
  plate.edge_radius = std::max(1.0, edge_radius);
  return fixtures::pair_at(plate, -19.8, 60);
}

Case plate(double penalty) {
  Case out = body(Element::q1p0, 0, Invariants::isochoric, false);
  auto term = std::make_shared<PlateTerm>(top_nodes(out.mesh));
  term->set_plates(plates_at_the_top(12));
  term->set_penalty(penalty);
  for (std::size_t c = 0; c < top_nodes(out.mesh).size(); ++c) {
    term->entry(c).plate = 0;
    term->entry(c).multiplier = 1e3 * double(c % 4);
  }
  out.term = term;
  out.energy_sees_reference = false;
  return out;
}

// On a flat plate, where its tangent is exact; `stuck` below the bound, else slipping on it.
Case friction(bool stuck) {
  Case out = body(Element::q1p0, 0, Invariants::isochoric, false);
  auto term = std::make_shared<FrictionTerm>();
  term->set_plates(plates_at_the_top(0));
  std::vector<FrictionEntry> entries;
  for (const int node : top_nodes(out.mesh)) {
    entries.push_back({node, 0, out.mesh.reference[std::size_t(node)], stuck ? 1e9 : 50, 1e3});
  }
  term->set_entries(entries);
  out.term = term;
  out.energy_sees_reference = false;
  return out;
}

// Faces that a plate's rounded edge crosses. `richer`: of 27-node elements.
Case faces(bool richer) {
  Case out = body(richer ? Element::q2p1 : Element::q1p0, 0, Invariants::isochoric, false);
  const std::vector<int> list = top_nodes(out.mesh);
  const std::set<int> top(list.begin(), list.end());
  std::vector<Face> pressed;
  for (const Face& face : out.mesh.skin_faces) {
    const std::vector<int> nodes = face_nodes(out.mesh, face);
    if (std::all_of(nodes.begin(), nodes.end(), [&](int n) { return top.contains(n); })) {
      pressed.push_back(face);
    }
  }
  auto term = std::make_shared<SurfacePressure>(out.mesh, pressed, *out.scene->solid().space());
  term->set_plates(plates_at_the_top(3));
  term->set_stiffness(1e4);
  term->set_turning_depth(1e9);
  term->choose_points(out.state.x);
  out.term = term;
  out.energy_sees_reference = false;
  return out;
}

const std::vector<Named>& all_terms() {
  static const std::vector<Named> list{
      {"solid", [] { return term_of_scene("solid"); }},
      {"solid_q2p1", [] { return term_of_scene("solid", Element::q2p1); }},
      {"solid_compressible", [] { return term_of_scene("solid", Element::q1p0, 30); }},
      {"solid_plain", [] { return term_of_scene("solid", Element::q1p0, 0, Invariants::plain); }},
      {"corner_volume", [] { return corner_volume(Element::q1p0); }},
      {"corner_volume_q2p1", [] { return corner_volume(Element::q2p1); }},
      {"membrane", [] { return term_of_scene("membrane"); }},
      {"membrane_q2", [] { return term_of_scene("membrane", Element::q2p1); }},
      {"membrane_wrinkling",
       [] { return term_of_scene("membrane", Element::q1p0, 0, Invariants::isochoric, true); }},
      {"elastic_support_curved",
       [] {
         return term_of_scene("elastic support", Element::q1p0, 0, Invariants::isochoric, true);
       }},
      {"dead_load", [] { return term_of_scene("dead load"); }},
      {"elastic_support", [] { return term_of_wall("elastic support", "spring:0.5,0.2"); }},
      {"stiffening_springs",
       [] { return term_of_wall("stiffening springs", "spring:0.5,0.2,L=2"); }},
      {"stiffening_springs_fourth_power",
       [] { return term_of_wall("stiffening springs", "spring:0.5,0.2,L=2,P=4"); }},
      {"attachment", [] { return attachment(); }},
      {"plate_multiplier", [] { return plate(0); }},
      {"plate_penalty", [] { return plate(2e4); }},
      {"plates_on_faces", [] { return faces(false); }},
      {"plates_on_faces_q2", [] { return faces(true); }},
      {"friction_stuck", [] { return friction(true); }},
      {"friction_slipping", [] { return friction(false); }},
  };
  return list;
}

class EveryTerm : public testing::TestWithParam<Named> {
 protected:
  EveryTerm() : at_(GetParam().make()), problem_(at_.scene->solid().space(), free()) {
    problem_.add(at_.term);
  }
  Constraints free() const { return Constraints(at_.mesh.nodes()); }

  Eigen::VectorXd direction(int seed) const {
    Eigen::VectorXd d(at_.state.x.size());
    for (long i = 0; i < d.size(); ++i) d[i] = fixtures::noise(int(i) + 1000 * seed);
    return d;
  }
  Forces moved(const Eigen::VectorXd& dx, const Eigen::VectorXd& dX, double dp) const {
    State state = at_.state;
    state.x += dx;
    state.reference += dX;
    state.p += dp * pressures();
    return problem_.forces(state);
  }
  Eigen::VectorXd pressures() const {
    Eigen::VectorXd d(at_.state.p.size());
    for (long i = 0; i < d.size(); ++i) d[i] = fixtures::noise(int(i) + 321);
    return d;
  }
  Eigen::VectorXd none() const { return Eigen::VectorXd::Zero(at_.state.x.size()); }

  static constexpr double h = 1e-5;  // mm
  Case at_;
  Problem problem_;
};

TEST_P(EveryTerm, ForcesAreTheSlopeOfTheEnergy) {
  ASSERT_NE(at_.term, nullptr);
  const Forces here = problem_.forces(at_.state);
  ASSERT_TRUE(here.valid);
  for (int seed = 1; seed <= 3; ++seed) {
    const Eigen::VectorXd d = direction(seed);
    const double slope =
        (moved(h * d, none(), 0).energy - moved(-h * d, none(), 0).energy) / (2 * h);
    EXPECT_NEAR(slope, here.r.dot(d), 1e-6 * here.r.norm() * d.norm());
  }
  const double dp = 1e-2;
  const double slope =
      (moved(none(), none(), dp).energy - moved(none(), none(), -dp).energy) / (2 * dp);
  EXPECT_NEAR(slope, -here.theta.dot(pressures()), 1e-6 * (1 + here.theta.norm()));
}

TEST_P(EveryTerm, TangentIsTheSlopeOfTheForces) {
  SaddleMatrix matrix = problem_.make_matrix();
  Forces here;
  ASSERT_TRUE(problem_.tangent(at_.state, here, matrix));
  for (int seed = 1; seed <= 3; ++seed) {
    const Eigen::VectorXd d = direction(seed);
    const Forces up = moved(h * d, none(), 0), down = moved(-h * d, none(), 0);
    const Eigen::VectorXd force = (up.r - down.r) / (2 * h),
                          volume = (up.theta - down.theta) / (2 * h);
    EXPECT_LT((force - matrix.multiply_unaugmented(d)).norm(), 2e-6 * (force.norm() + 1e-3));
    EXPECT_LT((volume - matrix.divergence.apply(d)).norm(), 1e-6 * (volume.norm() + 1e-6));
  }
  const double dp = 1;
  const Eigen::VectorXd by_pressure =
      (moved(none(), none(), dp).r - moved(none(), none(), -dp).r) / (2 * dp);
  EXPECT_LT((by_pressure + matrix.divergence.apply_transpose(pressures())).norm(),
            1e-8 * (1 + by_pressure.norm()));
}

TEST_P(EveryTerm, DerivativeByTheReferenceIsExactAndItsTransposeToo) {
  ReferenceTangent tangent;
  Request request;
  request.reference = &tangent;
  ASSERT_TRUE(problem_.evaluate(at_.state, request).valid);
  for (int seed = 1; seed <= 3; ++seed) {
    const Eigen::VectorXd d = direction(seed), w = direction(seed + 7);
    const Forces up = moved(none(), h * d, 0), down = moved(none(), -h * d, 0);
    const Eigen::VectorXd force = (up.r - down.r) / (2 * h),
                          volume = (up.theta - down.theta) / (2 * h);
    EXPECT_LT((force - tangent.apply(d)).norm(), 2e-6 * (force.norm() + 1e-3));
    EXPECT_LT((volume - tangent.b_x.apply(d)).norm(), 1e-6 * (volume.norm() + 1e-6));
    EXPECT_NEAR(w.dot(tangent.apply(d)), d.dot(tangent.apply_transpose(w)),
                1e-9 * w.norm() * (tangent.apply(d).norm() + 1e-9));
  }
}

// Packed by cells in single precision: the assembled matrix, its own κ included.
TEST_P(EveryTerm, PackedTangentIsTheAssembledOne) {
  SaddleMatrix matrix = problem_.make_matrix();
  PackedTangent packed;
  Request request;
  request.augmentation = 5;
  request.matrix = &matrix;
  request.packed = &packed;
  ASSERT_TRUE(problem_.evaluate(at_.state, request).valid);
  const Eigen::VectorXd d = direction(4), product = matrix.stiffness.multiply(d);
  EXPECT_LT((packed.apply(d) - product).norm(), 1e-5 * (product.norm() + 1e-9));
  const std::vector<Mat3> blocks = packed.diagonal_blocks(3, at_.mesh.nodes());
  for (int node = 3; node < at_.mesh.nodes(); ++node) {
    const Mat3 block = matrix.stiffness.block(node, -1);
    EXPECT_LT((blocks[std::size_t(node - 3)] - block).norm(), 1e-5 * (block.norm() + 1e-9));
  }
}

TEST_P(EveryTerm, TouchesOnlyTheNodesItNames) {
  const std::vector<int> named = at_.term->nodes();
  EXPECT_TRUE(std::is_sorted(named.begin(), named.end()));
  const std::set<int> own(named.begin(), named.end());
  const Forces here = problem_.forces(at_.state);
  Eigen::VectorXd elsewhere = direction(5);
  for (const int node : named) elsewhere.segment<3>(3L * node).setZero();
  for (int node = 0; node < at_.mesh.nodes(); ++node) {
    if (own.contains(node)) continue;
    EXPECT_EQ(Vec3(here.r.segment<3>(3L * node)), Vec3(0, 0, 0)) << node;
  }
  const Forces there = moved(0.1 * elsewhere, none(), 0);
  EXPECT_EQ(there.r, here.r);
}

INSTANTIATE_TEST_SUITE_P(Terms, EveryTerm, testing::ValuesIn(all_terms()),
                         [](const auto& each) { return each.param.name; });

/// A wide paddle with an edge of 10 mm.
Plate rounded_plate() {
  Plate plate = plate_facing(view_pose(Side::left, 0));
  plate.far_edge = plate.half_width = 200;
  plate.edge_radius = 10;
  return plate;
}

// On a rounded edge the plate's normal turns with the node, which friction's tangent leaves out unless
// the normal is fixed.
TEST(FrictionTerm, TangentIsExactOnAFlatPlateOrWithAFixedNormal) {
  const Plate plate = rounded_plate();
  FrictionTerm term;
  term.set_plates(fixtures::pair_at(plate, 0, 60));
  const auto error_at = [&](const Vec3& x, std::optional<Vec3> normal, double bound) {
    term.set_entries({{0, 0, x + Vec3(2, 1, 0), bound, 100, normal}});
    Mat3 slope;
    for (int i = 0; i < 3; ++i) {
      const Vec3 d = 1e-5 * Vec3::Unit(i);
      slope.col(i) =
          -(term.at(term.entries()[0], x + d).force - term.at(term.entries()[0], x - d).force) /
          2e-5;
    }
    return (slope - term.at(term.entries()[0], x).stiffness).norm() / slope.norm();
  };
  const Vec3 flat(0, -50, -0.1), round(0, 6, 3);
  EXPECT_LT(error_at(flat, {}, 1e9), 1e-8);
  EXPECT_GT(error_at(round, {}, 1e9), 0.02);
  const Vec3 normal = plate.gap(round).gradient;
  for (const double bound : {1e9, 50.0}) {
    EXPECT_LT(error_at(round, normal, bound), 1e-7) << bound;
  }
}

// What a file keeps: without a lever along the normal, the force is the same with the normal at the node.
TEST(FrictionTerm, AnchorInThePlaneOfTheNodeChangesNoForce) {
  const Plate plate = rounded_plate();
  const Eigen::Vector3d x(0, 6, 3);
  const Vec3 normal = plate.gap(x).gradient;
  for (const double bound : {1e9, 50.0}) {
    FrictionTerm fixed, kept;
    for (FrictionTerm* term : {&fixed, &kept}) term->set_plates(fixtures::pair_at(plate, 0, 60));
    fixed.set_entries({{0, 0, x + Vec3(2, 1, 4), bound, 100, normal}});
    const FrictionEntry& held = fixed.entries()[0];
    const Vec3 anchor = fixed.anchor_in_plane(held, x);
    EXPECT_LT(std::abs((x - anchor).dot(normal)), 1e-12);
    kept.set_entries({{0, 0, anchor, bound, 100}});
    const FrictionForce before = fixed.at(held, x), after = kept.at(kept.entries()[0], x);
    EXPECT_LT((before.force - after.force).norm(), 1e-12 * before.force.norm());
    EXPECT_EQ(before.slips, after.slips);
  }
}

// Its anchor differs from it by rounding, in any direction.
TEST(FrictionTerm, RoundingOfANodeThatSticksTurnsNoNormal) {
  const Plate plate = rounded_plate();
  const Vec3 x(0, 6, 3), normal = plate.gap(x).gradient;
  EXPECT_EQ(kept_normal(plate, x + 1e-14 * normal, x), normal);
}

// In the edge a node may turn the plate's normal away from the one of the solve.
TEST(FrictionTerm, AnchorInThePlaneOfAnotherNormalHoldsAsBefore) {
  const Plate plate = rounded_plate();
  const Eigen::Vector3d x(0, 6, 3);
  const Vec3 here = plate.gap(x).gradient;
  for (const Vec3& kept :
       {Vec3(here.cross(Vec3(1, 0, 0)) + 0.2 * here), Vec3(here + Vec3(0.8, 0, 0.3))}) {
    for (const double bound : {1e9, 50.0}) {
      FrictionTerm solved, read;
      for (FrictionTerm* term : {&solved, &read}) term->set_plates(fixtures::pair_at(plate, 0, 60));
      solved.set_entries({{0, 0, x + Vec3(2, 1, 4), bound, 100, kept.normalized()}});
      const Vec3 anchor = solved.anchor_in_plane(solved.entries()[0], x);
      const Vec3 force = solved.at(solved.entries()[0], x).force;
      read.set_entries({{0, 0, anchor, bound, 100}});
      EXPECT_GT((read.at(read.entries()[0], x).force - force).norm(), 0.01 * force.norm());
      read.set_entries({{0, 0, anchor, bound, 100, kept_normal(plate, anchor, x)}});
      EXPECT_LT((read.at(read.entries()[0], x).force - force).norm(), 1e-12 * force.norm());
    }
  }
}

// What a scene lacks is not in its list.
TEST(Scene, HasNoTermsForWhatItLacks) {
  const auto names = [](bool skin, bool wall) {
    fixtures::BlockSettings settings;
    if (skin) settings.skin_mm = 1;
    const HexMesh mesh = fixtures::block(settings);
    MechanicsOptions options;
    options.materials = load_materials("seed2008");
    if (wall) options.wall = wall_support("spring:1,1");
    const Scene scene(mesh, options);
    std::vector<std::string> list;
    const LoadedProblem loaded = scene.problem(Eigen::VectorXd::Zero(3L * mesh.nodes()));
    for (const auto& term : loaded.problem.terms()) list.push_back(term->name());
    return list;
  };
  using List = std::vector<std::string>;
  EXPECT_EQ(names(false, false), (List{"solid", "dead load"}));
  EXPECT_EQ(names(true, false), (List{"solid", "membrane", "dead load"}));
  EXPECT_EQ(names(false, true), (List{"solid", "elastic support", "dead load"}));
}

}  // namespace
}  // namespace breast
