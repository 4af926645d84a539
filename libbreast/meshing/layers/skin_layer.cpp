// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/layers/skin_layer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "mesh/quality.hpp"
#include "meshing/smooth.hpp"

namespace breast {

namespace {

bool on_skin_rim(const HullPlace& place) {
  return place.support == Support::cut && place.height >= 1;
}

void refuse_thick_layer(double thickness, const BodyMap& body, const DomeTemplate& dome) {
  for (const HullPlace& place : dome.places) {
    const double row = on_skin_rim(place) ? body.cut_height(place.u) / dome.size.k : 0;
    if (on_skin_rim(place) && !(thickness < 0.6 * row)) {
      throw input_error(
          "skin layer of ", thickness, " mm: the first row of the cut is ", row,
          " mm high, of which the layer may take 60 %: use a thinner layer or fewer rows "
          "(--dome n,l,m,k)");
    }
  }
}

// Releases the inner nodes of folded elements.
void release_folded(const DomeTemplate& dome, const PlacedNodes& nodes, std::vector<bool>& held) {
  for (std::size_t e = 0; e < dome.connectivity.size(); e += 8) {
    std::array<Vec3, 8> corners;
    for (int a = 0; a < 8; ++a) corners[a] = nodes.x[dome.connectivity[e + a]];
    if (scaled_jacobian(corners.data()) > 0) continue;
    for (int a = 0; a < 8; ++a) {
      const int node = dome.connectivity[e + a];
      if (nodes.support[node] == Support::interior) held[node] = false;
    }
  }
}

}  // namespace

std::vector<int> add_skin_layer(double thickness, const BodyMap& body, DomeTemplate& dome,
                                PlacedNodes& nodes) {
  refuse_thick_layer(thickness, body, dome);
  const std::size_t old_nodes = nodes.x.size();
  PlacedNodes inner = nodes;
  std::vector<bool> held(old_nodes, false);
  for (std::size_t a = 0; a < old_nodes; ++a) {
    const HullPlace& place = dome.places[a];
    if (place.support == Support::skin) {
      inner.x[a] -= thickness * body.skin_sheet().evaluate(nodes.st[a]).normal();
      held[a] = true;
    } else if (place.support == Support::cut) {
      held[a] = true;
      if (!on_skin_rim(place)) continue;
      const Vec2 st = body.skin(1, nodes.st[a].x());
      inner.x[a] -= thickness * body.skin_sheet().evaluate(st).normal();
    }
  }
  smooth_nodes(dome.connectivity, body, {.evaluations = 120}, held, inner);

  std::map<int, int> outer;  // node of the moved hull → its node on the skin
  const std::vector<Face> below = dome.skin_faces;
  std::vector<int> layer;
  dome.skin_faces.clear();
  for (const Face& face : below) {
    std::array<int, 4> low, high;
    for (int c = 0; c < 4; ++c) {
      const int a =
          dome.connectivity[std::size_t(face.element) * 8 + hex_face_corners[face.local][c]];
      const auto [entry, fresh] = outer.try_emplace(a, int(inner.x.size()));
      if (fresh) {
        inner.x.push_back(nodes.x[a]);
        inner.st.push_back(nodes.st[a]);
        inner.support.push_back(nodes.support[a]);
        dome.places.push_back(dome.places[a]);
      }
      low[c] = a;
      high[c] = entry->second;
    }
    const int e = int(dome.connectivity.size()) / 8;
    dome.connectivity.insert(dome.connectivity.end(), low.begin(), low.end());
    dome.connectivity.insert(dome.connectivity.end(), high.begin(), high.end());
    layer.push_back(e);
    dome.skin_faces.push_back({e, 5});
    constexpr std::array<int, 4> side_of_edge = {2, 1, 3, 0};
    for (int c = 0; c < 4; ++c) {
      if (on_skin_rim(dome.places[low[c]]) && on_skin_rim(dome.places[low[(c + 1) % 4]])) {
        dome.cut_faces.push_back({e, side_of_edge[c]});
      }
    }
  }
  for (std::size_t a = 0; a < old_nodes; ++a) {
    if (dome.places[a].support == Support::skin)
      inner.support[a] = dome.places[a].support = Support::interior;
  }
  nodes = std::move(inner);
  return layer;
}

std::vector<int> thin_skin_elements(double thickness, const BodyMap& body, const DomeTemplate& dome,
                                    PlacedNodes& nodes) {
  const int n = dome.size.n, l = dome.size.l, k = dome.size.k;
  const auto number = [&](int i, int j, int row) { return (row * (n + 1) + j) * (n + 1) + i; };
  const auto outwards = [](int i, int last) { return i == 1 ? 0 : i == last - 1 ? last : i; };
  std::vector<bool> held(nodes.x.size());
  for (std::size_t a = 0; a < held.size(); ++a) {
    held[a] = nodes.support[a] == Support::skin || nodes.support[a] == Support::cut;
  }
  for (int row = k; row < l; ++row) {
    for (int j = 1; j < n; ++j) {
      for (int i = 1; i < n; ++i) {
        const int oi = outwards(i, n), oj = outwards(j, n), top = outwards(row, l);
        if (oi == i && oj == j && top != l) continue;
        const int under = number(i, j, row), outer = number(oi, oj, top == l ? l : row);
        const bool rim = nodes.support[outer] == Support::cut;
        const Vec2 st = rim ? body.skin(1, nodes.st[outer].x()) : nodes.st[outer];
        nodes.x[under] = nodes.x[outer] - thickness * body.skin_sheet().evaluate(st).normal();
        // At the rim the node is placed half-way up the first row of the skin, because the element
        // below would otherwise be flat.
        if (rim) nodes.x[under] += 0.5 * (nodes.x[number(oi, oj, row + 1)] - nodes.x[outer]);
        // Under an edge of the cuboid, the wedge determines where the node can lie.
        held[under] = (oi != i) + (oj != j) + (top == l) == 1;
      }
    }
  }
  smooth_nodes(dome.connectivity, body, for_cuboid({.evaluations = 120}), held, nodes);
  if (worst_shape(dome.connectivity, nodes.x) <= 0) {
    release_folded(dome, nodes, held);  // under a sharp nipple neighbouring normals cross
    smooth_nodes(dome.connectivity, body, for_cuboid({.evaluations = 120}), held, nodes);
  }
  std::vector<int> layer;
  for (const Face& face : dome.skin_faces) layer.push_back(face.element);
  std::sort(layer.begin(), layer.end());
  layer.erase(std::unique(layer.begin(), layer.end()), layer.end());
  return layer;
}

}  // namespace breast
