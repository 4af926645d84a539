// How far a solution with 8-node elements is from one with 27-node elements on the same geometry:
// two steps of the richer problem with one matrix, solved iteratively. Covers the discretisation
// inside the given geometry; not the geometry, the labels or the laws.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mechanics/scene.hpp"

namespace breast {

struct ErrorEstimate {
  std::map<std::string, Vec3> landmarks;  ///< richer minus computed position, mm
  double worst_mm = 0;                    ///< largest length over the landmarks
  int iterations = 0;                     ///< conjugate gradients
  int steps = 0;        ///< 2, or 1 where the second fails: then good to a factor of about 2 only
  bool usable = false;  ///< false: tangent indefinite or no convergence already in the first
  /// How it was found, for reports.
  std::string how() const {
    return steps == 2 ? "two steps towards 27-node elements on the same geometry"
                      : "one step towards 27-node elements on the same geometry, a second fails";
  }
};

/// A node that a plate touches without friction; it may slide at right angles to `normal`.
struct TouchingNode {
  int node = 0;
  int plate = 0;
  Vec3 normal{0, 0, 1};  ///< unit
};

/// `state` is an equilibrium of 8-node elements under nodal gravity forces and the plates at
/// `touching`; `matrix` and `solver` are used as workspace. The touching set is held: these nodes,
/// and those of the richer problem between nodes on one plate, keep their place along the normal;
/// the curvature of a plate's edge is left out of the tangent.
ErrorEstimate estimate_error(const Scene& scene, const Eigen::VectorXd& reference,
                             const SaddleState& state, const Vec3& gravity, SaddleMatrix& matrix,
                             SaddleSolver& solver, const std::vector<TouchingNode>& touching = {});

}  // namespace breast
