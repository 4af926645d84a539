// SPDX-License-Identifier: GPL-3.0-or-later
// The active set on bodies small enough for an independent answer: a quadratic body between plates.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "contact/path/path.hpp"
#include "contact/solvers/active_set.hpp"
#include "contact/solvers/augmented_lagrangian.hpp"
#include "core/units.hpp"
#include "fixtures/level_surfaces.hpp"
#include "fixtures/wide_plates.hpp"
#include "solve/line_search.hpp"

using namespace breast;

namespace {

/// Nodes tied to their rest positions and to each other by a random positive definite matrix.
class Springs final : public Term {
 public:
  Springs(int nodes, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(
        3 * nodes, 3 * nodes, [&](Eigen::Index, Eigen::Index) { return 0.2 * uniform(random); });
    stiffness = 1e3 * (a * a.transpose() + Eigen::MatrixXd::Identity(3 * nodes, 3 * nodes));
    rest.resize(3 * nodes);
    for (int i = 0; i < nodes; ++i) {
      rest.segment<3>(3 * i) =
          Vec3(10 * uniform(random), -30 - 20 * uniform(random), 15 * uniform(random));
    }
    cells_.nodes_per_cell = nodes;
    for (int i = 0; i < nodes; ++i) cells_.nodes.push_back(i);
  }
  std::string name() const override { return "springs"; }
  bool add(const State& state, const Request& request, Forces& forces) const override {
    const Eigen::VectorXd force = stiffness * (state.x - rest);
    forces.r += force;
    if (request.kappa != nullptr) forces.augmented += force;
    forces.energy += 0.5 * force.dot(state.x - rest);
    forces.min_det_F = forces.max_det_F = 1;
    if (request.matrix == nullptr) return true;
    request.matrix->stiffness.add_cells(*scatter, 0, 1, stiffness.data());
    request.matrix->diagonal += stiffness.diagonal();
    request.matrix->kappa.setOnes();
    return true;
  }
  std::vector<int> nodes() const override { return cells_.nodes; }

  Eigen::MatrixXd stiffness;
  Eigen::VectorXd rest;
  std::shared_ptr<const ScatterMap> scatter;
  const Cells& cells() const { return cells_; }

 private:
  Cells cells_;  // one, of all nodes
};

/// A body of such springs whose node 0 is held; one pressure that nothing feels.
struct QuadraticBody {
  QuadraticBody(int nodes, unsigned seed) : springs(std::make_shared<Springs>(nodes, seed)) {
    auto space = std::make_shared<Discretisation>();
    space->node_count = nodes;
    space->cells = springs->cells();
    auto pattern = std::make_shared<NodePattern>(nodes, space->cells);
    springs->scatter = std::make_shared<ScatterMap>(*pattern, space->cells);
    space->pattern = pattern;
    auto pressures = std::make_shared<PressureSpace>();
    pressures->rows = 1;
    pressures->mass = pressures->inverse_mass = {1};
    pressures->compliance = Eigen::VectorXd::Ones(1);
    space->pressures = pressures;
    Constraints held(nodes);
    held.hold(0);
    problem = std::make_unique<Problem>(space, held);
    problem->add(springs);
    solver = std::make_unique<SaddleSolver>(pattern);
  }
  ActiveSet active_set() { return {*problem, *solver, free_nodes()}; }
  std::vector<int> free_nodes() const {
    std::vector<int> list;
    for (int i = 1; i < problem->nodes(); ++i) list.push_back(i);
    return list;
  }
  State start() const { return {springs->rest, springs->rest, Eigen::VectorXd::Zero(1)}; }

  std::shared_ptr<Springs> springs;
  std::unique_ptr<Problem> problem;
  std::unique_ptr<SaddleSolver> solver;
};

PlatePair plates_at(double low, double high, double edge_radius) {
  Plate plate = plate_facing(view_pose(Side::left, 0));
  plate.edge_start = 25;
  plate.far_edge = 200;
  plate.half_width = 200;
  plate.mid_depth = 50;
  plate.edge_radius = edge_radius;
  return fixtures::pair_at(plate, low, high);
}

/// Largest violation of: gap ≥ 0, force ≥ 0, their product 0 (per touching
/// node), balance elsewhere.
double complementarity(const QuadraticBody& body, const PlatePair& plates, const State& state) {
  const Forces forces = body.problem->forces(state);
  double worst = 0;
  for (int node = 1; node < body.problem->nodes(); ++node) {
    const Vec3 x = state.x.segment<3>(3 * node), r = forces.r.segment<3>(3 * node);
    const Gap gap = plates.plate(plates.nearer(x)).gap(x);
    const Vec3 normal = gap.gradient;
    const double push = r.dot(normal);
    worst = std::max({worst, -gap.value, -push / 1e3, (r - push * normal).norm() / 1e3,
                      std::min(gap.value, push / 1e3)});
  }
  return worst;
}

}  // namespace

