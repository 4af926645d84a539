// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/curve_boundary.hpp"

#include <algorithm>
#include <optional>

#include "core/parallel.hpp"
#include "mesh/positivity.hpp"
#include "mesh/quality.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

constexpr int corners = 8, edges_end = 20, faces_end = 26, centre = 26;

// The surface on which a boundary node lies, from the parts of the faces processed so far.
Hull meet(std::optional<Hull> before, Hull face) {
  if (!before || *before == face) return face;
  return *before == Hull::wall || face == Hull::wall ? Hull::wall_rim : Hull::skin_rim;
}

// A boundary node between corners, with its part and the corners of which it is the mean.
struct Between {
  std::optional<Hull> part;
  std::vector<int> corner;
};

void gather(const HexTopology& mesh, const std::vector<Face>& faces, Hull part,
            std::vector<Between>& between) {
  for (const Face& face : faces) {
    const std::vector<int> list = face_nodes(mesh, face);
    for (int i = 0; i < 4; ++i) {
      Between& edge = between[list[4 + i]];
      edge.part = meet(edge.part, part);
      edge.corner = {list[i], list[(i + 1) % 4]};
    }
    between[list[8]] = {part, {list[0], list[1], list[2], list[3]}};
  }
}

// The displacement from the straight position to the surface, or to the same offset from it as the
// corners have.
Vec3 bow_of(const BodyMap& body, const PlacedNodes& nodes, const Between& node,
            const Vec3& straight) {
  std::vector<Vec2> at;
  Vec3 off = Vec3::Zero();
  for (const int corner : node.corner) {
    const HullPoint on = hull_point_of_node(body, *node.part, nodes, corner);
    at.push_back(on.at);
    off += (nodes.x[corner] - on.x) / double(node.corner.size());
  }
  const std::vector<double> weights(at.size(), 1.0 / double(at.size()));
  const Vec2 start = mean_parameters(*node.part, at, weights);
  return nearest_on_hull(body, *node.part, start, straight - off).x + off - straight;
}

// The local node opposite to the local face `face`.
int opposite(int node, int face) {
  Vec3 at = hex_node_local(2, node);
  at[face / 2] = -at[face / 2];
  for (int a = 0; a < 27; ++a) {
    if (hex_node_local(2, a) == at) return a;
  }
  return node;
}

struct Shape {
  double bound, scaled_jacobian;
};

Shape shape_of(const HexMesh& mesh, int element) {
  return {jacobian_lower_bound(mesh, mesh.points, element),
          scaled_jacobian(mesh, mesh.points, element)};
}

bool good_enough(const Shape& curved, const Shape& straight) {
  constexpr double share_of_bound = 0.25, share_of_scaled_jacobian = 0.5;
  return curved.bound >= share_of_bound * straight.bound &&
         curved.scaled_jacobian >= share_of_scaled_jacobian * straight.scaled_jacobian;
}

class Bows {
 public:
  Bows(const BodyMap& body, const PlacedNodes& nodes, HexMesh& mesh)
      : mesh_(mesh),
        straight_(mesh.points),
        bow_(mesh.points.size(), Vec3::Zero()),
        share_(mesh.points.size(), 1.0),
        given_(mesh.points.size(), false) {
    std::vector<Between> between(mesh.points.size());
    gather(mesh, mesh.skin_faces, Hull::skin, between);
    gather(mesh, mesh.pectoral_faces, Hull::wall, between);
    gather(mesh, mesh.cut_faces, Hull::cut, between);
    for (int a = 0; a < mesh.nodes(); ++a) {
      if (!between[a].part) continue;
      bow_[a] = bow_of(body, nodes, between[a], straight_[a]);
      given_[a] = true;
    }
    bow_inside_of_layer();
  }

  void place() {
    for (int e = 0; e < mesh_.elements(); ++e) place_element(mesh_.element(e));
  }
  // Halves the displacements of every element that is no longer good enough; returns false if all
  // are.
  bool hold_back(const std::vector<Shape>& straight, bool give_up);
  CurveReport report() const;

