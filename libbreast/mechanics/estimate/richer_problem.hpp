// SPDX-License-Identifier: GPL-3.0-or-later
// The linearised problem of 27-node elements at a solution with 8-node ones, nearly incompressible:
// what estimate_error solves. Its terms are those of the scene on the richer mesh; its tangent is
// kept by cells in single precision, since an estimate needs two digits.
#pragma once

#include <vector>

#include "mechanics/estimate/error_estimate.hpp"
#include "mechanics/scene.hpp"

namespace breast {

class RicherProblem {
 public:
  /// κ/μ of a step, whose pressures are δp = −κM⁻¹(θ + Bδu): near the material, so that conjugate
  /// gradients are few; what volume error is left is for the pressures of the next.
  static constexpr double augmentation = 5;

  RicherProblem(const Scene& coarse, const State& state, const Vec3& gravity,
                const ContactEstimate& contact);
  RicherProblem(const RicherProblem&) = delete;
  RicherProblem& operator=(const RicherProblem&) = delete;

  const HexMesh& mesh() const { return mesh_; }
  /// False when an element is folded at its Gauss points.
  bool valid() const { return valid_; }
  /// −r − κBᵀM⁻¹θ on free components.
  const Eigen::VectorXd& right_hand_side() const { return right_; }
  Eigen::VectorXd apply(const Eigen::VectorXd& v) const;
  /// Additive two levels: the 8-node problem, and 3×3 blocks on the nodes between corners.
  Eigen::VectorXd precondition(const Eigen::VectorXd& r, const SaddleSolver& coarse) const;
  /// Moves the state by v, the pressures by what the volumes then ask for; the right-hand side is
  /// that of the new state, the matrix stays. False: an element folds.
  bool move(const Eigen::VectorXd& v);
  /// How far the state is from the 8-node solution, mm: moves so far, and what puts new nodes on the
  /// surface they slide on.
  Eigen::VectorXd moved() const { return state_.x - start_; }

 private:
  Eigen::VectorXd raise(const Eigen::VectorXd& corners) const;
  void hold_touching(const std::vector<TouchingNode>& touching);
  void linearise();

  int corners_ = 0;
  HexMesh mesh_;
  std::vector<std::vector<int>> between_;  // corners of every node that is not one
  Scene scene_;
  Problem problem_;
  State state_;  // 4 pressures an element
  Eigen::VectorXd start_;  // positions between those of the corners
  Constraints held_;       // at the state linearised about
  PackedTangent tangent_;
  std::vector<Mat3> blocks_;  // inverse, of nodes between corners
  Eigen::VectorXd right_;
  bool valid_ = true;
};

}  // namespace breast
