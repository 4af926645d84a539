#include "meshing/skin_layer.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"
#include "meshing/smooth.hpp"

namespace breast {

namespace {

bool on_skin_rim(const HullPlace& place) {
  return place.support == Support::cut && place.height >= 1;
}

// Cut nodes keep their share of the height below the layer; rim nodes go down the cut until they
// are `thickness` below the skin.
double height_below_layer(const BodyMap& body, double u, double thickness) {
  const Vec3 rim = body.cut(1, u), down = body.cut(0, u) - rim;
  const Vec3 normal = body.skin_sheet().evaluate(body.skin(1, u)).normal();
  const double fall = -down.normalized().dot(normal);
  const double share = thickness / std::max(fall, 0.3) / down.norm();
  if (!(share < 0.5)) {
    throw input_error("skin layer of ", thickness, " mm takes ", 100 * share,
                      " % of the cut's height at the rim; at most 50 %: use a thinner layer");
  }
  return 1 - share;
}

}  // namespace

int add_skin_layer(double thickness, const BodyMap& body, DomeTemplate& dome, PlacedNodes& nodes) {
  const std::size_t old_nodes = nodes.x.size();
  PlacedNodes inner = nodes;
  std::vector<bool> held(old_nodes, false);
  for (std::size_t a = 0; a < old_nodes; ++a) {
    const HullPlace& place = dome.places[a];
    if (place.support == Support::skin) {
      inner.x[a] -= thickness * body.skin_sheet().evaluate(nodes.st[a]).normal();
      held[a] = true;
    } else if (place.support == Support::cut) {
      const Vec2 at = nodes.st[a];
      inner.st[a].y() = at.y() * height_below_layer(body, at.x(), thickness);
      inner.x[a] = body.cut(inner.st[a].y(), at.x());
      held[a] = true;
    }
  }
  smooth_nodes(dome.connectivity, body, {.evaluations = 120}, held, inner);

  std::map<int, int> outer;  // node of the moved hull → its node on the skin
  const std::vector<Face> below = dome.skin_faces;
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
  return int(below.size());
}

}  // namespace breast