TEST(ActiveSet, SolvesTheObstacleProblemForManyBodies) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    for (const double radius : {5.0, 40.0}) {
      QuadraticBody body(24, seed);
      const PlatePair plates = plates_at(-6, 5, radius);
      ActiveSet contact = body.active_set();
      State state = body.start();
      const ContactStep step = contact.solve(plates, state, 1e-12);
      ASSERT_TRUE(step.converged) << "seed " << seed << " radius " << radius;
      EXPECT_LT(complementarity(body, plates, state), 1e-7) << "seed " << seed;
      int touching = 0;
      for (const signed char k : contact.touching()) touching += k >= 0;
      EXPECT_GT(touching, 3);
    }
  }
}

TEST(ActiveSet, CurvatureTermKeepsNewtonQuadratic) {
  QuadraticBody body(24, 3);
  const PlatePair plates = plates_at(-4, 4, 60);
  ActiveSet contact = body.active_set();
  State state = body.start();
  const ContactStep step = contact.solve(plates, state, 1e-13);
  ASSERT_TRUE(step.converged);
  EXPECT_LE(step.iterations.size(), 9u);
}

TEST(ActiveSet, NothingTouchesWhenThePlatesAreWide) {
  QuadraticBody body(10, 5);
  const PlatePair plates = plates_at(-100, 100, 15);
  ActiveSet contact = body.active_set();
  State state = body.start();
  const ContactStep step = contact.solve(plates, state, 1e-10);
  EXPECT_TRUE(step.converged);
  EXPECT_TRUE(step.iterations.empty());
}

namespace {
/// 25 mm² for every node on the paddle.
PaddleArea paddle_area(const PlatePair& plates, const ContactSolver& contact) {
  return [&](const State& s) {
    double touching = 0;
    for (const int node : contact.candidates()) {
      touching += plates.paddle.gap(s.x.segment<3>(3L * node)).value < 1e-6 ? 25 : 0;
    }
    return touching;
  };
}

PathResult close(PlatePair& plates, ContactSolver& contact, State& state,
                 const CompressionTarget& target, PathOptions options = {}) {
  return follow_path(contact, plates, state, target, paddle_area(plates, contact), options);
}
}  // namespace

// A plate step that begins with a node beyond the wall surface says so, and not that elements fold.
TEST(ContactMethods, NameANodeBeyondTheWallSurface) {
  QuadraticBody body(24, 3);
  auto wall = std::make_shared<fixtures::Sphere>(Vec3(0, 120, 0), 120);
  wall->reach = 200;
  body.problem->set_sliding(
      std::make_shared<SlidingNodes>(wall, std::vector<int>{1, 2}, body.springs->rest));
  State state = body.start();
  state.x.segment<3>(6) = Vec3(400, -40, 0);
  const PlatePair plates = plates_at(-6, 5, 5);
  ActiveSet active_set = body.active_set();
  AugmentedLagrangian lagrangian(*body.problem, *body.solver, body.free_nodes(), {});
  for (ContactSolver* method : std::initializer_list<ContactSolver*>{&active_set, &lagrangian}) {
    State trial = state;
    EXPECT_STREQ(stop_name(method->solve(plates, trial, 1e-10).stop), "left_wall_surface");
  }
}

TEST(CompressionPath, EndDoesNotDependOnTheSteps) {
  Eigen::VectorXd end[2];
  for (const int k : {0, 1}) {
    QuadraticBody body(24, 7);
    PlatePair plates = plates_at(-20, 20, 15);
    ActiveSet contact = body.active_set();
    State state = body.start();
    PathOptions options;
    options.first_step = options.longest_step = k == 0 ? 1.0 : 20.0;
    const PathResult path = close(plates, contact, state, {TargetKind::thickness, 12}, options);
    ASSERT_TRUE(path.reached());
    EXPECT_EQ(path.thickness, 12);
    EXPECT_EQ(plates.thickness(), 12);
    EXPECT_GT(path.points.back().paddle_N, path.points.front().paddle_N);
    end[k] = state.x;
  }
  EXPECT_LT((end[0] - end[1]).lpNorm<Eigen::Infinity>(), 1e-7);
}

