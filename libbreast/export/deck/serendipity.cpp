// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/deck/serendipity.hpp"

#include "mesh/shape.hpp"

namespace breast {

namespace {

// Calls visit(centre node, element's nodes, weights) once for every face or element centre.
template <class Visit>
void for_each_centre(const HexTopology& mesh, std::size_t count, const Visit& visit) {
  std::array<std::array<double, 20>, 7> weights;
  for (int c = 0; c < 7; ++c) weights[c] = serendipity_shape(hex_node_local(2, 20 + c));
  std::vector<bool> seen(count, false);
  for (int e = 0; e < mesh.elements(); ++e) {
    const int* nodes = mesh.element(e);
    for (int c = 0; c < 7; ++c) {
      const int centre = nodes[20 + c];
      if (seen[centre]) continue;  // a face centre: both elements give the same
      seen[centre] = true;
      visit(centre, nodes, weights[c]);
    }
  }
}

}  // namespace

std::array<double, 20> serendipity_shape(const Vec3& local) {
  std::array<double, 20> values{};
  for (int a = 0; a < 20; ++a) {
    const Vec3 at = hex_node_local(2, a);
    double product = 1, sum = 0;
    for (int k = 0; k < 3; ++k) {
      product *= at[k] == 0 ? 1 - local[k] * local[k] : 1 + at[k] * local[k];
      sum += at[k] * local[k];
    }
    values[a] = a < 8 ? product * (sum - 2) / 8 : product / 4;
  }
  return values;
}

void interpolate_centres(const HexTopology& mesh, std::vector<Vec3>& nodal) {
  for_each_centre(mesh, nodal.size(),
                  [&](int centre, const int* nodes, const std::array<double, 20>& weights) {
                    nodal[centre].setZero();
                    for (int a = 0; a < 20; ++a) nodal[centre] += weights[a] * nodal[nodes[a]];
                  });
}

void gather_centres(const HexTopology& mesh, std::vector<Vec3>& force) {
  for_each_centre(mesh, force.size(),
                  [&](int centre, const int* nodes, const std::array<double, 20>& weights) {
                    for (int a = 0; a < 20; ++a) force[nodes[a]] += weights[a] * force[centre];
                    force[centre].setZero();
                  });
}

}  // namespace breast
