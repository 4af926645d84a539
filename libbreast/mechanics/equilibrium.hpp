// SPDX-License-Identifier: GPL-3.0-or-later
// The result of a mechanics solve: a shape in equilibrium, how it was found and what it cost.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/report.hpp"
#include "mechanics/pressure_filter.hpp"
#include "mechanics/skin_state.hpp"
#include "mechanics/stability/remedy.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// Summary of a solve, as written by write_report.
struct SolveSummary {
  SolveRecord record;
  /// Reason why there is no usable result, as a stable identifier: that of a NewtonStop;
  /// "no_stress_free_body" (backward: the solution path ends before the full load, so that no body
  /// was found that gravity deforms into the imaged shape); "unstable_equilibrium" (backward and
  /// forward: the shape is an equilibrium, but an unstable one); or one of compress
  /// (contact/failure.hpp). Empty if converged.
  std::string reason_id;
  double load_reached = 1;  ///< fraction of the load up to which solutions were found
  /// Backward, without a stable solution: factor on all stiffnesses that would give one (upper
  /// bound, to 10 %); 0 if not known.
  double stiffness_factor_needed = 0;
  /// Backward and forward, without a stable solution: the smallest change found that gives one.
  std::optional<Remedy> remedy;
  /// For an unstable equilibrium: the skin's share (0 to 1) of the negative curvature of the energy
  /// along the lowest mode of the tangent.
  std::optional<double> skin_share;
  int newton_iterations = 0, factorisations = 0, steps = 0;
  int linear_iterations =
      0;                ///< linear iterations of all Newton steps: see SaddleStep, ReferenceStep
  double residual = 0;  ///< relative to the load
  double min_det_F = 0, max_volume_error = 0;
  long long unknowns = 0;
  Timer timer;
  std::string linear_solver;                                      ///< direct | multigrid, as chosen
  double matrix_values = 0, factor_values = 0, factor_gflop = 0;  ///< see SaddleSolver
  /// Whether the tangent of the final state is positive definite: proved by a Cholesky
  /// factorisation, or with multigrid inferred from a Lanczos iteration.
  bool stable = true;
  /// Estimated discretisation error at the landmarks (largest, and by name: exact minus computed),
  /// mm; negative when not estimated.
  double error_estimate_mm = -1;
  std::string error_estimate_how;  ///< or the reason why there is none
  std::map<std::string, Vec3> landmark_error_mm;
  std::map<Tissue, PressureQuality> pressure_quality;  ///< 8-node elements, by tissue
  SkinState skin;                                      ///< wrinkling; see mechanics/skin_state.hpp
  std::vector<std::string> doubts;  ///< statements about doubtful aspects of the result
  bool converged() const { return record.status == SolveStatus::converged; }
};

/// The result as arrays per node or element of the mesh that was solved. If not converged, they are
/// those of the last valid state, or empty.
struct Equilibrium : SolveSummary {
  std::vector<Vec3> reference;           ///< stress-free shape
  std::vector<Vec3> points;              ///< the shape found; for backward the stress-free shape
  std::vector<double> pressure, det_F;   ///< element means, pressure in Pa; for backward those of
                                         ///< the imaged shape
  Vec3 gravity{0, 0, 0};                 ///< mm/s² acting on `points`
  std::optional<ContactRecord> contact;  ///< compress only
  std::vector<double> contact_pressure;  ///< kPa per node, compress only
};

/// Stores the state in the mesh on which it was solved, replacing the previous state, for writing
/// to a file.
void store(const Equilibrium& equilibrium, HexMesh& mesh);

}  // namespace breast