TEST(CompressionPath, ReleaseReturnsToTheStart) {
  QuadraticBody body(24, 9);
  PlatePair plates = plates_at(-20, 20, 15);
  ActiveSet contact = body.active_set();
  State state = body.start();
  ASSERT_TRUE(close(plates, contact, state, {TargetKind::thickness, 10}).reached());
  EXPECT_GT((state.x - body.springs->rest).norm(), 1);
  ASSERT_TRUE(close(plates, contact, state, {TargetKind::thickness, 40}).reached());
  EXPECT_LT((state.x - body.springs->rest).lpNorm<Eigen::Infinity>(), 1e-8);
}

TEST(CompressionPath, ForceAndPressureControlHitTheirTarget) {
  for (const auto& [kind, value] :
       {std::pair{TargetKind::force, 0.05}, std::pair{TargetKind::pressure, 0.4}}) {
    QuadraticBody body(24, 11);
    PlatePair plates = plates_at(-20, 20, 15);
    ActiveSet contact = body.active_set();
    State state = body.start();
    const PathResult path = close(plates, contact, state, {kind, value});
    ASSERT_TRUE(path.reached());
    const PathPoint& end = path.points.back();
    EXPECT_NEAR(kind == TargetKind::force ? end.paddle_N : end.pressure_kPa, value, 2e-3 * value);
    EXPECT_EQ(end.thickness, path.thickness);
  }
}

// Whichever stop comes first ends the path, in whatever order they are given.
TEST(CompressionPath, TheFirstOfSeveralTargetsEndsIt) {
  const auto end_of = [](const CompressionTarget& target) {
    QuadraticBody body(24, 11);
    PlatePair plates = plates_at(-20, 20, 15);
    ActiveSet contact = body.active_set();
    State state = body.start();
    const PathResult path = close(plates, contact, state, target);
    EXPECT_TRUE(path.reached());
    return std::pair(path.points.back(), path.met.kind);
  };
  const PathPoint at_force = end_of({TargetKind::force, 0.05}).first;
  const CompressionTarget closed{TargetKind::thickness, 0.9 * at_force.thickness};
  const CompressionTarget open{TargetKind::thickness, 1.1 * at_force.thickness};
  const CompressionTarget force{TargetKind::force, 0.05},
      area{TargetKind::area, 0.9 * at_force.area_cm2};
  const auto with = [](CompressionTarget first, const CompressionTarget& second) {
    first.or_at = {second};
    return first;
  };
  for (const auto& target : {with(closed, force), with(force, closed)}) {
    const auto [end, kind] = end_of(target);
    EXPECT_EQ(kind, TargetKind::force);
    EXPECT_NEAR(end.paddle_N, 0.05, 1e-4);
  }
  for (const auto& target : {with(open, force), with(force, open)}) {
    const auto [end, kind] = end_of(target);
    EXPECT_EQ(kind, TargetKind::thickness);
    EXPECT_EQ(end.thickness, open.value);
  }
  const auto [end, kind] = end_of(with(force, area));
  EXPECT_EQ(kind, TargetKind::area);
  EXPECT_LT(end.paddle_N, 0.05);
}

// A target that comes before the path may end is passed by the shortest step at most, with the load
// of the end of the way, and the result says by how much.
// The part of the way from which the path may end is never reached, so that the load of the end is
// set at the last states.
TEST(CompressionPath, ATargetPassedBeforeThePathMayEndIsSoughtWithTheLoadOfTheEnd) {
  QuadraticBody body(24, 11);
  PlatePair plates = plates_at(-20, 20, 15);
  ActiveSet contact = body.active_set();
  State state = body.start();
  ASSERT_TRUE(close(plates, contact, state, {TargetKind::force, 0.05}).reached());
  const double early = plates.thickness();
  PlatePair again = plates_at(-20, 20, 15);
  ActiveSet fresh = body.active_set();
  state = body.start();
  PathOptions options;
  double last_way = 0;
  options.prepare = [&](double way) { last_way = way; };
  options.may_end_from = 3;
  const CompressionTarget target{TargetKind::force, 0.05, {{TargetKind::thickness, 0.5 * early}}};
  const PathResult path = close(again, fresh, state, target, options);
  ASSERT_TRUE(path.reached());
  EXPECT_EQ(path.met.kind, TargetKind::force);
  EXPECT_FALSE(path.passed_by);
  EXPECT_NEAR(path.points.back().paddle_N, 0.05, 1e-5);
  EXPECT_NEAR(path.thickness, early, 0.01);
  EXPECT_GE(last_way, 3);
}

