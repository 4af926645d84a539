// SPDX-License-Identifier: GPL-3.0-or-later
#include "distributed/mesh_part.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "distributed/bytes.hpp"
#include "mechanics/scene.hpp"

namespace breast {

namespace {

// The root's data about the whole mesh before it is divided.
struct Whole {
  const HexMesh& mesh;
  const MechanicsOptions& options;
  std::vector<int> part;                // of every element
  std::vector<std::vector<int>> ranks;  // of every node, ascending
  Constraints held;
  std::vector<char> slides;  // per node
  std::shared_ptr<ThoraxSurface> wall;
};

Whole look_at(const HexMesh& mesh, const MechanicsOptions& options, int parts) {
  if (mesh.elements() < parts) {
    throw input_error("mesh: ", mesh.elements(), " elements for ", parts,
                      " ranks; start fewer ranks with mpirun -n");
  }
  Whole whole{mesh, options, partition(mesh, parts), {}, wall_constraints(mesh, options), {}, {}};
  whole.ranks.resize(std::size_t(mesh.nodes()));
  for (int e = 0; e < mesh.elements(); ++e) {
    for (int a = 0; a < mesh.nodes_per_element(); ++a) {
      std::vector<int>& of = whole.ranks[mesh.element(e)[a]];
      const auto place = std::lower_bound(of.begin(), of.end(), whole.part[e]);
      if (place == of.end() || *place != whole.part[e]) of.insert(place, whole.part[e]);
    }
  }
  if (mesh.geometry && mesh.geometry->thorax) {
    whole.wall = std::make_shared<ThoraxSurface>(*mesh.geometry->thorax);
  }
  whole.slides.assign(std::size_t(mesh.nodes()), 0);
  if (options.wall->slides()) {
    for (const int node : nodes_of(mesh, mesh.pectoral_faces)) whole.slides[node] = 1;
  }
  return whole;
}

// Springs are attached to nodes, with the area and the normal of all faces there. Every part adds
// its share of the areas, but normals cannot be added in this way.
void check(const HexMesh& mesh, const MechanicsOptions& options) {
  const bool surface = mesh.geometry && mesh.geometry->thorax;
  if (options.wall->follows_surface() && !surface) {
    throw input_error("--wall ", options.wall->text(),
                      ": the mesh holds no wall surface, which several processes need for it; make "
                      "geometry and mesh again with fit-hermite and hexmesh, or use --wall held");
  }
  if (mesh.pectoral_faces.empty()) {
    throw input_error("mesh: no pectoral faces, so nothing holds the breast; remesh with hexmesh");
  }
  if (std::count(mesh.tissue.begin(), mesh.tissue.end(), Tissue::air) > 0) {
    throw input_error("mesh: an element is labelled air; remesh with hexmesh");
  }
}

// The nodes of a rank: its own first, then those that lower ranks own, each ascending.
void number_nodes(const Whole& whole, int rank, MeshPart& part) {
  std::vector<int> others;
  for (int node = 0; node < whole.mesh.nodes(); ++node) {
    const std::vector<int>& of = whole.ranks[node];
    if (!std::binary_search(of.begin(), of.end(), rank)) continue;
    (of.front() == rank ? part.nodes : others).push_back(node);
  }
  part.owned = int(part.nodes.size());
  part.nodes.insert(part.nodes.end(), others.begin(), others.end());
}

// Both ranks list shared nodes in the order of the whole mesh.
void note_shared(const Whole& whole, int rank, const std::vector<int>& local, MeshPart& part) {
  std::vector<int> ascending = part.nodes;
  std::sort(ascending.begin(), ascending.end());
  std::vector<SharedNodes> with;
  for (const int node : ascending) {
    for (const int other : whole.ranks[node]) {
      if (other == rank) continue;
      auto place = std::find_if(with.begin(), with.end(),
                                [&](const SharedNodes& s) { return s.rank == other; });
      if (place == with.end()) place = with.insert(with.end(), SharedNodes{other, {}});
      place->nodes.push_back(local[node]);
    }
  }
  std::sort(with.begin(), with.end(),
            [](const SharedNodes& a, const SharedNodes& b) { return a.rank < b.rank; });
  part.shared = std::move(with);
}

MeshPart cut_out(const Whole& whole, int rank) {
  MeshPart part;
  for (int e = 0; e < whole.mesh.elements(); ++e)
    if (whole.part[e] == rank) part.elements.push_back(e);
  number_nodes(whole, rank, part);
  std::vector<int> local(std::size_t(whole.mesh.nodes()), -1);
  for (std::size_t i = 0; i < part.nodes.size(); ++i) local[part.nodes[i]] = int(i);
  HexTopology& topology = part.mesh;
  MeshShape& shape = part.mesh;
  topology = part.restricted(HexTopology(whole.mesh));
  shape = part.restricted(MeshShape(whole.mesh));
  note_shared(whole, rank, local, part);
  part.wall = whole.wall;
  part.held = Constraints(int(part.nodes.size()));
  for (std::size_t i = 0; i < part.nodes.size(); ++i) {
    const NodeConstraint* held = whole.held.at(part.nodes[i]);
    if (held != nullptr) part.held.set(int(i), *held);
    if (whole.slides[part.nodes[i]] != 0) part.sliding.push_back(int(i));
  }
  return part;
}

template <class Bytes>
void pass(Bytes& bytes, NodeConstraint& held) {
  bytes(held.axes);
  bytes(held.held);
  bytes(held.increment);
}

template <class Bytes>
void pass(Bytes& bytes, Constraints& held, int nodes) {
  if (Bytes::reads) held = Constraints(nodes);
  for (int node = 0; node < nodes; ++node) {
    const NodeConstraint* at = held.at(node);
    bool is_held = at != nullptr;
    bytes(is_held);
    if (!is_held) continue;
    NodeConstraint constraint = at != nullptr ? *at : NodeConstraint{};
    pass(bytes, constraint);
    if (Bytes::reads) held.set(node, constraint);
  }
}

template <class Bytes>
void pass(Bytes& bytes, std::shared_ptr<ThoraxSurface>& wall) {
  bool has = wall != nullptr;
  bytes(has);
  if (!has) return;
  if (Bytes::reads) wall = std::make_shared<ThoraxSurface>();
  ThoraxSurface& t = *wall;
  bytes(t.origin);
  for (double* v : {&t.slope, &t.angle_low, &t.angle_high, &t.height_low, &t.height_high}) {
    bytes(*v);
  }
  bytes(t.angles);
  bytes(t.heights);
  bytes(t.coefficients);
}

template <class Bytes>
void pass(Bytes& bytes, MeshPart& part) {
  HexMesh& own = part.mesh;
  bytes(own.order);
  bytes(own.skin_model);
  bytes(own.side);
  bytes(own.imaged);
  bytes(own.reference);
  bytes(own.tissue);
  bytes(own.connectivity);
  bytes(own.skin_faces);
  bytes(own.skin_thickness);
  bytes(own.pectoral_faces);
  bytes(own.cut_faces);
  bytes(part.owned);
  bytes(part.nodes);
  bytes(part.elements);
  std::size_t others = part.shared.size();
  bytes(others);
  part.shared.resize(others);
  for (SharedNodes& shared : part.shared) {
    bytes(shared.rank);
    bytes(shared.nodes);
  }
  pass(bytes, part.held, int(part.nodes.size()));
  bytes(part.sliding);
  pass(bytes, part.wall);
}

std::vector<char> packed(MeshPart part) {
  ByteWriter out;
  pass(out, part);
  return out.take();
}

MeshPart unpacked(const std::vector<char>& bytes) {
  ByteReader in(bytes);
  MeshPart part;
  pass(in, part);
  part.mesh.points = part.mesh.imaged;
  return part;
}

}  // namespace

MeshPart share_mesh(const Ranks& ranks, const HexMesh& mesh, const MechanicsOptions& options) {
  std::vector<char> own;
  std::vector<std::vector<char>> others;
  ranks.together([&] {
    if (!ranks.root()) return;
    check(mesh, options);
    const Whole whole = look_at(mesh, options, ranks.size());
    own = packed(cut_out(whole, 0));
    for (int rank = 1; rank < ranks.size(); ++rank) {
      others.push_back(packed(cut_out(whole, rank)));
    }
  });
  if (!ranks.root()) return unpacked(ranks.receive(0));
  for (int rank = 1; rank < ranks.size(); ++rank) ranks.send(others[std::size_t(rank) - 1], rank);
  return unpacked(own);
}

}  // namespace breast
