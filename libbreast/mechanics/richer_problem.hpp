// The linearised problem of 27-node elements at a solution with 8-node ones, nearly incompressible:
// what estimate_error solves. Kept per element in single precision: an estimate needs two digits.
#pragma once

#include <vector>

#include "mechanics/error_estimate.hpp"
#include "mechanics/scene.hpp"

namespace breast {

template <int N, int P>
struct HexInput;
template <int N, int P>
struct HexOutput;

class RicherProblem {
 public:
  /// κ/μ of a step, whose pressures are δp = κM⁻¹(θ + Bδu): near the material, so that conjugate
  /// gradients are few; what volume error is left is for the pressures of the next.
  static constexpr double augmentation = 5;

  RicherProblem(const Scene& scene, const Eigen::VectorXd& reference, const SaddleState& state,
                const Vec3& gravity, const std::vector<TouchingNode>& touching);

  const HexMesh& mesh() const { return mesh_; }
  /// False when an element is folded at its Gauss points.
  bool valid() const { return valid_; }
  /// −r − κBᵀM⁻¹θ on free components.
  const Eigen::VectorXd& right_hand_side() const { return right_; }
  Eigen::VectorXd apply(const Eigen::VectorXd& v) const;
  /// Additive two levels: the 8-node problem, and 3×3 blocks on the nodes between corners.
  Eigen::VectorXd precondition(const Eigen::VectorXd& r, const SaddleSolver& coarse) const;
  /// Moves the state by v, the pressures by what the volumes then ask for; the right-hand side is
  /// that of the new state, the matrix stays. False: an element folds.
  bool move(const Eigen::VectorXd& v);

 private:
  struct Element;
  Eigen::VectorXd raise(const Eigen::VectorXd& corners) const;
  void hold_between(const std::vector<TouchingNode>& touching);
  void prepare_faces();
  Element element(int e, const Eigen::VectorXd& moved) const;
  void add_elements();
  void add_rights(const Eigen::MatrixXd& rights);
  void add_faces(bool matrices);  // forces of the skin into right_; with its matrices, once
  void invert_blocks();
  double kappa(int e, const HexOutput<27, 4>& out) const;

  const Scene& scene_;
  Vec3 gravity_;
  HexMesh mesh_;
  Constraints walls_;
  int corners_ = 0;
  std::vector<std::vector<int>> between_;  // corners of every node that is not one
  Eigen::VectorXd reference_, deformed_, kappa_, pressure_;  // 4 pressures an element
  std::vector<float> matrices_;  // lower triangles by columns, of every element
  std::vector<Eigen::Matrix<float, 27, 27>> face_matrices_;
  std::vector<std::vector<int>> faces_;
  std::vector<Eigen::Matrix<double, 9, 1>> face_volume_;
  std::vector<Mat3> blocks_;  // of nodes between corners
  Eigen::VectorXd right_;
  bool valid_ = true;
};

}  // namespace breast