TEST(CompressionPath, ATargetThatEveryPositionPassesIsSaid) {
  QuadraticBody body(24, 11);
  PlatePair plates = plates_at(-20, 20, 15);
  ActiveSet contact = body.active_set();
  State state = body.start();
  ASSERT_TRUE(close(plates, contact, state, {TargetKind::force, 0.06}).reached());
  const double start = plates.thickness();
  PathOptions options;
  options.prepare = [](double) {};
  options.may_end_from = 3;
  const CompressionTarget target{TargetKind::force, 0.05, {{TargetKind::thickness, 0.5 * start}}};
  const PathResult path = close(plates, contact, state, target, options);
  ASSERT_TRUE(path.reached());
  EXPECT_EQ(path.met.kind, TargetKind::force);
  ASSERT_TRUE(path.passed_by);
  EXPECT_GE(*path.passed_by, 0.06 - 1e-5);
  EXPECT_NEAR(*path.passed_by, path.points.back().paddle_N, 1e-5);
  EXPECT_GT(path.thickness, start - 2 * options.shortest_step);
}

// Any part is more than −1: the first position beyond the target ends the path, unfinished. Finished after that, it is the
// path that was not left, at no more cost.
TEST(CompressionPath, EndsUnfinishedWhereTheEdgeCarriesTooMuchAndCanBeFinished) {
  QuadraticBody body(24, 11);
  const CompressionTarget target{TargetKind::force, 0.05};
  PlatePair plates = plates_at(-20, 20, 15);
  ActiveSet whole_way = body.active_set();
  State state = body.start();
  const PathResult whole = close(plates, whole_way, state, target);
  ASSERT_TRUE(whole.reached());
  EXPECT_GE(largest_edge_part(whole.points.back()), 0);
  plates = plates_at(-20, 20, 15);
  ActiveSet left = body.active_set();
  state = body.start();
  PathOptions options;
  options.most_on_edge = -1;
  ClosingPath way(left, plates, target, paddle_area(plates, left), options);
  const PathResult path = way.follow(state);
  EXPECT_EQ(path.end, PathEnd::on_edge);
  EXPECT_FALSE(path.reached());
  EXPECT_GT(path.points.back().paddle_N, 0.05);
  EXPECT_LT(path.solves, whole.solves);
  const PathResult finished = way.finish(state, 1000);
  EXPECT_TRUE(finished.reached());
  EXPECT_EQ(finished.thickness, whole.thickness);
  EXPECT_EQ(finished.points.back().paddle_N, whole.points.back().paddle_N);
  EXPECT_EQ(finished.iterations, whole.iterations);
  EXPECT_EQ(plates.thickness(), whole.thickness);
}

// Every position here takes an iteration, so that the path ends after the first one that uses up the limit.
TEST(CompressionPath, EndsAfterTheIterationsThatAreAllowed) {
  QuadraticBody body(24, 11);
  PlatePair plates = plates_at(-20, 20, 15);
  ActiveSet contact = body.active_set();
  State state = body.start();
  PathOptions options;
  options.most_iterations = 3;
  const PathResult path = close(plates, contact, state, {TargetKind::thickness, 10}, options);
  EXPECT_EQ(path.end, PathEnd::cost_limit);
  EXPECT_GT(path.thickness, 10);
  EXPECT_FALSE(path.points.empty());
}

// A penalty that sets in after part of the way, `stiffer` times as stiff as the tangent knows.
namespace {
class Kinked final : public NewtonSystem {
 public:
  Kinked(double stiffer, double from) : stiffer_(stiffer), from_(from) {}
  Balance assess(const NewtonResult&) override { return {}; }
  NewtonDirection direction(const Balance&) override { return {}; }
  LineSearchRule rule(const NewtonResult&, const Balance&, const NewtonDirection&) const override {
    return {};
  }
  std::optional<Trial> attempt(double length) override {
    const double along = length - 1 + (stiffer_ - 1) * std::max(0.0, length - from_);
    Trial trial;
    trial.seen = {std::abs(along), std::abs(along), along};
    return trial;
  }
  void accept(Trial) override {}

