// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/solvers/make_solver.hpp"

#include <set>

#include "contact/penetration.hpp"
#include "contact/solvers/active_set.hpp"
#include "contact/solvers/augmented_lagrangian.hpp"

namespace breast {

namespace {

/// The penalty of the augmented Lagrangian in units of shear modulus times element size.
constexpr double penalty_factor = 10;

/// Skin nodes that are unconstrained and not on the chest wall.
std::vector<int> candidates(const Scene& scene) {
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

ChosenContact make_contact_solver(ContactMethod method, double friction, const Scene& scene,
                                  const Problem& body, SaddleSolver& saddle) {
  const Friction of_plates{friction};
  ChosenContact chosen;
  if (method == ContactMethod::surface) {
    SurfaceContactOptions options;
    options.friction = of_plates;
    auto faces = std::make_unique<SurfaceContact>(scene.mesh(), touchable_faces(scene.mesh()), body,
                                                  saddle, options);
    chosen.surface = faces.get();
    chosen.solver = std::move(faces);
  } else if (method == ContactMethod::active_set) {
    ActiveSetOptions options;
    options.friction = of_plates;
    if (of_plates.present()) options.max_iterations *= 2;  // the bounds converge only linearly
    auto nodes = std::make_unique<ActiveSet>(body, saddle, candidates(scene), options);
    chosen.friction = nodes->friction();
    chosen.solver = std::move(nodes);
  } else {
    AugmentedLagrangianOptions options;
    options.penalty = penalty_factor * scene.stiffest() * scene.element_size();
    chosen.solver = std::make_unique<AugmentedLagrangian>(body, saddle, candidates(scene), options);
  }
  return chosen;
}

}  // namespace breast
