// SPDX-License-Identifier: GPL-3.0-or-later
// Estimate of the discretisation error: the distance of a solution with 8-node elements from one
// with 27-node elements on the same geometry, by two steps of the richer problem with one matrix,
// solved iteratively. It does not include errors of the geometry, the labels or the laws.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mechanics/equilibrium.hpp"
#include "mechanics/scene.hpp"

namespace breast {

struct ErrorEstimate {
  std::map<std::string, Vec3> landmarks;  ///< richer minus computed position, mm
  double worst_mm = 0;                    ///< largest length over the landmarks
  int iterations = 0;                     ///< conjugate gradients
  int steps = 0;        ///< 2, or 1 if the second fails: then accurate only to a factor of about 2
  bool usable = false;  ///< false: tangent indefinite or no convergence already in the first
  /// Method of the estimate, in words for reports.
  std::string how() const {
    return steps == 2 ? "two steps towards 27-node elements on the same geometry"
                      : "one step towards 27-node elements on the same geometry, a second fails";
  }
};

/// A node that a plate touches; without friction it may slide perpendicular to `normal`.
struct TouchingNode {
  int node = 0;
  int plate = 0;
  Vec3 normal{0, 0, 1};  ///< unit
};

/// The mesh of 27-node elements: the first `corners` nodes are those of the 8-node mesh; each of
/// the others lies midway between the corners that `between` lists for it.
struct RicherMesh {
  const HexMesh& mesh;
  int corners;
  const std::vector<std::vector<int>>& between;

  /// Interpolates a field from the corners (3 per node) to all nodes by the mean of each node's
  /// corners.
  Eigen::VectorXd raise(const Eigen::VectorXd& of_corners) const;
};

/// The contact of the plates with the body at the solution.
struct ContactEstimate {
  std::vector<TouchingNode> touching;
  /// Term of the plates' friction, or of their pressure on faces, on the 8-node mesh; null: none.
  std::shared_ptr<const Term> plates;
  std::function<std::shared_ptr<const Term>(const RicherMesh&)> raise_plates;
};

/// `state` is an equilibrium of `scene` under `gravity` (mm/s²) and the plates; `matrix` and
/// `solver` are used as workspace. All terms of the scene take part. The touching set is fixed:
/// these nodes, and those of the richer problem between nodes on one plate, are held along the
/// normal; the tangent neglects the curvature of a plate's edge.
ErrorEstimate estimate_error(const Scene& scene, const State& state, const Vec3& gravity,
                             SaddleMatrix& matrix, SaddleSolver& solver,
                             const ContactEstimate& contact = {});

/// Stores a usable estimate in the summary; `condition` continues the sentence on how it was found.
void note_estimate(const ErrorEstimate& estimate, const std::string& condition,
                   SolveSummary& summary);

}  // namespace breast