 private:
  double stiffer_, from_;
};

/// Along a direction of slope 1, from a state with this merit.
SearchResult search(double stiffer, double merit, bool kinks, double from = 0,
                    bool to_minimum = false) {
  Kinked system(stiffer, from);
  NewtonDirection direction;
  direction.slope = 1;
  LineSearchRule rule;
  rule.merit = merit;
  rule.flat_suffices = true;
  rule.kinks = kinks;
  rule.to_minimum = to_minimum;
  return line_search(system, direction, rule);
}
}  // namespace

// A full step would end at 0.7 of the slope on the other side; if the next one came back, Newton's
// method would cycle.
TEST(LineSearch, DoesNotGoFarPastTheMinimumOfAKinkedEnergy) {
  EXPECT_EQ(search(1.7, 0.1, false).length, 1);
  EXPECT_EQ(search(1.7, 0.1, true).length, 0.5);
}

// Halves of the step are all too long, the place where the slope vanishes is found at once.
TEST(LineSearch, ShortensToWhereAKinkedEnergyIsFlat) {
  const SearchResult halved = search(320, 1, false), found = search(320, 1, true);
  EXPECT_TRUE(halved.any_admissible && !halved.trial);
  EXPECT_TRUE(found.trial.has_value());
  EXPECT_NEAR(found.length, 1.0 / 320, 1e-4);
}

// The slopes at the start and beyond the kink alone would suggest a hundredth of the way to it.
TEST(LineSearch, ReachesAKinkThatLiesOnTheWay) {
  const double kink = 0.005;
  const SearchResult found = search(1e5, 1, true, kink);
  ASSERT_TRUE(found.trial.has_value());
  EXPECT_LT(found.length, kink + 1e-4);
  EXPECT_GT(found.length, 0.6 * kink);
}

// Where steps repeat, a lower merit is not enough.
TEST(LineSearch, SeeksTheMinimumOfTheEnergy) {
  EXPECT_EQ(search(1.7, 1, true).length, 1);
  for (const double stiffer : {1.7, 20.0}) {
    for (const double kink : {0.0, 0.3}) {
      const SearchResult found = search(stiffer, 1, true, kink, true);
      ASSERT_TRUE(found.trial.has_value());
      EXPECT_LE(std::abs(found.trial->seen.along), 0.1) << stiffer << " from " << kink;
    }
  }
  EXPECT_EQ(search(0.5, 0, true, 0, true).length, 1) << "the energy still falls at the end";
  const SearchResult steep = search(1e4, 1, true, 0.3, true);
  ASSERT_TRUE(steep.trial.has_value());
  EXPECT_LE(steep.trial->seen.along, 0) << "never past a minimum that is not found";
  EXPECT_GT(steep.length, 0.1);
}

// How many updates the multipliers need says nothing of how far the plates may move at once.
TEST(CompressionPath, CorrectionsDoNotShortenTheSteps) {
  QuadraticBody body(24, 13);
  State exact = body.start(), penalised = exact;
  PathOptions options;
  options.first_step = options.longest_step = 4;
  options.path_tolerance = 1e-4;  // enough corrections for this test
  PlatePair plates = plates_at(-20, 20, 15);
  ActiveSet active_set = body.active_set();
  const PathResult a = close(plates, active_set, exact, {TargetKind::thickness, 12}, options);
  plates = plates_at(-20, 20, 15);
  AugmentedLagrangian paper(*body.problem, *body.solver, body.free_nodes(), {10});
  const PathResult b = close(plates, paper, penalised, {TargetKind::thickness, 12}, options);
  ASSERT_TRUE(a.reached() && b.reached());
  int most = 0;
  for (const PathPoint& point : b.points) most = std::max(most, point.iterations);
  EXPECT_GT(most, 12) << "no position with many corrections: the test shows nothing";
  EXPECT_EQ(a.points.size(), b.points.size());
  EXPECT_LT((exact.x - penalised.x).lpNorm<Eigen::Infinity>(), 0.01);
}
