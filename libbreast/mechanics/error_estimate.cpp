#include "mechanics/error_estimate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "fem/hex_kernel.hpp"
#include "fem/membrane_kernel.hpp"
#include "mechanics/element_order.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

// Ratio κ/μ in the correction: nearly incompressible, and few iterations.
constexpr double soft_augmentation = 100;
constexpr double relative_accuracy = 0.02;
constexpr int max_iterations = 200;

using Matrix81 = Eigen::Matrix<float, 81, 81>;
using Vector81 = Eigen::Matrix<double, 81, 1>;
using Nodes27 = Eigen::Matrix<double, 3, 27>;

// The linearised problem of 27-node elements at the raised state, kept per element in single
// precision: an estimate needs two digits.
class RicherProblem {
 public:
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

 private:
  Eigen::VectorXd raise(const Eigen::VectorXd& corners) const;
  void hold_between(const std::vector<TouchingNode>& touching);
  void add_elements(const Scene& scene, const Eigen::VectorXd& reference, const SaddleState& state,
                    const Vec3& gravity);
  void add_faces(const Scene& scene, const Eigen::VectorXd& reference,
                 const Eigen::VectorXd& deformed);
  void invert_blocks();
  double kappa(const Law& law, const HexOutput<27, 4>& out) const;

  HexMesh mesh_;
  Constraints walls_;
  int corners_ = 0;
  std::vector<std::vector<int>> between_;  // corners of every node that is not one
  std::vector<Matrix81> matrices_;
  std::vector<Eigen::Matrix<float, 27, 27>> face_matrices_;
  std::vector<std::vector<int>> faces_;
  std::vector<Mat3> blocks_;  // of nodes between corners
  Eigen::VectorXd right_;
  bool valid_ = true;
};

// Corner means: which corners each new node lies between.
std::vector<std::vector<int>> nodes_between(const HexMesh& mesh, int corners) {
  std::vector<std::vector<int>> between(static_cast<std::size_t>(mesh.nodes() - corners));
  for (int e = 0; e < mesh.elements(); ++e) {
    for (int a = 8; a < 27; ++a) {
      std::vector<int>& list = between[mesh.element(e)[a] - corners];
      if (!list.empty()) continue;
      const Vec3 at = hex_node_local(2, a);
      for (int c = 0; c < 8; ++c) {
        const Vec3 corner = hex_node_local(1, c);
        bool meets = true;
        for (int k = 0; k < 3; ++k) meets = meets && (at[k] == 0 || at[k] == corner[k]);
        if (meets) list.push_back(mesh.element(e)[c]);
      }
    }
  }
  return between;
}

void hold(const std::vector<TouchingNode>& touching, Constraints& held) {
  for (const TouchingNode& t : touching) {
    if (held.at(t.node) == nullptr) held.hold_normal(t.node, t.normal);
  }
}

RicherProblem::RicherProblem(const Scene& scene, const Eigen::VectorXd& reference,
                             const SaddleState& state, const Vec3& gravity,
                             const std::vector<TouchingNode>& touching)
    : mesh_(raise_order(scene.mesh())),
      walls_(wall_constraints(mesh_, scene.options().cut)),
      corners_(scene.nodes()),
      between_(nodes_between(mesh_, corners_)) {
  hold(touching, walls_);
  hold_between(touching);
  const Eigen::VectorXd raised_reference = raise(reference);
  const SaddleState raised{raise(state.u), state.p};
  right_ = Eigen::VectorXd::Zero(3L * mesh_.nodes());
  add_elements(scene, raised_reference, raised, gravity);
  if (valid_ && mesh_.skin_model == SkinModel::membrane) {
    add_faces(scene, raised_reference, raised.u);
  }
  walls_.project(right_);
  invert_blocks();
}

// A new node rests on a plate when all corners it lies between do.
void RicherProblem::hold_between(const std::vector<TouchingNode>& touching) {
  std::vector<const TouchingNode*> at(static_cast<std::size_t>(corners_), nullptr);
  for (const TouchingNode& t : touching) at[t.node] = &t;
  for (std::size_t i = 0; i < between_.size(); ++i) {
    const TouchingNode* first = at[between_[i].front()];
    Vec3 normal = Vec3::Zero();
    bool all = first != nullptr;
    for (const int corner : between_[i]) {
      all = all && at[corner] != nullptr && at[corner]->plate == first->plate;
      if (all) normal += at[corner]->normal;
    }
    const int node = corners_ + int(i);
    if (all && walls_.at(node) == nullptr) walls_.hold_normal(node, normal.normalized());
  }
}

Eigen::VectorXd RicherProblem::raise(const Eigen::VectorXd& corners) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(3L * mesh_.nodes());
  out.head(corners.size()) = corners;
  for (std::size_t i = 0; i < between_.size(); ++i) {
    auto node = out.segment<3>(3L * (corners_ + long(i)));
    for (const int c : between_[i]) node += corners.segment<3>(3L * c) / double(between_[i].size());
  }
  return out;
}

