// Newton's method for the equilibria of a saddle problem: globalised, with prescribed
// displacements. Near the end a factor serves several steps: a tangent a little out of date costs
// some contraction, a factorisation more.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "core/report.hpp"
#include "solve/saddle.hpp"

namespace breast {

/// Positions u (3 per node) and pressures p (rows per element).
struct SaddleState {
  Eigen::VectorXd u, p;
};

/// Residuals of a state: r = ∂Π/∂u, θ = −∂Π/∂p (per element, mm³).
struct SaddleForces {
  bool valid = false;    ///< false: a folded element or a law out of range; nothing else is set
  int bad_element = -1;  ///< the first one, when not valid
  int element_count = 0;
  double energy = 0;
  Eigen::VectorXd r, theta;
  /// Gradient of the augmented energy, r + κBᵀM⁻¹θ; only when asked for with a κ.
  Eigen::VectorXd augmented;
  double min_det_F = 1, max_det_F = 1, max_volume_error = 0;
};

/// The nonlinear problem: what mechanics provides and a Newton iteration needs.
class SaddleProblem {
 public:
  virtual ~SaddleProblem() = default;
  virtual std::shared_ptr<const NodePattern> pattern() const = 0;
  virtual SaddleMatrix make_matrix() const = 0;
  /// `kappa` (per element) may be null.
  virtual SaddleForces forces(const SaddleState& state, const Eigen::VectorXd* kappa) const = 0;
  /// Forces and tangent together. False (and forces.valid false) at an inadmissible state.
  virtual bool tangent(const SaddleState& state, SaddleForces& forces,
                       SaddleMatrix& matrix) const = 0;
  /// Norm the residual is compared with, µN; and the volume each θ is compared with, mm³.
  virtual double load_norm() const = 0;
  virtual double volume_scale(int element) const = 0;
};

struct NewtonOptions {
  int max_iterations = 30;
  double tolerance = 1e-10;         ///< ‖r on free components‖ / load norm
  double volume_tolerance = 1e-11;  ///< |θ_e| / V_e
  double min_step = 1.0 / 256;
  /// Near the end one factor serves several steps. Stops just below the tolerance, where Newton's
  /// last step would go far below: not for the start of a path that magnifies small differences.
  bool reuse_factor = false;
  /// Gives up at the first tangent that is not positive definite and at the first linear system
  /// that 60 iterations do not solve: where somebody else stands by.
  bool hasty = false;
  Timer* timer = nullptr;           ///< seconds by phase, when wanted
  double determinant_guard = 0.05;  ///< a trial may shrink the smallest det F to this part
};

/// Why a Newton solve ended without convergence.
enum class NewtonStop { none, folded, iteration_limit, indefinite, no_step, linear_solver };
/// Stable identifier: "", "folded_element", "iteration_limit", "indefinite_tangent",
/// "no_admissible_step", "linear_solver".
const char* stop_name(NewtonStop stop);

struct NewtonIteration {
  double residual = 0, min_det_F = 0, max_det_F = 0, step_length = 0, shift = 0;
  double residual_before = 0;
  int linear_iterations = 0;  ///< see SaddleStep
};

struct NewtonResult {
  bool converged = false;
  NewtonStop stop = NewtonStop::none;
  std::string reason;  ///< why not, in words
  std::vector<NewtonIteration> iterations;
  int factorisations = 0, indefinite = 0;
  SaddleForces forces;  ///< at the final state (valid when the last state was admissible)
  double residual = 0;
};

/// Force (µN) that rounding the positions alone can make: no residual gets reliably below it.
double rounding_force(const SaddleMatrix& matrix, const Eigen::VectorXd& u);

/// Moves `state` to equilibrium. `targets`: positions of held components (3 per node; other entries
/// ignored); null: held components stay. Not converged: `state` is the last admissible one.
NewtonResult newton(const SaddleProblem& problem, SaddleSolver& solver, SaddleMatrix& matrix,
                    const Constraints& constraints, const Eigen::VectorXd* targets,
                    SaddleState& state, const NewtonOptions& options = {},
                    const std::function<void(const NewtonIteration&)>& watch = {});

}  // namespace breast
