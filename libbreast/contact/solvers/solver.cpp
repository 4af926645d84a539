// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/solvers/solver.hpp"

#include <set>

#include "contact/faces.hpp"
#include "contact/solvers/active_set.hpp"
#include "contact/solvers/augmented_lagrangian.hpp"
#include "contact/solvers/surface_contact.hpp"

namespace breast {

namespace {

/// The penalty of the augmented Lagrangian in units of shear modulus times element size.
constexpr double penalty_factor = 10;

/// Skin nodes that are unconstrained and not on the chest wall.
std::vector<int> free_skin_nodes(const Scene& scene) {
  const HexMesh& mesh = scene.mesh();
  const std::vector<int> wall = nodes_of(mesh, mesh.pectoral_faces);
  const std::set<int> on_wall(wall.begin(), wall.end());
  std::vector<int> list;
  for (const int node : nodes_of(mesh, mesh.skin_faces)) {
    if (scene.walls().at(node) == nullptr && !on_wall.contains(node)) list.push_back(node);
  }
  return list;
}

}  // namespace

std::vector<Face> ContactSolver::contact_faces(const HexTopology& mesh) const {
  return mesh.skin_faces;
}

std::optional<ContactEstimate> ContactSolver::for_estimate(const HexMesh& /*mesh*/,
                                                           const PlatePair& plates,
                                                           const State& solution) const {
  ContactEstimate estimate;
  for (std::size_t c = 0; c < candidates().size(); ++c) {
    const int node = candidates()[c], plate = touching()[c];
    if (plate < 0) continue;
    const Gap gap = plates.plate(plate).gap(solution.x.segment<3>(3L * node));
    estimate.touching.push_back({node, plate, gap.gradient});
  }
  return estimate;
}

std::vector<PressedPoint> ContactSolver::pressed_nodes(
    const PlatePair& plates, const State& solution,
    const std::vector<NodalContact>& contacts) const {
  std::vector<PressedPoint> points;
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    const NodalContact& contact = contacts[c];
    if (contact.plate < 0 || !(contact.normal > 0)) continue;
    const Vec3 at = solution.x.segment<3>(3L * candidates()[c]);
    const Vec3 normal = plates.plate(contact.plate).gap(at).gradient;
    points.push_back({contact.plate, at, contact.normal * normal + contact.tangential});
  }
  return points;
}

std::unique_ptr<ContactSolver> make_contact_solver(ContactMethod method, double friction,
                                                   const Scene& scene, const Problem& body,
                                                   SaddleSolver& saddle) {
  const Friction of_plates{friction};
  switch (method) {
    case ContactMethod::surface: {
      SurfaceContactOptions options;
      options.friction = of_plates;
      return std::make_unique<SurfaceContact>(scene.mesh(), touchable_faces(scene.mesh()), body,
                                              saddle, options);
    }
    case ContactMethod::active_set: {
      ActiveSetOptions options;
      options.friction = of_plates;
      if (of_plates.present()) options.max_iterations *= 2;  // the bounds converge only linearly
      return std::make_unique<ActiveSet>(body, saddle, free_skin_nodes(scene), options);
    }
    case ContactMethod::augmented_lagrangian: {
      AugmentedLagrangianOptions options;
      options.penalty = penalty_factor * scene.stiffest() * scene.element_size();
      return std::make_unique<AugmentedLagrangian>(body, saddle, free_skin_nodes(scene), options);
    }
  }
  return nullptr;
}

}  // namespace breast
