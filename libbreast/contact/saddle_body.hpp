// The incompressible body of mechanics as the contact solver sees it.
#pragma once

#include "contact/body.hpp"
#include "solve/newton.hpp"
#include "solve/saddle.hpp"

namespace breast {

class SaddleBody : public ContactBody {
 public:
  /// `held`: chest wall and cut; nodes named there must not be contact candidates. All references
  /// must outlive the body. `weight` is the sum of the external forces, µN.
  SaddleBody(const SaddleProblem& problem, SaddleSolver& solver, const Constraints& held,
             const Vec3& weight);

  int nodes() const override;
  void remove_held(Eigen::VectorXd& v) const override { held_.project(v); }
  double load_norm() const override { return problem_.load_norm(); }
  Vec3 weight() const override { return weight_; }
  bool forces(const BodyState& state, BodyForces& forces) override;
  bool assemble(const BodyState& state) override;
  void add_to_tangent(int node, const Mat3& block) override;
  BodySolve solve(const std::vector<NormalConstraint>& constraints, const Eigen::VectorXd& residual,
                  BodyState& increment) override;

  /// Smallest det F a trial state may have, as a part of that of the last assembled state.
  static constexpr double determinant_guard = 0.05;

 private:
  const SaddleProblem& problem_;
  SaddleSolver& solver_;
  const Constraints& held_;
  Vec3 weight_;
  SaddleMatrix matrix_;
  Eigen::VectorXd theta_;
  double assembled_det_F_ = 1;
};

}  // namespace breast
