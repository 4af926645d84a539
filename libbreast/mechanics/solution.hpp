// Shared ends of forward and backward: filling mesh and summary from a solved state.
#pragma once

#include "mechanics/mechanics.hpp"
#include "mechanics/scene.hpp"

namespace breast {

/// Appends Newton iterations of one load step to the record; `clock` is seconds since the start.
void record_iteration(SolveSummary& summary, int step, const NewtonIteration& iteration,
                      double clock);
/// Notes what the linear solver needed: call after the last factorisation.
void note_solver(const SaddleSolver& solver, const SaddleMatrix& matrix, SolveSummary& summary);
/// Copies positions, pressure, det F, scaled-Jacobian-free results and the record into the mesh.
void store_state(HexMesh& mesh, const Scene& scene, const Eigen::VectorXd& reference,
                 const SaddleState& state, SolveSummary& summary);
/// Adds to `doubts` what the final state gives reason to doubt.
void judge(SolveSummary& summary, const Scene& scene, const Eigen::VectorXd& reference,
           const SaddleState& state);

/// Loads that grow in steps when one step does not converge.
struct LoadPath {
  double done = 0, step = 1;
  static constexpr double smallest = 1.0 / 40;
  double next() const { return std::min(1.0, done + step); }
  void succeed() {
    done = next();
    step *= 1.5;
  }
  /// False when the step would become too small.
  bool fail() {
    step *= 0.5;
    return step >= smallest;
  }
  bool finished() const { return done >= 1.0; }
};

}  // namespace breast
