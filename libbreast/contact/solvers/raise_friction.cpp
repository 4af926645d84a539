// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/solvers/raise_friction.hpp"

#include <map>

#include "mesh/nodal_faces.hpp"

namespace breast {

namespace {

// Friction per area at a corner node.
struct CornerFriction {
  int plate = 0;
  Vec3 anchor{0, 0, 0};
  double bound = 0, stick = 0;  // µN/mm², µN/mm³
};

// Skin faces (of either mesh) with all corners held by the same plate. `plate_of`: plate of each
// corner, −1 for none.
std::vector<Face> held_faces(const HexTopology& mesh, const std::vector<int>& plate_of) {
  std::vector<Face> held;
  for (const Face& face : mesh.skin_faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    const int first = plate_of[std::size_t(nodes[0])];
    bool one_plate = first >= 0;
    for (int c = 1; c < 4; ++c) {
      one_plate = one_plate && plate_of[std::size_t(nodes[std::size_t(c)])] == first;
    }
    if (one_plate) held.push_back(face);
  }
  return held;
}

// The mean of the corners between which a node lies.
CornerFriction mean_of(const std::vector<int>& corners, const std::map<int, CornerFriction>& at) {
  CornerFriction mean;
  for (const int corner : corners) {
    const CornerFriction& one = at.at(corner);
    mean.plate = one.plate;
    mean.anchor += one.anchor / double(corners.size());
    mean.bound += one.bound / double(corners.size());
    mean.stick += one.stick / double(corners.size());
  }
  return mean;
}

}  // namespace

std::shared_ptr<const Term> raise_friction(const FrictionTerm& coarse, const HexMesh& mesh,
                                           const Eigen::VectorXd& x, const RicherMesh& richer) {
  std::vector<int> plate_of(std::size_t(mesh.nodes()), -1);
  for (const FrictionEntry& entry : coarse.entries()) plate_of[entry.node] = entry.plate;
  const std::vector<double> area = nodal_faces(mesh, held_faces(mesh, plate_of), x).area;
  std::map<int, CornerFriction> at;
  std::vector<FrictionEntry> entries;
  for (const FrictionEntry& entry : coarse.entries()) {
    const double own = area[std::size_t(entry.node)];
    if (own > 0) {
      at[entry.node] = {entry.plate, entry.anchor, entry.bound / own, entry.stick / own};
    } else {
      entries.push_back(entry);  // a node that is held alone keeps its own force
    }
  }
  const std::vector<Face> faces = held_faces(richer.mesh, plate_of);
  const NodalFaces spread = nodal_faces(richer.mesh, faces, richer.raise(x));
  for (const int node : nodes_of(richer.mesh, faces)) {
    const CornerFriction here =
        node < richer.corners ? at.at(node)
                              : mean_of(richer.between[std::size_t(node - richer.corners)], at);
    const double own = spread.area[std::size_t(node)];
    entries.push_back({node, here.plate, here.anchor, here.bound * own, here.stick * own});
  }
  auto term = std::make_shared<FrictionTerm>();
  term->set_plates(coarse.plates());
  term->set_entries(std::move(entries));
  return term;
}

}  // namespace breast
