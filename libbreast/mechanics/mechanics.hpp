// Forward and backward: the two directions of one discrete equilibrium R(X, x, p) = 0.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "core/report.hpp"
#include "material/law.hpp"
#include "mechanics/pressure_filter.hpp"
#include "mechanics/skin_state.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

enum class Element { q1p0, q2p1 };
enum class Invariants { isochoric, plain };
enum class Cut { free, fixed, roller };
/// How the discretisation error of 8-node elements is estimated: not at all, by two steps with
/// 27-node elements and one matrix (mechanics/error_estimate.hpp), or by solving once more with
/// them (mechanics/second_solution.hpp).
enum class Estimate { none, step, q2 };

/// The MECHANICS options every mechanics tool shares.
struct MechanicsOptions {
  MaterialSet materials;
  Element element = Element::q1p0;
  Invariants invariants = Invariants::isochoric;
  double bulk_ratio = 0;  ///< K/μ; 0 means exactly incompressible
  Cut cut = Cut::free;
  std::string solver = "auto";  ///< auto | direct | multigrid; see mechanics/chosen_solver.hpp
  Estimate estimate = Estimate::none;
};

/// How a solve went; also fills the contract's report keys.
struct SolveSummary {
  SolveRecord record;
  /// Why there is no usable answer, as a stable identifier: one of NewtonStop's, or of backward
  /// "singular_inverse", "no_stress_free_body" (the solutions end before the full load: no body
  /// that gravity deforms into the imaged shape was found to exist) and "unstable_equilibrium" (one
  /// exists, but would not stay in that shape). Empty when converged.
  std::string reason_id;
  double load_reached = 1;  ///< part of the load up to which solutions were found
  /// Backward, unstable or without a body: stiffnesses times this would give a stable answer (upper
  /// bound, to 10 %); 0 when not known.
  double stiffness_factor_needed = 0;
  int newton_iterations = 0, factorisations = 0, steps = 0;
  int linear_iterations = 0;  ///< of all Newton steps: see SaddleStep, ReferenceStep
  double residual = 0;        ///< relative to the load
  double min_det_F = 0, max_volume_error = 0;
  long long unknowns = 0;
  Timer timer;
  std::string linear_solver;                                      ///< direct | multigrid, as chosen
  double matrix_values = 0, factor_values = 0, factor_gflop = 0;  ///< see SaddleSolver
  bool stable = true;  ///< backward: the imaged shape is a stable equilibrium of the shape found
  /// Estimated discretisation error at the landmarks (largest, and by name: exact minus computed),
  /// mm; negative when not estimated.
  double error_estimate_mm = -1;
  std::string error_estimate_how;
  std::map<std::string, Vec3> landmark_error_mm;
  std::map<Tissue, PressureQuality> pressure;  ///< 8-node elements, by tissue
  SkinState skin;                              ///< wrinkling; see mechanics/skin_state.hpp
  std::vector<std::string> doubts;             ///< what a reader should doubt
  bool converged() const { return record.status == "converged"; }
};

/// Solves for mesh.points under `gravity` (mm/s², LPS) from mesh.reference; nodal gravity forces
/// are those of mesh.imaged. Fills pressure, det_F, solve. Not converged: status says so, no throw;
/// the mesh then holds the last good state.
SolveSummary solve_forward(HexMesh& mesh, const Vec3& gravity, const MechanicsOptions& options,
                           Progress& progress = no_progress());

/// Solves for mesh.reference such that the imaged shape is in equilibrium under `gravity`; sets
/// mesh.reference and mesh.points (= reference), pressure (of the imaged state), det_F, solve.
SolveSummary solve_backward(HexMesh& mesh, const Vec3& gravity, const MechanicsOptions& options,
                            Progress& progress = no_progress());

/// The same under any dead nodal forces (µN, 3 per node) instead of gravity, starting from
/// mesh.reference, where held nodes stay.
SolveSummary solve_backward_under(HexMesh& mesh, const Eigen::VectorXd& forces,
                                  const MechanicsOptions& options,
                                  Progress& progress = no_progress());

/// The same by fixed point, X ← X − (x(X) − x_imaged), one forward solve an iteration (Sellier
/// 2011): slower and less robust, an independent check of solve_backward.
SolveSummary solve_backward_fixed_point(HexMesh& mesh, const Vec3& gravity,
                                        const MechanicsOptions& options, double tolerance_mm = 1e-8,
                                        int max_iterations = 60,
                                        Progress& progress = no_progress());

/// Writes the summary under the contract's keys.
void write_report(const SolveSummary& summary, const HexMesh& mesh, const MechanicsOptions& options,
                  Report& report);

}  // namespace breast