double RicherProblem::kappa(const Law& law, const HexOutput<27, 4>& out) const {
  const double now = out.k.trace() / (10.0 / 3 * out.gradient_square);
  return soft_augmentation * std::max(now, law.shear_modulus());
}

void RicherProblem::add_elements(const Scene& scene, const Eigen::VectorXd& reference,
                                 const SaddleState& state, const Vec3& gravity) {
  const HexRule<27>& rule = HexRule<27>::get();
  const MaterialSet& materials = scene.options().materials;
  matrices_.resize(static_cast<std::size_t>(mesh_.elements()));
  Eigen::MatrixXd rights(81, mesh_.elements());
  bool all_valid = true;
#pragma omp parallel num_threads(threads()) reduction(&& : all_valid)
  {
    HexInput<27, 4> in;
    const auto out = std::make_unique<HexOutput<27, 4>>();
    in.isochoric = scene.options().invariants == Invariants::isochoric;
#pragma omp for schedule(dynamic, 16)
    for (int e = 0; e < mesh_.elements(); ++e) {
      Nodes27 imaged;
      for (int a = 0; a < 27; ++a) {
        const int node = mesh_.element(e)[a];
        in.reference.col(a) = reference.segment<3>(3L * node);
        in.deformed.col(a) = state.u.segment<3>(3L * node);
        imaged.col(a) = mesh_.imaged[node];
      }
      in.pressure << state.p[e], 0, 0, 0;
      in.law = &materials.law(mesh_.tissue[e]);
      const Vec3 centre = imaged.rowwise().mean();
      const double size = std::cbrt(scene.assembly().imaged_volume()[e]);
      Eigen::Matrix4d mass = Eigen::Matrix4d::Zero();
      Eigen::Matrix<double, 27, 1> load = Eigen::Matrix<double, 27, 1>::Zero();
      for (int q = 0; q < HexRule<27>::points; ++q) {
        in.basis.col(q) << 1, (imaged * rule.values[q] - centre) / size;
        const Mat3 jacobian = imaged * rule.gradients[q].transpose();
        const double volume = rule.weight[q] * jacobian.determinant();
        mass += volume * in.basis.col(q) * in.basis.col(q).transpose();
        load += materials.density[std::size_t(mesh_.tissue[e])] * volume * rule.values[q];
      }
      hex_kernel<27, 4>(in, {true, false}, *out);
      all_valid = all_valid && out->valid;
      if (!out->valid) continue;
      const double factor = kappa(*in.law, *out);
      const Eigen::Matrix<double, 4, 81> weighted = factor * (mass.inverse() * out->b);
      matrices_[e] = (out->k + out->b.transpose() * weighted).cast<float>();
      const Nodes27 residual = out->residual - gravity * load.transpose();
      rights.col(e) =
          -Eigen::Map<const Vector81>(residual.data()) - weighted.transpose() * out->theta;
    }
  }
  valid_ = all_valid;
  for (int e = 0; e < mesh_.elements() && valid_; ++e) {
    for (int a = 0; a < 27; ++a) {
      right_.segment<3>(3L * mesh_.element(e)[a]) += rights.col(e).segment<3>(3L * a);
    }
  }
}

void RicherProblem::add_faces(const Scene& scene, const Eigen::VectorXd& reference,
                              const Eigen::VectorXd& deformed) {
  const QuadRule<9>& rule = QuadRule<9>::get();
  for (std::size_t f = 0; f < mesh_.skin_faces.size(); ++f) {
    faces_.push_back(face_nodes(mesh_, mesh_.skin_faces[f]));
    MembraneInput<9> in;
    Eigen::Matrix<double, 3, 9> imaged;
    for (int a = 0; a < 9; ++a) {
      in.reference.col(a) = reference.segment<3>(3L * faces_[f][a]);
      in.deformed.col(a) = deformed.segment<3>(3L * faces_[f][a]);
      imaged.col(a) = mesh_.imaged[faces_[f][a]];
    }
    for (int q = 0; q < QuadRule<9>::points; ++q) {
      const Eigen::Matrix<double, 3, 2> t = imaged * rule.gradients[q].transpose();
      in.volume[q] =
          mesh_.skin_thickness[f] * rule.weight[q] * std::sqrt((t.transpose() * t).determinant());
    }
    in.law = &scene.options().materials.law(Tissue::skin);
    MembraneOutput<9> out;
    membrane_kernel<9>(in, {true, false}, out);
    valid_ = valid_ && out.valid;
    face_matrices_.push_back(out.k.cast<float>());
    for (int a = 0; a < 9; ++a) right_.segment<3>(3L * faces_[f][a]) -= out.residual.col(a);
  }
}

