#include "mechanics/richer_problem.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "fem/hex_kernel.hpp"
#include "fem/membrane_kernel.hpp"
#include "mechanics/pressure_filter.hpp"
#include "mesh/element_order.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

using Vector81 = Eigen::Matrix<double, 81, 1>;
using Nodes27 = Eigen::Matrix<double, 3, 27>;
using Column = Eigen::Map<const Eigen::VectorXf>;
constexpr std::size_t packed = 81 * 82 / 2;

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

template <int N>
Eigen::Matrix<double, 3, N> gather(const int* nodes, const Eigen::VectorXd& nodal) {
  Eigen::Matrix<double, 3, N> out;
  for (int a = 0; a < N; ++a) out.col(a) = nodal.segment<3>(3L * nodes[a]);
  return out;
}

// y = A x, A by the columns of its lower triangle.
void multiply_packed(const float* a, const Eigen::Matrix<float, 81, 1>& x,
                     Eigen::Matrix<float, 81, 1>& y) {
  y.setZero();
  for (int j = 0; j < 81; ++j) {
    const int below = 80 - j;
    const Column column(a + 1, below);
    y[j] += a[0] * x[j] + column.dot(x.tail(below));
    y.tail(below) += x[j] * column;
    a += below + 1;
  }
}

// The oscillation of one pressure an element is no part of the richer solution: a tangent that
// contains it is wrong by the ratio of its size to the shear modulus.
Eigen::VectorXd smooth_pressure(const Scene& scene, const SaddleState& state) {
  const std::vector<double> filtered =
      filter_pressure(scene.mesh(), unflatten(state.u), {state.p.begin(), state.p.end()});
  Eigen::VectorXd p = Eigen::VectorXd::Zero(4 * Eigen::Index(filtered.size()));
  for (std::size_t e = 0; e < filtered.size(); ++e) p[4 * long(e)] = filtered[e];
  return p;
}

}  // namespace

/// What one element is asked with, and what it weighs.
struct RicherProblem::Element {
  HexInput<27, 4> in;
  Eigen::Matrix4d inverse_mass;
  Eigen::Matrix<double, 27, 1> nodal_mass;  // g
};

