// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/scene.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mechanics/terms/corner_volume.hpp"
#include "mechanics/terms/membrane.hpp"
#include "mesh/nodal.hpp"
#include "surface/thorax.hpp"

namespace breast {

namespace {

// Null if neither gives one.
std::shared_ptr<const LevelSurface> wall_surface(const HexMesh& mesh,
                                                 const MechanicsOptions& options) {
  if (options.wall_surface) return options.wall_surface;
  if (!mesh.geometry || !mesh.geometry->thorax) return nullptr;
  return std::make_shared<ThoraxSurface>(*mesh.geometry->thorax);
}

// Of the resistance of corners, in a problem from whose solution that with all of it is found.
constexpr double soft = 0.3;

void check(const HexMesh& mesh) {
  if (mesh.elements() == 0) throw input_error("mesh: no elements");
  if (mesh.pectoral_faces.empty()) {
    throw input_error(
        "mesh: no chest-wall faces, so that nothing holds the breast; remesh with "
        "hexmesh");
  }
  for (const Tissue tissue : mesh.tissue) {
    if (tissue == Tissue::air)
      throw input_error("mesh: an element is labelled air; remesh with hexmesh");
  }
}

}  // namespace

// Where wall and cut meet, a held wall comes last.
Constraints wall_constraints(const HexMesh& mesh, const MechanicsOptions& options) {
  Constraints walls(mesh.nodes());
  for (const SupportPtr& support : {options.cut, options.wall}) support->constrain(mesh, walls);
  return walls;
}

void LoadedProblem::set_load(const Eigen::VectorXd& force) {
  load->set(force);
  Eigen::VectorXd free = force;
  problem.complete(free);
  problem.constraints().project(free);
  const double norm = problem.norm(free);
  problem.set_load_norm(norm > 0 ? norm : stiffness_force);
}

Scene::Scene(const HexMesh& mesh, const MechanicsOptions& options, TangentStorage storage)
    : mesh_(mesh), options_(options), walls_(wall_constraints(mesh, options)) {
  check(mesh);
  add_terms(storage, nodes_of(mesh, mesh.pectoral_faces));
}

Scene::Scene(const HexMesh& mesh, const MechanicsOptions& options, PartOfBody part)
    : mesh_(mesh),
      options_(options),
      walls_(std::move(part.walls)),
      sharing_(std::move(part.sharing)) {
  add_terms(TangentStorage::assembled, part.sliding);
}

void Scene::add_terms(TangentStorage storage, const std::vector<int>& sliding) {
  solid_ = make_solid(mesh_, options_, storage);
  corners_ = make_corner_volume(mesh_, options_, *solid_->space());
  if (mesh_.skin_model == SkinModel::membrane && !mesh_.skin_faces.empty()) {
    membrane_ = make_membrane(mesh_, options_, *solid_->space());
  }
  const std::shared_ptr<const LevelSurface> surface = wall_surface(mesh_, options_);
  supports_ = attach_supports(mesh_, surface, options_);
  if (options_.wall->slides() && !sliding.empty()) {
    sliding_ = std::make_shared<SlidingNodes>(surface, sliding, flatten(mesh_.imaged));
  }
}

long Scene::unknowns() const {
  long held = 0;
  for (int node = 0; node < nodes(); ++node) {
    for (int i = 0; i < 3; ++i) held += walls_.held(node, i) ? 1 : 0;
  }
  if (sliding_) held += long(sliding_->nodes().size());
  return 3L * nodes() - held + solid_->rest_pressure().size();
}

double Scene::volume() const {
  double sum = 0;
  for (int e = 0; e < mesh_.elements(); ++e) sum += solid_->space()->pressures->volume(e);
  return sharing_ ? sharing_->sum(sum) : sum;
}

double Scene::element_size() const {
  return std::cbrt(volume() / mesh_.elements());
}

double Scene::stiffest() const {
  double most = 0;
  for (const Tissue tissue : mesh_.tissue) {
    most = std::max(most, options_.materials.law(tissue).shear_modulus());
  }
  return sharing_ ? sharing_->most(most) : most;
}

double Scene::stiffness_force() const {
  const double size = std::cbrt(volume());
  return 1e-2 * stiffest() * size * size;
}

LoadedProblem Scene::problem(const Eigen::VectorXd& force) const {
  return problem_with(corners_, force);
}

LoadedProblem Scene::problem_with_soft_corners(const Eigen::VectorXd& force) const {
  return problem_with(make_corner_volume(mesh_, options_, *solid_->space(), soft), force);
}

LoadedProblem Scene::problem_with(const std::shared_ptr<const Term>& corners,
                                  const Eigen::VectorXd& force) const {
  LoadedProblem loaded{Problem(solid_->space(), walls_), std::make_shared<DeadLoad>(force),
                       stiffness_force()};
  loaded.problem.add(solid_);
  if (corners) loaded.problem.add(corners);
  if (membrane_) loaded.problem.add(membrane_);
  for (const SupportEffects::Springs& springs : supports_.springs) loaded.problem.add(springs.term);
  loaded.problem.set_sliding(sliding_);
  if (sharing_) loaded.problem.share(sharing_);
  loaded.problem.add(loaded.load);
  loaded.set_load(force);
  return loaded;
}

Vec3 Scene::weight(const Vec3& gravity) const {
  double mass = 0;
  for (const double share : solid_->nodal_mass()) mass += share;
  return mass * gravity;
}

Eigen::VectorXd Scene::gravity_force(const Vec3& gravity) const {
  Eigen::VectorXd force(3L * nodes());
  for (int node = 0; node < nodes(); ++node) {
    force.segment<3>(3L * node) = solid_->nodal_mass()[node] * gravity;
  }
  supports_.add_loads(gravity, force);
  return force;
}

}  // namespace breast