void RicherProblem::invert_blocks() {
  blocks_.assign(between_.size(), Mat3::Zero());
  for (int e = 0; e < mesh_.elements(); ++e) {
    for (int a = 8; a < 27; ++a) {
      blocks_[mesh_.element(e)[a] - corners_] +=
          matrices_[e].block<3, 3>(3 * a, 3 * a).cast<double>();
    }
  }
  for (std::size_t f = 0; f < face_matrices_.size(); ++f) {
    for (int a = 4; a < 9; ++a) {
      blocks_[faces_[f][a] - corners_] +=
          face_matrices_[f].block<3, 3>(3 * a, 3 * a).cast<double>();
    }
  }
  for (Mat3& block : blocks_) block = block.inverse().eval();
}

Eigen::VectorXd RicherProblem::apply(const Eigen::VectorXd& v) const {
  Eigen::MatrixXd products(81, mesh_.elements());
#pragma omp parallel for num_threads(threads()) schedule(static)
  for (int e = 0; e < mesh_.elements(); ++e) {
    Eigen::Matrix<float, 81, 1> local;
    for (int a = 0; a < 27; ++a) {
      local.segment<3>(3L * a) = v.segment<3>(3L * mesh_.element(e)[a]).cast<float>();
    }
    products.col(e) = (matrices_[e] * local).cast<double>();
  }
  Eigen::VectorXd out = Eigen::VectorXd::Zero(v.size());
  for (int e = 0; e < mesh_.elements(); ++e) {
    for (int a = 0; a < 27; ++a) {
      out.segment<3>(3L * mesh_.element(e)[a]) += products.col(e).segment<3>(3L * a);
    }
  }
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    Eigen::Matrix<float, 27, 1> local;
    for (int a = 0; a < 9; ++a) {
      local.segment<3>(3L * a) = v.segment<3>(3L * faces_[f][a]).cast<float>();
    }
    const Eigen::Matrix<double, 27, 1> product = (face_matrices_[f] * local).cast<double>();
    for (int a = 0; a < 9; ++a) out.segment<3>(3L * faces_[f][a]) += product.segment<3>(3L * a);
  }
  walls_.project(out);
  return out;
}

Eigen::VectorXd RicherProblem::precondition(const Eigen::VectorXd& r,
                                            const SaddleSolver& coarse) const {
  Eigen::VectorXd restricted = r.head(3L * corners_);
  for (std::size_t i = 0; i < between_.size(); ++i) {
    const Vec3 share = r.segment<3>(3L * (corners_ + long(i))) / double(between_[i].size());
    for (const int c : between_[i]) restricted.segment<3>(3L * c) += share;
  }
  Eigen::VectorXd z = raise(coarse.back_solve(restricted));
  for (std::size_t i = 0; i < between_.size(); ++i) {
    const long at = 3L * (corners_ + long(i));
    z.segment<3>(at) += blocks_[i] * r.segment<3>(at);
  }
  walls_.project(z);
  return z;
}

// Conjugate gradients until the preconditioned residual has shrunk to the accuracy wanted.
Eigen::VectorXd solve(const RicherProblem& problem, const SaddleSolver& coarse,
                      ErrorEstimate& estimate) {
  Eigen::VectorXd r = problem.right_hand_side(), x = Eigen::VectorXd::Zero(r.size());
  Eigen::VectorXd z = problem.precondition(r, coarse), d = z;
  double rz = r.dot(z);
  const double target = relative_accuracy * relative_accuracy * rz;
  while (rz > target && estimate.iterations < max_iterations) {
    const Eigen::VectorXd ad = problem.apply(d);
    const double curvature = d.dot(ad);
    if (!(curvature > 0)) return x;
    const double alpha = rz / curvature;
    x += alpha * d;
    r -= alpha * ad;
    z = problem.precondition(r, coarse);
    const double next = r.dot(z);
    d = z + (next / rz) * d;
    rz = next;
    ++estimate.iterations;
  }
  estimate.usable = rz <= target && x.allFinite();
  return x;
}

}  // namespace

ErrorEstimate estimate_error(const Scene& scene, const Eigen::VectorXd& reference,
                             const SaddleState& state, const Vec3& gravity, SaddleMatrix& matrix,
                             SaddleSolver& solver, const std::vector<TouchingNode>& touching) {
  ErrorEstimate estimate;
  AssemblyRequest request;
  request.matrix = &matrix;
  request.augmentation = soft_augmentation;
  if (!scene.assembly().evaluate(reference, state, request).valid) return estimate;
  Constraints held = scene.walls();
  hold(touching, held);
  if (!solver.factorise(matrix, held, false).ok) return estimate;
  const RicherProblem problem(scene, reference, state, gravity, touching);
  if (!problem.valid()) return estimate;
  const Eigen::VectorXd correction = solve(problem, solver, estimate);
  const std::vector<Vec3> nodal = unflatten(correction);
  for (const Landmark& landmark : problem.mesh().landmarks) {
    const Vec3 error = landmark_position(problem.mesh(), nodal, landmark);
    estimate.landmarks[landmark.name] = error;
    estimate.worst_mm = std::max(estimate.worst_mm, error.norm());
  }
  return estimate;
}

}  // namespace breast