RicherProblem::RicherProblem(const Scene& scene, const Eigen::VectorXd& reference,
                             const SaddleState& state, const Vec3& gravity,
                             const std::vector<TouchingNode>& touching)
    : scene_(scene),
      gravity_(gravity),
      mesh_(raise_order(scene.mesh())),
      walls_(wall_constraints(mesh_, scene.options().cut)),
      corners_(scene.nodes()),
      between_(nodes_between(mesh_, corners_)),
      reference_(raise(reference)),
      deformed_(raise(state.u)),
      pressure_(smooth_pressure(scene, state)) {
  for (const TouchingNode& t : touching) {
    if (walls_.at(t.node) == nullptr) walls_.hold_normal(t.node, t.normal);
  }
  hold_between(touching);
  right_ = Eigen::VectorXd::Zero(3L * mesh_.nodes());
  add_elements();
  if (valid_ && mesh_.skin_model == SkinModel::membrane) {
    prepare_faces();
    add_faces(true);
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

double RicherProblem::kappa(int e, const HexOutput<27, 4>& out) const {
  const Law& law = scene_.options().materials.law(mesh_.tissue[e]);
  const double now = out.k.trace() / (10.0 / 3 * out.gradient_square);
  return augmentation * std::max(now, law.shear_modulus());
}

RicherProblem::Element RicherProblem::element(int e, const Eigen::VectorXd& moved) const {
  const HexRule<27>& rule = HexRule<27>::get();
  const MaterialSet& materials = scene_.options().materials;
  Element one;
  HexInput<27, 4>& in = one.in;
  in.reference = gather<27>(mesh_.element(e), reference_);
  in.deformed = gather<27>(mesh_.element(e), moved);
  in.pressure = pressure_.segment<4>(4L * e);
  in.law = &materials.law(mesh_.tissue[e]);
  in.isochoric = scene_.options().invariants == Invariants::isochoric;
  Nodes27 imaged;
  for (int a = 0; a < 27; ++a) imaged.col(a) = mesh_.imaged[mesh_.element(e)[a]];
  const Vec3 centre = imaged.rowwise().mean();
  const double size = std::cbrt(scene_.assembly().imaged_volume()[e]);
  Eigen::Matrix4d mass = Eigen::Matrix4d::Zero();
  one.nodal_mass.setZero();
  for (int q = 0; q < HexRule<27>::points; ++q) {
    in.basis.col(q) << 1, (imaged * rule.values[q] - centre) / size;
    const Mat3 jacobian = imaged * rule.gradients[q].transpose();
    const double volume = rule.weight[q] * jacobian.determinant();
    mass += volume * in.basis.col(q) * in.basis.col(q).transpose();
    one.nodal_mass += materials.density[std::size_t(mesh_.tissue[e])] * volume * rule.values[q];
  }
  one.inverse_mass = mass.inverse();
  return one;
}

void RicherProblem::add_elements() {
  matrices_.resize(packed * std::size_t(mesh_.elements()));
  kappa_.resize(mesh_.elements());
  Eigen::MatrixXd rights(81, mesh_.elements());
  bool all_valid = true;
#pragma omp parallel num_threads(threads()) reduction(&& : all_valid)
  {
    const auto out = std::make_unique<HexOutput<27, 4>>();
#pragma omp for schedule(dynamic, 16)
    for (int e = 0; e < mesh_.elements(); ++e) {
      const Element one = element(e, deformed_);
      hex_kernel<27, 4>(one.in, {true, false}, *out);
      all_valid = all_valid && out->valid;
      if (!out->valid) continue;
      kappa_[e] = kappa(e, *out);
      const Eigen::Matrix<double, 4, 81> weighted = kappa_[e] * (one.inverse_mass * out->b);
      out->k.noalias() += out->b.transpose() * weighted;
      float* to = matrices_.data() + packed * std::size_t(e);
      for (int j = 0; j < 81; ++j) {
        for (int i = j; i < 81; ++i) *to++ = float(out->k(i, j));
      }
      const Nodes27 residual = out->residual - gravity_ * one.nodal_mass.transpose();
      rights.col(e) =
          -Eigen::Map<const Vector81>(residual.data()) - weighted.transpose() * out->theta;
    }
  }
  valid_ = all_valid;
  if (valid_) add_rights(rights);
}

void RicherProblem::add_rights(const Eigen::MatrixXd& rights) {
  for (int e = 0; e < mesh_.elements(); ++e) {
    for (int a = 0; a < 27; ++a) {
      right_.segment<3>(3L * mesh_.element(e)[a]) += rights.col(e).segment<3>(3L * a);
    }
  }
}

void RicherProblem::prepare_faces() {
  const QuadRule<9>& rule = QuadRule<9>::get();
  for (std::size_t f = 0; f < mesh_.skin_faces.size(); ++f) {
    faces_.push_back(face_nodes(mesh_, mesh_.skin_faces[f]));
    Eigen::Matrix<double, 3, 9> imaged;
    for (int a = 0; a < 9; ++a) imaged.col(a) = mesh_.imaged[faces_[f][a]];
    Eigen::Matrix<double, 9, 1> volume;
    for (int q = 0; q < QuadRule<9>::points; ++q) {
      const Eigen::Matrix<double, 3, 2> t = imaged * rule.gradients[q].transpose();
      volume[q] =
          mesh_.skin_thickness[f] * rule.weight[q] * std::sqrt((t.transpose() * t).determinant());
    }
    face_volume_.push_back(volume);
  }
}

void RicherProblem::add_faces(bool matrices) {
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    MembraneOutput<9> out;
    const MembraneInput<9> in{gather<9>(faces_[f].data(), reference_),
                              gather<9>(faces_[f].data(), deformed_), face_volume_[f],
                              &scene_.options().materials.law(Tissue::skin)};
    membrane_kernel<9>(in, {matrices, false}, out);
    valid_ = valid_ && out.valid;
    if (matrices) face_matrices_.push_back(out.k.cast<float>());
    for (int a = 0; a < 9; ++a) right_.segment<3>(3L * faces_[f][a]) -= out.residual.col(a);
  }
}

bool RicherProblem::move(const Eigen::VectorXd& v) {
  deformed_ += v;
  Eigen::MatrixXd rights(81, mesh_.elements());
#pragma omp parallel num_threads(threads()) reduction(&& : valid_)
  {
    const auto out = std::make_unique<HexOutput<27, 4>>();
#pragma omp for schedule(static)
    for (int e = 0; e < mesh_.elements(); ++e) {
      const Element one = element(e, deformed_);
      hex_kernel<27, 4>(one.in, {false, false}, *out);
      valid_ = valid_ && out->valid;
      if (!out->valid) continue;
      const Eigen::Vector4d pressure = kappa_[e] * (one.inverse_mass * out->theta);
      pressure_.segment<4>(4L * e) -= pressure;
      const Nodes27 residual = out->residual - gravity_ * one.nodal_mass.transpose();
      rights.col(e) =
          -Eigen::Map<const Vector81>(residual.data()) - 2 * out->b.transpose() * pressure;
    }
  }
  right_.setZero();
  add_rights(rights);
  add_faces(false);
  walls_.project(right_);
  return valid_;
}

void RicherProblem::invert_blocks() {
  blocks_.assign(between_.size(), Mat3::Zero());
  const auto column_start = [](int j) { return j * 81 - j * (j - 1) / 2; };
  for (int e = 0; e < mesh_.elements(); ++e) {
    const float* matrix = matrices_.data() + packed * std::size_t(e);
    for (int a = 8; a < 27; ++a) {
      Mat3& block = blocks_[mesh_.element(e)[a] - corners_];
      for (int k = 0; k < 3; ++k) {
        const float* column = matrix + column_start(3 * a + k);
        block(k, k) += column[0];
        for (int i = k + 1; i < 3; ++i) {
          block(i, k) += column[i - k];
          block(k, i) += column[i - k];
        }
      }
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
  Eigen::MatrixXf products(81, mesh_.elements());
#pragma omp parallel for num_threads(threads()) schedule(static)
  for (int e = 0; e < mesh_.elements(); ++e) {
    Eigen::Matrix<float, 81, 1> local, product;
    for (int a = 0; a < 27; ++a) {
      local.segment<3>(3L * a) = v.segment<3>(3L * mesh_.element(e)[a]).cast<float>();
    }
    multiply_packed(matrices_.data() + packed * std::size_t(e), local, product);
    products.col(e) = product;
  }
  Eigen::VectorXd out = Eigen::VectorXd::Zero(v.size());
  for (int e = 0; e < mesh_.elements(); ++e) {
    for (int a = 0; a < 27; ++a) {
      out.segment<3>(3L * mesh_.element(e)[a]) += products.col(e).segment<3>(3L * a).cast<double>();
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

}  // namespace breast
