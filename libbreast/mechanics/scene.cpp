#include "mechanics/scene.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "core/error.hpp"

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

void check(const HexMesh& mesh, const MechanicsOptions& options) {
  if (mesh.elements() == 0) throw input_error("mesh: no elements");
  if (mesh.pectoral_faces.empty()) {
    throw input_error("mesh: no pectoral faces, so nothing holds the breast; remesh with hexmesh");
  }
  if (options.solver != "auto" && options.solver != "direct" && options.solver != "multigrid") {
    throw input_error("--solver '", options.solver, "' is unknown: use auto, direct or multigrid");
  }
  for (const Tissue tissue : mesh.tissue) {
    if (tissue == Tissue::air)
      throw input_error("mesh: an element is labelled air; remesh with hexmesh");
  }
}

}  // namespace

Constraints wall_constraints(const HexMesh& mesh, Cut cut) {
  Constraints walls(mesh.nodes());
  if (cut == Cut::fixed) {
    for (const int node : nodes_of(mesh, mesh.cut_faces)) walls.hold(node);
  } else if (cut == Cut::roller) {
    for (const auto& [node, normal] : cut_normals(mesh)) walls.hold_normal(node, normal);
  }
  for (const int node : nodes_of(mesh, mesh.pectoral_faces)) walls.hold(node);
  return walls;
}

Scene::Scene(const HexMesh& mesh, const MechanicsOptions& options)
    : mesh_(mesh), options_(options), walls_(wall_constraints(mesh, options.cut)) {
  check(mesh, options);
  assembly_ = make_assembly(mesh, options);
  double volume = 0, stiffest = 0;
  for (const double v : assembly_->imaged_volume()) volume += v;
  for (const Tissue tissue : mesh.tissue) {
    stiffest = std::max(stiffest, options.materials.law(tissue).shear_modulus());
  }
  stiffness_force_ = 1e-2 * stiffest * std::cbrt(volume) * std::cbrt(volume);
}

long Scene::unknowns() const {
  long held = 0;
  for (int node = 0; node < nodes(); ++node) {
    for (int i = 0; i < 3; ++i) held += walls_.held(node, i) ? 1 : 0;
  }
  return 3L * nodes() - held + assembly_->rest_pressure().size();
}

Eigen::VectorXd Scene::gravity_force(const Vec3& gravity) const {
  Eigen::VectorXd force(3L * nodes());
  for (int node = 0; node < nodes(); ++node) {
    force.segment<3>(3L * node) = assembly_->nodal_mass()[node] * gravity;
  }
  return force;
}

ForwardProblem::ForwardProblem(const Scene& scene, Eigen::VectorXd reference, Eigen::VectorXd load)
    : scene_(scene), reference_(std::move(reference)) {
  set_load(load);
}

void ForwardProblem::set_load(const Eigen::VectorXd& load) {
  load_ = load;
  Eigen::VectorXd free = load;
  scene_.walls().project(free);
  const double norm = free.norm();
  load_norm_ = norm > 0 ? norm : scene_.stiffness_force();
}

std::shared_ptr<const NodePattern> ForwardProblem::pattern() const {
  return scene_.assembly().pattern();
}

SaddleMatrix ForwardProblem::make_matrix() const {
  return scene_.assembly().make_matrix();
}

SaddleForces ForwardProblem::forces(const SaddleState& state, const Eigen::VectorXd* kappa) const {
  AssemblyRequest request;
  request.kappa = kappa;
  SaddleForces forces = scene_.assembly().evaluate(reference_, state, request);
  if (!forces.valid) return forces;
  forces.r -= load_;
  if (kappa != nullptr) forces.augmented -= load_;
  forces.energy -= load_.dot(state.u - reference_);
  return forces;
}

bool ForwardProblem::tangent(const SaddleState& state, SaddleForces& forces,
                             SaddleMatrix& matrix) const {
  AssemblyRequest request;
  request.matrix = &matrix;
  forces = scene_.assembly().evaluate(reference_, state, request);
  if (!forces.valid) return false;
  forces.r -= load_;
  forces.energy -= load_.dot(state.u - reference_);
  return true;
}

double ForwardProblem::volume_scale(int element) const {
  return scene_.assembly().imaged_volume()[element];
}

}  // namespace breast
