// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mechanics/terms/membrane.hpp"
#include "mesh/nodal.hpp"
#include "surface/thorax.hpp"

namespace breast {

namespace {

// Area-weighted normals of the cut faces at their nodes, on the imaged shape.
std::vector<std::pair<int, Vec3>> cut_normals(const HexMesh& mesh) {
  std::vector<Vec3> sum(mesh.imaged.size(), Vec3::Zero());
  for (const Face& face : mesh.cut_faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    const Vec3 normal = (mesh.imaged[nodes[2]] - mesh.imaged[nodes[0]])
                            .cross(mesh.imaged[nodes[3]] - mesh.imaged[nodes[1]]);
    for (const int node : nodes) sum[node] += normal;
  }
  std::vector<std::pair<int, Vec3>> normals;
  for (const int node : nodes_of(mesh, mesh.cut_faces)) {
    normals.emplace_back(node, sum[node].normalized());
  }
  return normals;
}

// Null if neither gives one.
std::shared_ptr<const LevelSurface> wall_surface(const HexMesh& mesh, const WallOption& wall) {
  if (wall.surface) return wall.surface;
  if (!mesh.geometry || !mesh.geometry->thorax) return nullptr;
  return std::make_shared<ThoraxSurface>(*mesh.geometry->thorax);
}

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

Constraints wall_constraints(const HexMesh& mesh, const MechanicsOptions& options) {
  Constraints walls(mesh.nodes());
  if (options.cut.kind == Cut::fixed) {
    for (const int node : nodes_of(mesh, mesh.cut_faces)) walls.hold(node);
  } else if (options.cut.kind == Cut::roller) {
    for (const auto& [node, normal] : cut_normals(mesh)) walls.hold_normal(node, normal);
  }
  if (options.wall.kind != WallKind::held) return walls;
  for (const int node : nodes_of(mesh, mesh.pectoral_faces)) walls.hold(node);
  return walls;
}

void LoadedProblem::set_load(const Eigen::VectorXd& force) {
  load->set(force);
  Eigen::VectorXd free = force;
  problem.constraints().project(free);
  const double norm = free.norm();
  problem.set_load_norm(norm > 0 ? norm : stiffness_force);
}

Scene::Scene(const HexMesh& mesh, const MechanicsOptions& options, TangentStorage storage)
    : mesh_(mesh), options_(options), walls_(wall_constraints(mesh, options)) {
  check(mesh);
  solid_ = make_solid(mesh, options, storage);
  if (mesh.skin_model == SkinModel::membrane && !mesh.skin_faces.empty()) {
    membrane_ = make_membrane(mesh, options, *solid_->space());
  }
  add_wall();
}

// On a surface with an exact constraint, springs need no direction: the surface carries their
// normal part.
void Scene::add_wall() {
  const auto springs = [&](const std::vector<Face>& faces, const SupportStiffness& stiffness,
                           std::shared_ptr<const LevelSurface> surface = nullptr) {
    return faces.empty() ? nullptr
                         : std::make_shared<ElasticSupport>(mesh_, faces, stiffness,
                                                            std::move(surface));
  };
  const WallOption& wall = options_.wall;
  const std::shared_ptr<const LevelSurface> surface = wall_surface(mesh_, wall);
  if (wall.kind == WallKind::spring) {
    wall_springs_ = springs(mesh_.pectoral_faces, wall.stiffness, surface);
  }
  if (wall.kind == WallKind::slide) {
    if (!surface) {
      throw input_error(
          "--wall slide: the mesh has no chest-wall surface to slide on; run fit-hermite and "
          "hexmesh again, or use --wall held");
    }
    sliding_ = std::make_shared<SlidingNodes>(surface, nodes_of(mesh_, mesh_.pectoral_faces),
                                              flatten(mesh_.imaged));
    const double along = wall.stiffness.tangential;
    if (along > 0) wall_springs_ = springs(mesh_.pectoral_faces, {along, along});
  }
  cut_springs_ = springs_at_cut(mesh_, options_.cut);
  beyond_ = tissue_at_cut(mesh_, surface.get(), options_);
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
  return sum;
}

double Scene::element_size() const {
  return std::cbrt(volume() / mesh_.elements());
}

double Scene::stiffest() const {
  double most = 0;
  for (const Tissue tissue : mesh_.tissue) {
    most = std::max(most, options_.materials.law(tissue).shear_modulus());
  }
  return most;
}

double Scene::stiffness_force() const {
  const double size = std::cbrt(volume());
  return 1e-2 * stiffest() * size * size;
}

LoadedProblem Scene::problem(const Eigen::VectorXd& force) const {
  LoadedProblem loaded{Problem(solid_->space(), walls_), std::make_shared<DeadLoad>(force),
                       stiffness_force()};
  loaded.problem.add(solid_);
  if (membrane_) loaded.problem.add(membrane_);
  if (wall_springs_) loaded.problem.add(wall_springs_);
  for (const auto& springs : {cut_springs_.around, cut_springs_.sternal}) {
    if (springs) loaded.problem.add(springs);
  }
  loaded.problem.set_sliding(sliding_);
  loaded.problem.add(loaded.load);
  loaded.set_load(force);
  return loaded;
}

Vec3 Scene::force_of_springs(const State& state) const {
  Vec3 sum = Vec3::Zero();
  for (const auto& springs : {wall_springs_, cut_springs_.around, cut_springs_.sternal}) {
    if (springs) sum += springs->force_on_body(state);
  }
  return sum;
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
  if (beyond_) beyond_->add(gravity, force);
  return force;
}

}  // namespace breast
