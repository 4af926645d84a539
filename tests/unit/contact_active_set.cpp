// The active set on bodies small enough for an independent answer: a quadratic body between plates.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>
#include <random>

#include "contact/active_set.hpp"
#include "contact/augmented_lagrangian.hpp"
#include "contact/path.hpp"
#include "contact/step_search.hpp"
#include "core/units.hpp"
#include "fixtures/wide_plates.hpp"

using namespace breast;

namespace {

/// Linear elastic "body": nodes tied to their rest positions and to each other by a random SPD
/// matrix.
class QuadraticBody : public ContactBody {
 public:
  QuadraticBody(int nodes, unsigned seed) : nodes_(nodes) {
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
  }
  int nodes() const override { return nodes_; }
  void remove_held(Eigen::VectorXd& v) const override { v.head<3>().setZero(); }
  double load_norm() const override { return 1; }
  Vec3 weight() const override { return Vec3::Zero(); }
  bool forces(const BodyState& state, BodyForces& forces) override {
    forces.residual = stiffness * (state.x - rest);
    return true;
  }
  bool assemble(const BodyState&) override {
    tangent_ = stiffness;
    return true;
  }
  void add_to_tangent(int node, const Mat3& block) override {
    tangent_.block<3, 3>(3 * node, 3 * node) += block;
  }
  BodySolve solve(const std::vector<NormalConstraint>& constraints, const Eigen::VectorXd& residual,
                  BodyState& increment) override {
    // Particular increment along the normals, then the rest in their orthogonal complement.
    const int n = 3 * nodes_;
    Eigen::VectorXd particular = Eigen::VectorXd::Zero(n);
    Eigen::MatrixXd held = Eigen::MatrixXd::Zero(n, 3 + int(constraints.size()));
    held.topLeftCorner(3, 3).setIdentity();
    for (std::size_t c = 0; c < constraints.size(); ++c) {
      held.block<3, 1>(3 * constraints[c].node, 3 + int(c)) = constraints[c].normal;
      particular.segment<3>(3 * constraints[c].node) =
          constraints[c].increment * constraints[c].normal;
    }
    const Eigen::MatrixXd q = held.householderQr().householderQ();
    const Eigen::MatrixXd z = q.rightCols(n - held.cols());
    Eigen::MatrixXd reduced = z.transpose() * tangent_ * z;
    BodySolve result{true, false, 0};
    for (double shift = 1; Eigen::LLT<Eigen::MatrixXd>(reduced).info() != Eigen::Success;
         shift *= 4) {
      reduced.diagonal().array() += shift;
      result.shifted = true;
    }
    const Eigen::VectorXd right = -z.transpose() * (residual + tangent_ * particular);
    increment.x = particular + z * Eigen::LLT<Eigen::MatrixXd>(reduced).solve(right);
    increment.p.resize(0);
    result.slope = increment.x.dot(tangent_ * increment.x);
    return result;
  }

  Eigen::MatrixXd stiffness;
  Eigen::VectorXd rest;

