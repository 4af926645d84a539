// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/estimate/richer_problem.hpp"

#include <Eigen/LU>

#include "mechanics/pressure_filter.hpp"
#include "mesh/element_order.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

// The corners between which each new node lies.
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

// The pressure oscillation of elements with one pressure is not part of the richer solution: a
// tangent that contains it is wrong by the ratio of the oscillation to the shear modulus.
Eigen::VectorXd smooth_pressure(const Scene& scene, const State& state) {
  const std::vector<double> filtered =
      filter_pressure(scene.mesh(), unflatten(state.x), {state.p.begin(), state.p.end()});
  Eigen::VectorXd p = Eigen::VectorXd::Zero(4 * Eigen::Index(filtered.size()));
  for (std::size_t e = 0; e < filtered.size(); ++e) p[4 * long(e)] = filtered[e];
  return p;
}

MechanicsOptions richer_options(MechanicsOptions options) {
  options.element = Element::q2p1;
  return options;
}

}  // namespace

RicherProblem::RicherProblem(const Scene& coarse, const State& state, const Vec3& gravity,
                             const ContactEstimate& contact)
    : corners_(coarse.nodes()),
      mesh_(raise_order(coarse.mesh())),
      between_(nodes_between(mesh_, corners_)),
      scene_(mesh_, richer_options(coarse.options()), TangentStorage::packed),
      problem_(scene_.problem(scene_.gravity_force(gravity)).problem),
      state_{raise(state.reference), raise(state.x), smooth_pressure(coarse, state)},
      held_(mesh_.nodes()) {
  if (contact.raise_plates) {
    problem_.add(contact.raise_plates({mesh_, corners_, between_}));
  }
  start_ = state_.x;
  valid_ = problem_.restore(state_.reference) < 0 && problem_.restore(state_.x) < 0;
  if (!valid_) return;
  hold_touching(contact.touching);
  linearise();
}

// A new node rests on a plate if all corners between which it lies do.
void RicherProblem::hold_touching(const std::vector<TouchingNode>& touching) {
  Constraints held = scene_.walls();
  std::vector<const TouchingNode*> at(static_cast<std::size_t>(corners_), nullptr);
  for (const TouchingNode& t : touching) {
    at[t.node] = &t;
    if (held.at(t.node) == nullptr) held.hold_normal(t.node, t.normal);
  }
  for (std::size_t i = 0; i < between_.size(); ++i) {
    const TouchingNode* first = at[between_[i].front()];
    Vec3 normal = Vec3::Zero();
    bool all = first != nullptr;
    for (const int corner : between_[i]) {
      all = all && at[corner] != nullptr && at[corner]->plate == first->plate;
      if (all) normal += at[corner]->normal;
    }
    const int node = corners_ + int(i);
    if (all && held.at(node) == nullptr) held.hold_normal(node, normal.normalized());
  }
  problem_.set_constraints(std::move(held));
  held_ = problem_.constraints_at(state_.x);
}

Eigen::VectorXd RicherMesh::raise(const Eigen::VectorXd& of_corners) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(3L * mesh.nodes());
  out.head(of_corners.size()) = of_corners;
  for (std::size_t i = 0; i < between.size(); ++i) {
    auto node = out.segment<3>(3L * (corners + long(i)));
    for (const int c : between[i])
      node += of_corners.segment<3>(3L * c) / double(between[i].size());
  }
  return out;
}

Eigen::VectorXd RicherProblem::raise(const Eigen::VectorXd& corners) const {
  return RicherMesh{mesh_, corners_, between_}.raise(corners);
}

void RicherProblem::linearise() {
  Request request;
  request.packed = &tangent_;
  request.augmentation = augmentation;
  valid_ = problem_.evaluate(state_, request).valid;
  if (!valid_) return;
  right_ = -problem_.forces(state_, &tangent_.kappa).augmented;
  held_.project(right_);
  blocks_ = tangent_.diagonal_blocks(corners_, mesh_.nodes());
  for (Mat3& block : blocks_) block = block.inverse().eval();
}

// With p ← p − κM⁻¹θ, r changes by −Bᵀ times this change, and θ becomes its fraction 1 − κc. κc is
// the same in every element.
bool RicherProblem::move(const Eigen::VectorXd& v) {
  const PressureSpace& pressures = *problem_.space().pressures;
  state_.x += v;
  valid_ = problem_.restore(state_.x) < 0;
  if (!valid_) return false;
  const Forces forces = problem_.forces(state_, &tangent_.kappa);
  valid_ = forces.valid;
  if (!valid_) return false;
  const double left_over = 1 - tangent_.kappa[0] * pressures.compliance[0];
  state_.p -= pressures.divide(forces.theta, tangent_.kappa);
  right_ = -(forces.augmented + left_over * (forces.augmented - forces.r));
  held_.project(right_);
  return true;
}

Eigen::VectorXd RicherProblem::apply(const Eigen::VectorXd& v) const {
  Eigen::VectorXd out = tangent_.apply(v);
  held_.project(out);
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
  held_.project(z);
  return z;
}

}  // namespace breast
