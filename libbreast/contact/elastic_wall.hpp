// An elastic support in place of a held chest wall: springs under the pectoral faces, at rest in
// the stress-free shape, with one stiffness per area along the wall's normal and one along the
// wall.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/hex_mesh.hpp"
#include "solve/newton.hpp"

namespace breast {

/// Stiffness per area of the imaged chest wall, kPa/mm.
struct WallSprings {
  double normal = 0, tangential = 0;
};

class ElasticWall {
 public:
  ElasticWall(const HexMesh& mesh, const WallSprings& springs);
  /// Adds the internal forces of the springs at positions x (3 per node); returns their energy.
  double add_forces(const Eigen::VectorXd& x, Eigen::VectorXd& residual) const;
  void add_stiffness(SaddleMatrix& matrix) const;
  /// Force of the wall on the body, µN.
  Vec3 force_on_body(const Eigen::VectorXd& x) const;

 private:
  struct Spring {
    int node = 0;
    Vec3 rest{0, 0, 0};
    Mat3 stiffness = Mat3::Zero();  ///< µN/mm
  };
  std::vector<Spring> springs_;
};

/// A problem with an elastic wall under it. Both must outlive it.
class ProblemOnWall final : public SaddleProblem {
 public:
  ProblemOnWall(const SaddleProblem& body, const ElasticWall& wall) : body_(body), wall_(wall) {}
  std::shared_ptr<const NodePattern> pattern() const override { return body_.pattern(); }
  SaddleMatrix make_matrix() const override { return body_.make_matrix(); }
  SaddleForces forces(const SaddleState& state, const Eigen::VectorXd* kappa) const override;
  bool tangent(const SaddleState& state, SaddleForces& forces, SaddleMatrix& matrix) const override;
  double load_norm() const override { return body_.load_norm(); }
  double volume_scale(int element) const override { return body_.volume_scale(element); }

 private:
  const SaddleProblem& body_;
  const ElasticWall& wall_;
};

}  // namespace breast
