// SPDX-License-Identifier: GPL-3.0-or-later
#include "distributed/mesh_part.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "distributed/bytes.hpp"
#include "mechanics/scene.hpp"
#include "surface/thorax.hpp"

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
};

Whole look_at(const HexMesh& mesh, const MechanicsOptions& options, int parts) {
  if (mesh.elements() < parts) {
    throw input_error("mesh: ", mesh.elements(), " elements for ", parts,
                      " ranks; start fewer ranks with mpirun -n");
  }
  Whole whole{mesh, options, partition(mesh, parts), {}, wall_constraints(mesh, options), {}};
  whole.ranks.resize(std::size_t(mesh.nodes()));
  for (int e = 0; e < mesh.elements(); ++e) {
    for (int a = 0; a < mesh.nodes_per_element(); ++a) {
      std::vector<int>& of = whole.ranks[mesh.element(e)[a]];
      const auto place = std::lower_bound(of.begin(), of.end(), whole.part[e]);
      if (place == of.end() || *place != whole.part[e]) of.insert(place, whole.part[e]);
    }
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

void cut_faces(const std::vector<Face>& from, const std::vector<int>& local, std::vector<Face>& to,
               const std::vector<double>* values, std::vector<double>* kept) {
  for (std::size_t i = 0; i < from.size(); ++i) {
    const int element = local[from[i].element];
    if (element < 0) continue;
    to.push_back({element, from[i].local});
    if (values != nullptr && !values->empty()) kept->push_back((*values)[i]);
  }
}

template <class T>
std::vector<T> picked(const std::vector<T>& from, const std::vector<int>& which) {
  std::vector<T> out;
  out.reserve(which.size());
  for (const int i : which) out.push_back(from[std::size_t(i)]);
  return out;
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
  const HexMesh& mesh = whole.mesh;
  MeshPart part;
  std::vector<int> local_element(std::size_t(mesh.elements()), -1);
  for (int e = 0; e < mesh.elements(); ++e) {
    if (whole.part[e] != rank) continue;
    local_element[e] = int(part.elements.size());
    part.elements.push_back(e);
  }
  number_nodes(whole, rank, part);
  std::vector<int> local(std::size_t(mesh.nodes()), -1);
  for (std::size_t i = 0; i < part.nodes.size(); ++i) local[part.nodes[i]] = int(i);
  HexMesh& own = part.mesh;
  own.order = mesh.order;
  own.skin_model = mesh.skin_model;
  own.side = mesh.side;
  own.imaged = picked(mesh.imaged, part.nodes);
  if (!mesh.reference.empty()) own.reference = picked(mesh.reference, part.nodes);
  own.tissue = picked(mesh.tissue, part.elements);
  for (const int e : part.elements) {
    for (int a = 0; a < mesh.nodes_per_element(); ++a) {
      own.connectivity.push_back(local[mesh.element(e)[a]]);
    }
  }
  cut_faces(mesh.skin_faces, local_element, own.skin_faces, &mesh.skin_thickness,
            &own.skin_thickness);
  cut_faces(mesh.pectoral_faces, local_element, own.pectoral_faces, nullptr, nullptr);
  cut_faces(mesh.cut_faces, local_element, own.cut_faces, nullptr, nullptr);
  note_shared(whole, rank, local, part);
  for (std::size_t i = 0; i < part.nodes.size(); ++i) {
    const NodeConstraint* held = whole.held.at(part.nodes[i]);
    if (held != nullptr) part.held.push_back({int(i), *held});
    if (whole.slides[part.nodes[i]] != 0) part.sliding.push_back(int(i));
  }
  return part;
}

void put_wall(const HexMesh& mesh, ByteWriter& out) {
  const bool has = mesh.geometry && mesh.geometry->thorax;
  out.put(has);
  if (!has) return;
  const ThoraxSurface& t = *mesh.geometry->thorax;
  out.put(t.origin);
  for (const double v : {t.slope, t.angle_low, t.angle_high, t.height_low, t.height_high}) {
    out.put(v);
  }
  out.put(t.angles);
  out.put(t.heights);
  out.put(t.coefficients);
}

std::shared_ptr<const LevelSurface> get_wall(ByteReader& in) {
  bool has = false;
  in.get(has);
  if (!has) return nullptr;
  auto t = std::make_shared<ThoraxSurface>();
  in.get(t->origin);
  for (double* v : {&t->slope, &t->angle_low, &t->angle_high, &t->height_low, &t->height_high}) {
    in.get(*v);
  }
  in.get(t->angles);
  in.get(t->heights);
  in.get(t->coefficients);
  return t;
}

std::vector<char> packed(const Whole& whole, const MeshPart& part) {
  ByteWriter out;
  const HexMesh& own = part.mesh;
  out.put(own.order);
  out.put(own.skin_model);
  out.put(own.side);
  out.put(own.imaged);
  out.put(own.reference);
  out.put(own.tissue);
  out.put(own.connectivity);
  out.put(own.skin_faces);
  out.put(own.skin_thickness);
  out.put(own.pectoral_faces);
  out.put(own.cut_faces);
  out.put(part.owned);
  out.put(part.nodes);
  out.put(part.elements);
  out.put(part.shared.size());
  for (const SharedNodes& shared : part.shared) {
    out.put(shared.rank);
    out.put(shared.nodes);
  }
  out.put(part.held.size());
  for (const HeldNode& held : part.held) {
    out.put(held.node);
    out.put(held.constraint.axes);
    out.put(held.constraint.held);
    out.put(held.constraint.increment);
  }
  out.put(part.sliding);
  put_wall(whole.mesh, out);
  return out.take();
}

MeshPart unpacked(const std::vector<char>& bytes) {
  ByteReader in(bytes);
  MeshPart part;
  HexMesh& own = part.mesh;
  in.get(own.order);
  in.get(own.skin_model);
  in.get(own.side);
  in.get(own.imaged);
  in.get(own.reference);
  in.get(own.tissue);
  in.get(own.connectivity);
  in.get(own.skin_faces);
  in.get(own.skin_thickness);
  in.get(own.pectoral_faces);
  in.get(own.cut_faces);
  in.get(part.owned);
  in.get(part.nodes);
  in.get(part.elements);
  std::size_t count = 0;
  in.get(count);
  part.shared.resize(count);
  for (SharedNodes& shared : part.shared) {
    in.get(shared.rank);
    in.get(shared.nodes);
  }
  in.get(count);
  part.held.resize(count);
  for (HeldNode& held : part.held) {
    in.get(held.node);
    in.get(held.constraint.axes);
    in.get(held.constraint.held);
    in.get(held.constraint.increment);
  }
  in.get(part.sliding);
  part.wall = get_wall(in);
  own.points = own.imaged;
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
    own = packed(whole, cut_out(whole, 0));
    for (int rank = 1; rank < ranks.size(); ++rank) {
      others.push_back(packed(whole, cut_out(whole, rank)));
    }
  });
  if (!ranks.root()) return unpacked(ranks.receive(0));
  for (int rank = 1; rank < ranks.size(); ++rank) ranks.send(others[std::size_t(rank) - 1], rank);
  return unpacked(own);
}

}  // namespace breast
