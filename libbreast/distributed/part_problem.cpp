// SPDX-License-Identifier: GPL-3.0-or-later
#include "distributed/part_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "mechanics/terms/membrane.hpp"
#include "mesh/nodal.hpp"

namespace breast {

namespace {

double stiffest(const HexMesh& mesh, const MechanicsOptions& options) {
  double most = 0;
  for (const Tissue tissue : mesh.tissue) {
    most = std::max(most, options.materials.law(tissue).shear_modulus());
  }
  return most;
}

}  // namespace

PartProblem::PartProblem(const Ranks& ranks, const MeshPart& part, const MechanicsOptions& options)
    : ranks_(ranks), part_(part), exchange_(ranks, part) {
  double volume = 0;
  ranks.together([&] {
    solid_ = make_solid(part.mesh, options);
    Constraints held(part.mesh.nodes());
    for (const HeldNode& node : part.held) held.set(node.node, node.constraint);
    problem_ = std::make_unique<Problem>(solid_->space(), std::move(held));
    problem_->add(solid_);
    if (part.mesh.skin_model == SkinModel::membrane && !part.mesh.skin_faces.empty()) {
      problem_->add(make_membrane(part.mesh, options, *solid_->space()));
    }
    supports_ = attach_supports(part.mesh, part.wall, options);
    for (const SupportEffects::Springs& springs : supports_.springs) problem_->add(springs.term);
    if (!part.sliding.empty()) {
      problem_->set_sliding(
          std::make_shared<SlidingNodes>(part.wall, part.sliding, flatten(part.mesh.imaged)));
    }
    for (int e = 0; e < part.mesh.elements(); ++e) volume += pressures().volume(e);
  });
  gravity_ = Eigen::VectorXd::Zero(3L * part.mesh.nodes());
  load_ = std::make_shared<DeadLoad>(gravity_);
  problem_->add(load_);
  const double size = std::cbrt(ranks.sum(volume));
  stiffness_force_ = 1e-2 * ranks.most(stiffest(part.mesh, options)) * size * size;
  load_norm_ = stiffness_force_;
}

void PartProblem::set_gravity(const Vec3& gravity) {
  for (int node = 0; node < part_.mesh.nodes(); ++node) {
    gravity_.segment<3>(3L * node) = solid_->nodal_mass()[node] * gravity;
  }
  supports_.add_loads(gravity, gravity_);
  set_load(1);
}

void PartProblem::set_load(double part) {
  load_->set(part * gravity_);
  Eigen::VectorXd whole = part * gravity_;
  exchange_.sum(whole);
  problem_->constraints().project(whole);
  const double norm = std::sqrt(dot(whole, whole));
  load_norm_ = norm > 0 ? norm : stiffness_force_;
}

Forces PartProblem::evaluate(const State& state, const Request& request) const {
  Forces forces = problem_->evaluate(state, request);
  if (!ranks_.all(forces.valid)) {
    const bool known = !forces.valid && forces.bad_element >= 0;
    forces.valid = false;
    forces.bad_element = whole_element(known, forces.bad_element);
    return forces;
  }
  exchange_.sum(forces.r);
  if (request.kappa != nullptr) exchange_.sum(forces.augmented);
  if (request.matrix != nullptr) exchange_.sum(request.matrix->diagonal);
  forces.energy = ranks_.sum(forces.energy);
  forces.min_det_F = ranks_.least(forces.min_det_F);
  forces.max_det_F = ranks_.most(forces.max_det_F);
  forces.max_volume_error = ranks_.most(forces.max_volume_error);
  return forces;
}

Forces PartProblem::forces(const State& state, const Eigen::VectorXd* kappa) const {
  Request request;
  request.kappa = kappa;
  return evaluate(state, request);
}

bool PartProblem::restore(Eigen::VectorXd& x) const {
  return ranks_.all(problem_->restore(x) < 0);
}

double PartProblem::dot(const Eigen::VectorXd& a, const Eigen::VectorXd& b) const {
  const long own = 3L * part_.owned;
  return ranks_.sum(a.head(own).dot(b.head(own)));
}

double PartProblem::free_norm(const Constraints& held, const Forces& forces) const {
  Eigen::VectorXd free = forces.r;
  held.project(free);
  return std::sqrt(dot(free, free));
}

double PartProblem::volume_residual(const Forces& forces) const {
  return ranks_.most(problem_->volume_residual(forces));
}

int PartProblem::whole_element(bool known, int own) const {
  const long none = std::numeric_limits<int>::max();
  const long least = ranks_.least(known ? long(part_.elements[std::size_t(own)]) : none);
  return least == none ? -1 : int(least);
}

int PartProblem::folded_element(const State& state) const {
  const int own = problem_->folded_element(state);
  return whole_element(own >= 0, own);
}

double PartProblem::rounding(const SaddleMatrix& matrix, const Eigen::VectorXd& x) const {
  const Eigen::VectorXd product = matrix.diagonal.cwiseProduct(x);
  return 8 * std::numeric_limits<double>::epsilon() * std::sqrt(dot(product, product)) / load_norm_;
}

}  // namespace breast
