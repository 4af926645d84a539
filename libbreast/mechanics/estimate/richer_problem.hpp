// SPDX-License-Identifier: GPL-3.0-or-later
// The linearised, nearly incompressible problem with 27-node elements at a solution with 8-node
// elements, which estimate_error solves. Its terms are those of the scene on the richer mesh. Its
// tangent is stored per cell in single precision, which is sufficient for an estimate with two
// digits.
#pragma once

#include <vector>

#include "mechanics/estimate/error_estimate.hpp"
#include "mechanics/scene.hpp"

namespace breast {

class RicherProblem {
 public:
  /// κ/μ of a step, in which the pressures are δp = −κM⁻¹(θ + Bδu). It is close to the material's
  /// ratio, so that few conjugate-gradient iterations are needed; the pressures of the next step
  /// remove the remaining volume error.
  static constexpr double augmentation = 5;

  RicherProblem(const Scene& coarse, const State& state, const Vec3& gravity,
                const ContactEstimate& contact);
  RicherProblem(const RicherProblem&) = delete;
  RicherProblem& operator=(const RicherProblem&) = delete;

  const HexMesh& mesh() const { return mesh_; }
  /// False if an element is folded at its Gauss points.
  bool valid() const { return valid_; }
  /// −r − κBᵀM⁻¹θ on free components.
  const Eigen::VectorXd& right_hand_side() const { return right_; }
  Eigen::VectorXd apply(const Eigen::VectorXd& v) const;
  /// Additive two-level preconditioner: the 8-node problem, and 3×3 blocks at the nodes between
  /// corners.
  Eigen::VectorXd precondition(const Eigen::VectorXd& r, const SaddleSolver& coarse) const;
  /// Moves the state by v and the pressures according to the resulting volumes; the right-hand side
  /// becomes that of the new state, the matrix is kept. False if an element folds.
  bool move(const Eigen::VectorXd& v);
  /// Displacement of the state from the 8-node solution, mm: the steps so far, and the projection
  /// of new nodes onto the surface on which they slide.
  Eigen::VectorXd moved() const { return state_.x - start_; }

 private:
  Eigen::VectorXd raise(const Eigen::VectorXd& corners) const;
  void hold_touching(const std::vector<TouchingNode>& touching);
  void linearise();

  int corners_ = 0;
  HexMesh mesh_;
  std::vector<std::vector<int>> between_;  // corners between which every other node lies
  Scene scene_;
  Problem problem_;
  State state_;            // 4 pressures per element
  Eigen::VectorXd start_;  // initial positions, interpolated from the corners
  Constraints held_;       // constraints at the state of the linearisation
  PackedTangent tangent_;
  std::vector<Mat3> blocks_;  // inverse blocks of the nodes between corners
  Eigen::VectorXd right_;
  bool valid_ = true;
};

}  // namespace breast
