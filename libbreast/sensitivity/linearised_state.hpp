// SPDX-License-Identifier: GPL-3.0-or-later
// A converged state and its linearisation: one assembly and one factorisation, then any number of
// solves with the tangent, its transpose and the inverse problem.
#pragma once

#include <memory>
#include <vector>

#include "mechanics/reference_system.hpp"
#include "mechanics/scene.hpp"
#include "sensitivity/parameter_forces.hpp"
#include "sensitivity/plate_motion.hpp"

namespace breast {

/// A change of positions (δx or δX, mm, 3 per node) and pressures (Pa), or weights of both.
struct Direction {
  Eigen::VectorXd u, p;
};

/// A right-hand side: forces (µN, 3 per node) and volumes (mm³, pressures per element).
struct Imbalance {
  Eigen::VectorXd force, volume;
};

class LinearisedState {
 public:
  /// `contacts` are held along their normals; `plates` are the terms of plates in surface contact.
  /// `what` names the state in messages. Pressures of 27-node elements, which files do not store
  /// completely, are recovered. Throws Error (input) if the state is not an equilibrium under these
  /// options, and Error (failed) if it is an unstable one.
  LinearisedState(const Scene& scene, LoadedState state, std::vector<PlateContact> contacts,
                  const std::vector<std::shared_ptr<const Term>>& plates, const std::string& what);

  const LoadedState& state() const { return state_; }
  const std::vector<PlateContact>& contacts() const { return contacts_; }
  /// Norm of the unbalanced force, relative to the load or the plates' force.
  double residual() const { return residual_; }

  /// Solves K δx − Bᵀ δp = force, B δx + cM δp = volume for (δx, δp). Along the plates' normals δx
  /// is `imposed` (3 per node), if that is given; held components do not move.
  Direction solve(const Imbalance& right, const Eigen::VectorXd* imposed = nullptr) const;
  /// Solves the transposed system K λ + Bᵀ μ = force, −B λ + cM μ = volume for (λ, μ).
  Direction solve_transposed(const Imbalance& right) const;
  /// The products K δx − Bᵀ δp and B δx + cM δp, for all components.
  Imbalance apply(const Direction& change) const;

  /// Effect of moving the stress-free shape by δX at fixed x: K_X δX, B_X δX.
  Imbalance of_reference(const Eigen::VectorXd& change) const;
  /// Its transpose: K_Xᵀ λ + B_Xᵀ μ.
  Eigen::VectorXd of_reference_transposed(const Direction& weights) const;
  /// Solves for (δX, δp) that keeps x in equilibrium: K_X δX − Bᵀ δp = force, B_X δX + cM δp =
  /// volume.
  Direction solve_reference(const Imbalance& right) const;
  Direction solve_reference_transposed(const Imbalance& right) const;

 private:
  Forces assemble();
  void settle(const std::string& what);
  void refine(const Imbalance& right, Direction& solution) const;
  Direction checked(const ReferenceStep& step) const;

  const Scene& scene_;
  Problem problem_;
  LoadedState state_;
  std::vector<PlateContact> contacts_;
  Constraints held_, moved_;  // of x, and of the stress-free shape
  SaddleMatrix matrix_;
  ReferenceTangent reference_tangent_;
  SaddleSolver solver_;
  double residual_ = 0;
};

}  // namespace breast
