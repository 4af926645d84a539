// The paper's way of holding the plates out of the body: Uzawa updates of nodal contact forces
// around penalised equilibria. Kept to compare with the active set; it leaves a small penetration.
#pragma once

#include <vector>

#include "contact/solver.hpp"

namespace breast {

struct AugmentedLagrangianOptions {
  double penalty = 1e5;         ///< µN/mm per node to start with; about 10 μ h
  double gap_tolerance = 2e-4;  ///< mm of penetration, or of gap under a force
  int most_updates = 25, most_iterations = 40;
};

class AugmentedLagrangian : public ContactSolver {
 public:
  AugmentedLagrangian(ContactBody& body, std::vector<int> candidates,
                      AugmentedLagrangianOptions options = {});

  StepResult solve(const PlatePair& plates, BodyState& state, double tolerance) override;
  std::vector<double> normal_forces(const PlatePair& plates, const BodyState& state,
                                    const BodyForces& forces) const override;
  const std::vector<int>& candidates() const override { return candidates_; }

 private:
  struct Contact;
  struct Balance;
  Contact contact(const PlatePair& plates, const Eigen::VectorXd& x, std::size_t candidate) const;
  Balance balance(const PlatePair& plates, const BodyState& state, const BodyForces& forces) const;
  bool equilibrate(const PlatePair& plates, BodyState& state, double tolerance, StepResult& result);
  double update_multipliers(const PlatePair& plates, const BodyState& state);

  ContactBody& body_;
  std::vector<int> candidates_;
  AugmentedLagrangianOptions options_;
};

}  // namespace breast
