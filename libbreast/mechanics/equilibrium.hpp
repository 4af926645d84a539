// SPDX-License-Identifier: GPL-3.0-or-later
// What a mechanics solve returns: a shape in equilibrium, how it was found and what it cost.
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

/// How a solve went; what write_report puts into a report.
struct SolveSummary {
  SolveRecord record;
  /// Why there is no usable answer, as a stable identifier: one of NewtonStop's, or of backward
  /// "no_stress_free_body" (the solutions end before the full load: no body that gravity deforms
  /// into the imaged shape was found to exist), of backward and forward "unstable_equilibrium" (the
  /// shape is in balance but would not stay), or of compress (contact/failure.hpp). Empty when
  /// converged.
  std::string reason_id;
  double load_reached = 1;  ///< fraction of the load up to which solutions were found
  /// Backward, unstable or without a body: stiffnesses times this would give a stable answer (upper
  /// bound, to 10 %); 0 when not known.
  double stiffness_factor_needed = 0;
  /// Backward and forward without a stable answer: the smallest change found that gives one.
  std::optional<Remedy> remedy;
  /// Of an unstable equilibrium: the skin's share, 0 to 1, of what lowers the energy along the
  /// lowest mode of the tangent.
  std::optional<double> skin_share;
  int newton_iterations = 0, factorisations = 0, steps = 0;
  int linear_iterations = 0;  ///< of all Newton steps: see SaddleStep, ReferenceStep
  double residual = 0;        ///< relative to the load
  double min_det_F = 0, max_volume_error = 0;
  long long unknowns = 0;
  Timer timer;
  std::string linear_solver;                                      ///< direct | multigrid, as chosen
  double matrix_values = 0, factor_values = 0, factor_gflop = 0;  ///< see SaddleSolver
  /// The tangent of the final state is positive definite: by a factor's proof, with multigrid by
  /// the evidence of a Lanczos iteration.
  bool stable = true;
  /// Estimated discretisation error at the landmarks (largest, and by name: exact minus computed),
  /// mm; negative when not estimated.
  double error_estimate_mm = -1;
  std::string error_estimate_how;  ///< or why there is none
  std::map<std::string, Vec3> landmark_error_mm;
  std::map<Tissue, PressureQuality> pressure_quality;  ///< 8-node elements, by tissue
  SkinState skin;                              ///< wrinkling; see mechanics/skin_state.hpp
  std::vector<std::string> doubts;             ///< what a reader should doubt
  bool converged() const { return record.status == SolveStatus::converged; }
};

/// Arrays per node or element of the mesh that was solved. Not converged: the last good state,
/// or empty where there is none.
struct Equilibrium : SolveSummary {
  std::vector<Vec3> reference;  ///< stress-free shape
  std::vector<Vec3> points;     ///< the shape this is about; of backward the stress-free one too
  std::vector<double> pressure, det_F;  ///< Pa, mean; of backward those of the imaged shape
  Vec3 gravity{0, 0, 0};                ///< mm/s² acting on `points`
  std::optional<ContactRecord> contact;   ///< compress only
  std::vector<double> contact_pressure;   ///< kPa per node, compress only
};

/// Puts the state into the mesh it was solved on, in place of what it held: what a file shows.
void store(const Equilibrium& equilibrium, HexMesh& mesh);

}  // namespace breast
