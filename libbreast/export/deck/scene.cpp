// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/deck/scene.hpp"

#include <algorithm>
#include <set>

#include "core/error.hpp"
#include "export/deck/serendipity.hpp"
#include "mechanics/scene.hpp"

namespace breast {

namespace {

void refuse_what_no_deck_says(const HexMesh& mesh, const MechanicsOptions& options,
                              bool without_skin) {
  if (mesh.reference.size() != mesh.points.size()) {
    throw input_error("mesh: no stress-free reference shape; run backward first");
  }
  if (options.invariants == Invariants::plain) {
    throw input_error(
        "--invariants plain: FEBio and CalculiX take invariants of the isochoric "
        "part of C; use isochoric");
  }
  if (!(options.bulk_ratio > 0)) {
    throw input_error("bulk ratio ", options.bulk_ratio,
                      ": FEBio and CalculiX cannot be exactly incompressible; give --bulk-ratio, "
                      "for example 1000");
  }
  for (const SupportPtr& support : {options.wall, options.cut}) {
    if (!support->slides() && support->numbers().empty()) continue;
    throw input_error("--wall ", options.wall->text(), " --cut ", options.cut->text(),
                      ": an exported model has a fixed chest wall and no springs; give --wall held "
                      "and --cut free, fixed or roller");
  }
  if (mesh.skin_model == SkinModel::membrane && !without_skin) {
    throw input_error(
        "mesh: its skin is a membrane, which FEBio and CalculiX do not have; omit it with "
        "--without-skin, or remesh with hexmesh --skin-as layer");
  }
}

std::vector<DeckMaterial> materials_of(const HexTopology& mesh, const MechanicsOptions& options) {
  std::vector<DeckMaterial> materials;
  for (const Tissue tissue : std::set<Tissue>(mesh.tissue.begin(), mesh.tissue.end())) {
    const Law& law = options.materials.law(tissue);
    materials.push_back({tissue, law, options.materials.density[std::size_t(tissue)],
                         options.bulk_ratio * law.shear_modulus()});
  }
  return materials;
}

}  // namespace

std::vector<int> deck_nodes(const HexMesh& mesh) {
  const int per_element = mesh.nodes_per_element(), kept = mesh.order == 1 ? 8 : 20;
  std::vector<bool> used(std::size_t(mesh.nodes()), false);
  for (int e = 0; e < mesh.elements(); ++e) {
    for (int a = 0; a < std::min(kept, per_element); ++a) used[mesh.element(e)[a]] = true;
  }
  std::vector<int> nodes;
  for (int node = 0; node < mesh.nodes(); ++node) {
    if (used[node]) nodes.push_back(node);
  }
  return nodes;
}

std::vector<Vec3> free_load(const DeckScene& scene) {
  std::vector<Vec3> load = scene.load;
  for (const int node : scene.held) load[node].setZero();
  return load;
}

DeckScene deck_scene(const HexMesh& mesh, const MechanicsOptions& options, const Vec3& gravity,
                     bool without_skin) {
  refuse_what_no_deck_says(mesh, options, without_skin);
  HexMesh bare = mesh;
  if (bare.skin_model == SkinModel::membrane) {
    bare.skin_model = SkinModel::none;
    bare.skin_thickness.clear();
  }
  const Scene scene(bare, options);
  std::vector<Vec3> load = unflatten(scene.gravity_force(gravity));
  if (mesh.order == 2) gather_centres(mesh, load);

  DeckScene deck;
  deck.gravity = gravity;
  deck.tissue = mesh.tissue;
  deck.materials = materials_of(mesh, options);
  std::vector<int> number(std::size_t(mesh.nodes()), -1);
  for (const int node : deck_nodes(mesh)) {
    const int here = number[node] = int(deck.nodes.size());
    deck.nodes.push_back(mesh.reference[node]);
    deck.load.push_back(load[node]);
    const NodeConstraint* constraint = scene.walls().at(node);
    if (constraint == nullptr) continue;
    if (constraint->held[1]) {
      deck.held.push_back(here);
    } else {
      deck.rolling.push_back({here, constraint->axes.col(0)});
    }
  }
  deck.nodes_per_element = mesh.order == 1 ? 8 : 20;
  for (int e = 0; e < mesh.elements(); ++e) {
    for (int a = 0; a < deck.nodes_per_element; ++a) {
      deck.connectivity.push_back(number[mesh.element(e)[a]]);
    }
  }
  return deck;
}

}  // namespace breast