 private:
  int nodes_;
  Eigen::MatrixXd tangent_;
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

std::vector<int> free_nodes(int nodes) {
  std::vector<int> list;
  for (int i = 1; i < nodes; ++i) list.push_back(i);
  return list;
}

/// Largest violation of: gap ≥ 0, force ≥ 0, their product 0 (per touching node), balance
/// elsewhere.
double complementarity(QuadraticBody& body, const PlatePair& plates, const BodyState& state) {
  BodyForces forces;
  body.forces(state, forces);
  double worst = 0;
  for (int node = 1; node < body.nodes(); ++node) {
    const Vec3 x = state.x.segment<3>(3 * node), r = forces.residual.segment<3>(3 * node);
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
      ActiveSet contact(body, free_nodes(24));
      BodyState state{body.rest, {}};
      const StepResult step = contact.solve(plates, state, 1e-12);
      ASSERT_EQ(step.outcome, StepOutcome::converged) << "seed " << seed << " radius " << radius;
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
  ActiveSet contact(body, free_nodes(24));
  BodyState state{body.rest, {}};
  const StepResult step = contact.solve(plates, state, 1e-13);
  ASSERT_EQ(step.outcome, StepOutcome::converged);
  EXPECT_LE(step.iterations, 9);
}

TEST(ActiveSet, NothingTouchesWhenThePlatesAreWide) {
  QuadraticBody body(10, 5);
  const PlatePair plates = plates_at(-100, 100, 15);
  ActiveSet contact(body, free_nodes(10));
  BodyState state{body.rest, {}};
  const StepResult step = contact.solve(plates, state, 1e-10);
  EXPECT_EQ(step.outcome, StepOutcome::converged);
  EXPECT_EQ(step.iterations, 0);
}

namespace {
PathResult close(PlatePair& plates, ContactSolver& contact, BodyState& state,
                 const CompressionTarget& target, PathOptions options = {}) {
  const auto area = [&](const BodyState&) {
    return std::vector<double>(contact.candidates().size(), 25.0);
  };
  return follow_path(contact, plates, state, target, area, options);
}
}  // namespace

TEST(CompressionPath, EndDoesNotDependOnTheSteps) {
  Eigen::VectorXd end[2];
  for (const int k : {0, 1}) {
    QuadraticBody body(24, 7);
    PlatePair plates = plates_at(-20, 20, 15);
    ActiveSet contact(body, free_nodes(24));
    BodyState state{body.rest, {}};
    PathOptions options;
    options.first_step = options.longest_step = k == 0 ? 1.0 : 20.0;
    const PathResult path = close(plates, contact, state, {TargetKind::thickness, 12}, options);
    ASSERT_TRUE(path.reached);
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
  ActiveSet contact(body, free_nodes(24));
  BodyState state{body.rest, {}};
  ASSERT_TRUE(close(plates, contact, state, {TargetKind::thickness, 10}).reached);
  EXPECT_GT((state.x - body.rest).norm(), 1);
  ASSERT_TRUE(close(plates, contact, state, {TargetKind::thickness, 40}).reached);
  EXPECT_LT((state.x - body.rest).lpNorm<Eigen::Infinity>(), 1e-8);
}

TEST(CompressionPath, ForceAndPressureControlHitTheirTarget) {
  for (const auto& [kind, value] :
       {std::pair{TargetKind::force, 0.05}, std::pair{TargetKind::pressure, 0.4}}) {
    QuadraticBody body(24, 11);
    PlatePair plates = plates_at(-20, 20, 15);
    ActiveSet contact(body, free_nodes(24));
    BodyState state{body.rest, {}};
    const PathResult path = close(plates, contact, state, {kind, value});
    ASSERT_TRUE(path.reached);
    const PathPoint& end = path.points.back();
    EXPECT_NEAR(kind == TargetKind::force ? end.paddle_N : end.pressure_kPa, value, 2e-3 * value);
    EXPECT_EQ(end.thickness, path.thickness);
  }
}

// A penalty that sets in at once, 320 times as stiff as the tangent knows: halves of the step are
// all too long, the place where the slope vanishes is found at once.
TEST(StepSearch, ShortensToWhereAKinkedEnergyIsFlat) {
  QuadraticBody body(4, 13);
  BodyState increment{Eigen::VectorXd::Ones(body.rest.size()), {}};
  BodySolve solve;
  solve.slope = 1;
  const auto appraise = [&](const BodyState& at, const BodyForces&) -> Appraisal {
    const double along = 320 * (at.x - body.rest)[0] - 1;
    return {std::abs(along), std::abs(along), along};
  };
  StepRule rule;
  rule.merit = 1;
  for (const bool kinks : {false, true}) {
    rule.kinks = kinks;
    BodyState state{body.rest, {}};
    StepResult result;
    EXPECT_EQ(search_step(body, increment, solve, rule, appraise, state, result), kinks);
    if (kinks) {
      EXPECT_NEAR(result.history.at(0).step_length, 1.0 / 320, 1e-4);
    } else {
      EXPECT_EQ(result.outcome, StepOutcome::no_descent);
    }
  }
}

// How many updates the multipliers need says nothing of how far the plates may move at once.
TEST(CompressionPath, CorrectionsDoNotShortenTheSteps) {
  QuadraticBody body(24, 13);
  BodyState exact{body.rest, {}}, penalised = exact;
  PathOptions options;
  options.first_step = options.longest_step = 4;
  PlatePair plates = plates_at(-20, 20, 15);
  ActiveSet active_set(body, free_nodes(24));
  const PathResult a = close(plates, active_set, exact, {TargetKind::thickness, 12}, options);
  plates = plates_at(-20, 20, 15);
  AugmentedLagrangian paper(body, free_nodes(24), {10});
  const PathResult b = close(plates, paper, penalised, {TargetKind::thickness, 12}, options);
  ASSERT_TRUE(a.reached && b.reached);
  int most = 0;
  for (const PathPoint& point : b.points) most = std::max(most, point.iterations);
  EXPECT_GT(most, 12) << "no position with many corrections: the test shows nothing";
  EXPECT_EQ(a.points.size(), b.points.size());
  EXPECT_LT((exact.x - penalised.x).lpNorm<Eigen::Infinity>(), 0.01);
}