 private:
  void bow_inside_of_layer();
  void place_element(const int* element);

  HexMesh& mesh_;
  const std::vector<Vec3> straight_;
  std::vector<Vec3> bow_;
  std::vector<double> share_;  // part of its displacement that a node takes
  std::vector<bool> given_;    // whether the displacement of the node is its own, not interpolated
};

void Bows::bow_inside_of_layer() {
  for (const Face& face : mesh_.skin_faces) {
    if (mesh_.tissue[face.element] != Tissue::skin) continue;
    const int* element = mesh_.element(face.element);
    for (int a = corners; a < faces_end; ++a) {
      const double outward = hex_node_local(2, a)[face.local / 2];
      if (outward != (face.local % 2 ? 1 : -1)) continue;
      const int inner = element[opposite(a, face.local)];
      if (given_[inner]) continue;
      bow_[inner] = bow_[element[a]];
      given_[inner] = true;
    }
  }
}

void Bows::place_element(const int* element) {
  std::array<Vec3, 27> moved;
  for (int a = 0; a < 27; ++a) moved[a] = share_[element[a]] * bow_[element[a]];
  for (int f = edges_end; f < faces_end; ++f) {
    if (given_[element[f]]) continue;
    const Vec3 face = hex_node_local(2, f);
    moved[f].setZero();
    for (int a = corners; a < edges_end; ++a) {
      if (hex_node_local(2, a).dot(face) == 1) moved[f] += 0.5 * moved[a];
    }
  }
  moved[centre].setZero();
  for (int a = corners; a < edges_end; ++a) moved[centre] -= 0.25 * moved[a];
  for (int a = edges_end; a < faces_end; ++a) moved[centre] += 0.5 * moved[a];
  for (int a = corners; a < 27; ++a) mesh_.points[element[a]] = straight_[element[a]] + moved[a];
}

bool Bows::hold_back(const std::vector<Shape>& straight, bool give_up) {
  std::vector<char> folds(mesh_.elements(), 0);
#pragma omp parallel for num_threads(threads()) schedule(dynamic, 64)
  for (int e = 0; e < mesh_.elements(); ++e) {
    folds[e] = !good_enough(shape_of(mesh_, e), straight[e]);
  }
  std::vector<bool> back(mesh_.points.size(), false);
  for (int e = 0; e < mesh_.elements(); ++e) {
    if (!folds[e]) continue;
    for (int a = corners; a < 27; ++a) back[mesh_.element(e)[a]] = true;
  }
  for (std::size_t a = 0; a < back.size(); ++a) {
    if (back[a]) share_[a] *= give_up ? 0 : 0.5;
  }
  return std::find(folds.begin(), folds.end(), 1) != folds.end();
}

CurveReport Bows::report() const {
  CurveReport report;
  for (std::size_t a = 0; a < bow_.size(); ++a) {
    if (!given_[a]) continue;
    const double bow = bow_[a].norm(), gap = (1 - share_[a]) * bow;
    ++report.nodes;
    report.largest_bow = std::max(report.largest_bow, bow);
    report.held_back += gap > 0;
    report.largest_gap = std::max(report.largest_gap, gap);
  }
  return report;
}

}  // namespace

CurveReport curve_boundary(const BodyMap& body, const PlacedNodes& nodes, HexMesh& mesh) {
  constexpr int halvings = 5;
  std::vector<Shape> straight(mesh.elements());
#pragma omp parallel for num_threads(threads()) schedule(dynamic, 64)
  for (int e = 0; e < mesh.elements(); ++e) straight[e] = shape_of(mesh, e);
  Bows bows(body, nodes, mesh);
  bows.place();
  // This terminates: after the halvings, every round leaves at least one more element straight for
  // good.
  for (int round = 0; bows.hold_back(straight, round >= halvings); ++round) bows.place();
  mesh.imaged = mesh.points;
  return bows.report();
}

}  // namespace breast
