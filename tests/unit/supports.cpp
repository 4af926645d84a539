// SPDX-License-Identifier: GPL-3.0-or-later
// Every support of the registry: its text, its forces' derivatives by its parameters. A new support is
// tested by being in the registry, its term by being in the list of terms.cpp.
#include <gtest/gtest.h>

#include "core/error.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "fixtures/block.hpp"
#include "fixtures/level_surfaces.hpp"
#include "fixtures/standing_block.hpp"
#include "mechanics/options.hpp"
#include "mechanics/supports/effects.hpp"
#include "mechanics/terms/elastic_support.hpp"
#include "mesh/nodal.hpp"

namespace breast {
namespace {

/// The examples of all supports at a place, and of all additions to those that have springs.
std::vector<std::string> texts_at(SupportPlace place) {
  std::vector<std::string> texts;
  for (const bool additions : {false, true}) {
    const std::vector<std::string> plain = texts;
    for (const SupportKind* kind : support_kinds()) {
      const bool here = std::count(kind->places.begin(), kind->places.end(), place) > 0;
      if (!here || kind->addition != additions) continue;
      if (!additions) texts.emplace_back(kind->example);
      for (const std::string& text : plain) {
        if (read_support(place, text)->stiffness() > 0)
          texts.push_back(text + "," + std::string(kind->example));
      }
    }
  }
  return texts;
}

TEST(Supports, AreReadAndPrintedOrRefusedInWords) {
  for (const SupportPlace place : {SupportPlace::wall, SupportPlace::cut}) {
    for (const std::string& text : texts_at(place)) {
      const SupportPtr support = read_support(place, text);
      EXPECT_EQ(support->text(), text);
      EXPECT_EQ(support->place(), place);
      EXPECT_FALSE(support->clause().empty()) << text;
      for (const std::string& name : support->parameters()) {
        EXPECT_NE(support->scaled(name, 2)->text(), text) << name;
        EXPECT_EQ(support->scaled(name, 2)->scaled(name, 0.5)->text(), text) << name;
      }
      EXPECT_EQ(support->stiffened(2)->stiffness(), 2 * support->stiffness()) << text;
    }
  }
  EXPECT_EQ(wall_support("slide")->stiffness(), usual_sliding_stiffness);
  EXPECT_TRUE(wall_support("slide:0")->slides());
  EXPECT_TRUE(wall_support("slide:0")->parameters().empty());
  EXPECT_EQ(wall_support("spring:3")->text(), "spring:3,1");
  EXPECT_EQ(cut_support("spring:0.005,0.1")->parameters(),
            (std::vector<std::string>{"cut", "sternum"}));
  EXPECT_EQ(cut_support("tissue:0.1,0.3")->beside(*wall_support("held"))->text(), "spring:0.1,0.3");
  EXPECT_EQ(cut_support("tissue:0.1")->beside(*wall_support("slide")), nullptr);
  // What is not varied has no parameter.
  EXPECT_EQ(wall_support("slide:0.1,L=20,P=4")->parameters(),
            (std::vector<std::string>{"wall", "wall.L"}));
  EXPECT_EQ(wall_support("slide:0.1,P=4,L=20")->text(), "slide:0.1,L=20,P=4");
  EXPECT_EQ(wall_support("slide:0.1,L=20,P=2")->text(), "slide:0.1,L=20");
  const SupportPtr borders = cut_support("spring:0,superior=0.03,medial=0.1,L=20");
  EXPECT_EQ(borders->text(), "spring:0,medial=0.1,superior=0.03,L=20");
  EXPECT_EQ(borders->parameters(),
            (std::vector<std::string>{"cut.medial", "cut.superior", "cut.L"}));
  EXPECT_EQ(borders->scaled("cut.medial", 2)->text(), "spring:0,medial=0.2,superior=0.03,L=20");
  EXPECT_EQ(borders->stiffened(2)->text(), "spring:0,medial=0.2,superior=0.06,L=20");
  for (const char* bad : {"",
                          "spring",
                          "spring:",
                          "spring:0",
                          "spring:-1",
                          "spring:1,-1",
                          "spring:1,",
                          "spring:nan",
                          "spring:1;2",
                          "spring:1,2,3",
                          "free",
                          "slide:",
                          "slide:-1",
                          "slide:1,1",
                          "slide:1,Q=2",
                          "slide:Q=2,1",
                          "slide:Q=",
                          "held:1",
                          "slide:1,P=2",
                          "slide:1,L=0",
                          "slide:1,L=9,P=0.5",
                          "slide:0,L=9",
                          "slide:1,medial=1"}) {
    EXPECT_THROW(wall_support(bad), Error) << bad;
  }
  for (const char* bad : {"", "held", "spring", "spring:0", "spring:-1", "spring:1,0", "spring:1,",
                          "spring:1,1,1", "tissue", "roller:1", "slide:1", "spring:1,medial=-1",
                          "spring:medial=1", "spring:1,axilla=1", "roller:medial=1"}) {
    EXPECT_THROW(cut_support(bad), Error) << bad;
  }
  try {
    cut_support("spring:-1");
    FAIL();
  } catch (const Error& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("--cut spring:-1: KC -1 must be above 0; give one of free, fixed, roller"),
              std::string::npos)
        << said;
  }
}

// The force of the springs of the cut on a breast that moved by (3, 1, -2) mm.
Vec3 force_of_cut(const HexMesh& mesh, const std::string& cut) {
  MechanicsOptions options;
  options.cut = cut_support(cut);
  const Eigen::VectorXd reference = flatten(mesh.imaged);
  State state;
  state.reference = state.x = reference;
  for (int node = 0; node < mesh.nodes(); ++node) state.x.segment<3>(3L * node) += Vec3(3, 1, -2);
  return attach_supports(mesh, nullptr, options).force_of_springs(state);
}

// The borders share the cut: alone, each exerts its part of the force of springs all around, and only there.
TEST(Supports, EachBorderOfTheCutHasItsOwnSprings) {
  HexMesh mesh = analytic_breast_mesh(6);
  Vec3 sum = Vec3::Zero();
  for (const char* border : {"medial", "superior", "lateral", "inferior"}) {
    const Vec3 force = force_of_cut(mesh, std::string("spring:0,") + border + "=0.02");
    EXPECT_GT(force.norm(), 0) << border;
    sum += force;
  }
  const Vec3 all = force_of_cut(mesh, "spring:0.02");
  EXPECT_LT((sum - all).norm(), 1e-12 * all.norm());
  const Vec3 others = force_of_cut(mesh, "spring:0.02,medial=0"),
             medial = force_of_cut(mesh, "spring:0,medial=0.02");
  EXPECT_LT((others + medial - all).norm(), 1e-12 * all.norm());
  // They stiffen with the others.
  const double moved = Vec3(3, 1, -2).norm(), factor = 1 + std::pow(moved / 5, 3);
  const Vec3 stiffened = force_of_cut(mesh, "spring:0,medial=0.02,L=5,P=3");
  EXPECT_LT((stiffened - factor * medial).norm(), 1e-12 * stiffened.norm());
  // What is medial depends on the side.
  mesh.side = mesh.side == Side::left ? Side::right : Side::left;
  EXPECT_LT((force_of_cut(mesh, "spring:0,lateral=0.02") - medial).norm(), 1e-12 * medial.norm());
}

// The forces of the supports of wall and cut of a block on the plane x = 0, with their loads.
Eigen::VectorXd residual(const HexMesh& mesh, const MechanicsOptions& options, const State& state,
                         const Vec3& gravity) {
  const SupportEffects effects =
      attach_supports(mesh, std::make_shared<fixtures::Plane>(Vec3(1, 0, 0)), options);
  Eigen::VectorXd load = Eigen::VectorXd::Zero(state.x.size()), sum = load;
  for (const auto& springs : effects.springs) sum += springs.term->forces(state);
  effects.add_loads(gravity, load);
  return sum - load;
}

void expect_slopes(const HexMesh& mesh, const MechanicsOptions& options) {
  constexpr double h = 1e-5;
  const Vec3 gravity(100, 6000, -8000);
  State state{flatten(mesh.imaged), flatten(mesh.imaged), {}};
  for (long i = 0; i < state.x.size(); ++i) state.x[i] += 3 * fixtures::noise(int(i));
  const SupportEffects effects =
      attach_supports(mesh, std::make_shared<fixtures::Plane>(Vec3(1, 0, 0)), options);
  for (const SupportPtr& support : {options.wall, options.cut}) {
    for (const std::string& name : support->parameters()) {
      MechanicsOptions up = options, down = options;
      scale_model(up, name, std::exp(h)), scale_model(down, name, std::exp(-h));
      const Eigen::VectorXd difference =
          (residual(mesh, up, state, gravity) - residual(mesh, down, state, gravity)) / (2 * h);
      EXPECT_GT(difference.norm(), 0) << support->text() << " " << name;
      EXPECT_LT((effects.slope(name, state, gravity) - difference).norm(), 1e-8 * difference.norm())
          << support->text() << " " << name;
    }
  }
}

TEST(Supports, DeriveByTheirParameters) {
  fixtures::BlockSettings settings;
  settings.elements = {2, 2, 2};
  settings.size = Vec3(40, 40, 40);
  HexMesh mesh = fixtures::block(settings);
  mesh.cut_faces = mesh.skin_faces;
  mesh.side = Side::right;  // its medial face, x = 40, is a part of the cut
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  for (const std::string& wall : texts_at(SupportPlace::wall)) {
    options.wall = wall_support(wall);
    options.cut = cut_support("spring:0.02");
    expect_slopes(mesh, options);
  }
  for (const std::string& cut : texts_at(SupportPlace::cut)) {
    options.wall = wall_support("slide:0.02");
    options.cut = cut_support(cut);
    expect_slopes(mesh, options);
  }
}

TEST(ElasticSupport, ForceIsStiffnessTimesAreaTimesMotion) {
  const HexMesh mesh = fixtures::standing_block({50, 60, 40}, {2, 2, 2});  // wall y = 0: 2000 mm²
  const ElasticSupport wall(mesh, mesh.pectoral_faces, {0.5, 0.2});
  const auto pushed = [&](const Vec3& by) {
    std::vector<Vec3> x = mesh.reference;
    for (Vec3& point : x) point += by;
    return wall.force_on_body({flatten(mesh.reference), flatten(x), {}});
  };
  // 0.5 kPa/mm · 2000 mm² = 1e6 µN/mm across the wall.
  EXPECT_LT((pushed({0, 2, 0}) - Vec3(0, -2e6, 0)).norm(), 1e-3);
  EXPECT_LT((pushed({1, 0, 3}) - Vec3(-0.4e6, 0, -1.2e6)).norm(), 1e-3);
  EXPECT_THROW(ElasticSupport(mesh, mesh.pectoral_faces, {0, 1}), Error);
  EXPECT_THROW(ElasticSupport(mesh, mesh.pectoral_faces, {1, std::nan("")}), Error);
}

}  // namespace
}  // namespace breast
