// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/element_order.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "mesh/shape.hpp"

namespace breast {

namespace {

// Corner nodes whose mean is a node of the 27-node element; sorted, they name it across elements.
std::vector<int> corners_of(const int* element, int local_node) {
  const Vec3 at = hex_node_local(2, local_node);
  std::vector<int> corners;
  for (int c = 0; c < 8; ++c) {
    const Vec3 corner = hex_node_local(1, c);
    bool meets = true;
    for (int k = 0; k < 3; ++k) meets = meets && (at[k] == 0 || at[k] == corner[k]);
    if (meets) corners.push_back(element[c]);
  }
  std::sort(corners.begin(), corners.end());
  return corners;
}

}  // namespace

HexMesh raise_order(const HexMesh& mesh) {
  if (mesh.order == 2) return mesh;
  HexMesh raised = mesh;
  raised.order = 2;
  raised.connectivity.clear();
  raised.element_numbers.clear();  // a mesh of its own
  raised.node_numbers.clear();
  raised.contact_pressure.clear();
  const auto add = [](std::vector<Vec3>& nodal, const std::vector<int>& corners) {
    if (nodal.empty()) return;
    Vec3 mean = Vec3::Zero();
    for (const int corner : corners) mean += nodal[corner];
    nodal.push_back(mean / double(corners.size()));
  };
  std::map<std::vector<int>, int> known;
  for (int e = 0; e < mesh.elements(); ++e) {
    for (int a = 0; a < 27; ++a) {
      const std::vector<int> corners = corners_of(mesh.element(e), a);
      if (corners.size() == 1) {
        raised.connectivity.push_back(corners[0]);
        continue;
      }
      const auto [entry, is_new] = known.try_emplace(corners, raised.nodes());
      raised.connectivity.push_back(entry->second);
      if (!is_new) continue;
      add(raised.imaged, corners);
      add(raised.reference, corners);
      add(raised.points, corners);
    }
  }
  return raised;
}

}  // namespace breast
