// SPDX-License-Identifier: GPL-3.0-or-later
// A mechanical model (scene) in the form that other finite-element programs need: the same
// reference shape, elements, laws, supports and nodal gravity forces as `forward`, restricted to
// what an input file can express.
#pragma once

#include <vector>

#include "mechanics/mechanics.hpp"

namespace breast {

struct DeckMaterial {
  Tissue tissue = Tissue::fat;
  Law law;                  ///< of the isochoric invariants
  double density = 0;       ///< g/mm³
  double bulk_modulus = 0;  ///< Pa
};

/// A node that slides in the plane of a unit normal.
struct DeckRoller {
  int node = 0;
  Vec3 normal{0, 0, 1};
};

/// Nodes and elements are counted from 0; a deck counts from 1.
struct DeckScene {
  std::vector<Vec3> nodes;    ///< stress-free positions, mm
  int nodes_per_element = 8;  ///< 8, or 20 for a mesh of 27-node elements
  std::vector<int> connectivity;
  std::vector<Tissue> tissue;           ///< per element
  std::vector<DeckMaterial> materials;  ///< of the tissues present, by tissue code
  std::vector<int> held;                ///< nodes held in all components
  std::vector<DeckRoller> rolling;
  std::vector<Vec3> load;  ///< per node, µN: nodal gravity forces of the imaged shape
  Vec3 gravity{0, 0, 0};   ///< mm/s²
  int elements() const { return int(tissue.size()); }
};

/// Makes the scene. `options.bulk_ratio` must be given, since these programs cannot solve exactly
/// incompressible problems. They have no membrane skin either: it is omitted if `without_skin` is
/// set, and otherwise refused (as are plain invariants). Throws Error (input).
DeckScene deck_scene(const HexMesh& mesh, const MechanicsOptions& options, const Vec3& gravity,
                     bool without_skin);

/// The loads without those on held nodes, which do no work (programs differ in whether they include
/// them in the total support force).
std::vector<Vec3> free_load(const DeckScene& scene);

/// The nodes of the mesh that are exported: all nodes of an 8-node mesh, and the corners and
/// mid-edges of a 27-node mesh, in the order of their numbers.
std::vector<int> deck_nodes(const HexMesh& mesh);

}  // namespace breast
