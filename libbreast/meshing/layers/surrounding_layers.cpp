// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/layers/surrounding_layers.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <vector>

#include "core/statistics/low_pass.hpp"
#include "mesh/nodal.hpp"
#include "mesh/quality.hpp"
#include "meshing/attempts.hpp"
#include "meshing/hull.hpp"
#include "meshing/layers/extrusion.hpp"
#include "surface/margin.hpp"

namespace breast {

namespace {

/// Steps in which a sheet is followed outwards, mm.
constexpr double step_mm = 1;
constexpr int most_steps = 300;
/// A sheet that is steeper than this against the direction outwards is taken to be so steep.
constexpr double steepest = 0.3;
/// Beyond the margin of the skin sheet the tissue is this wide, straight on where the sheets end, mm.
constexpr double least_mm = 6;
/// The tissue is at least and at most this many times as thick as at the cut.
constexpr double thinnest = 0.5, thickest = 1.5;
/// Number of places around the rim at which the width is found, and standard deviation of its
/// smoothing in places.
constexpr int places = 96;
constexpr double smoothing = 4;
/// Smallest scaled Jacobian of the new elements; the width is reduced by `narrower` until they have
/// it, at most down to `narrowest` of what was asked for.
constexpr double least_scaled_jacobian = wanted_scaled_jacobian, narrower = 0.85,
                 narrowest = 1.0 / 3;

/// Follows a sheet outwards from a point of its rim, in the direction that is at a right angle to the
/// rim, whose direction of increasing u is `tangent` in parameters.
class Outwards {
 public:
  Outwards(const HermiteSheet& sheet, const Vec2& st, const Vec2& tangent)
      : sheet_(sheet), st_(st), at_(sheet.evaluate(st)), x_(at_.x) {
    // A rim is counter-clockwise about the normal.
    way_ = (at_.x_s * tangent.x() + at_.x_t * tangent.y()).cross(at_.normal()).normalized();
  }
  const Vec3& way() const { return way_; }
  const Vec2& parameters() const { return st_; }

  /// The point that is `distance` farther than the rim in the direction `along`; beyond the border of
  /// the sheet, which is continued straight.
  Vec3 point(const Vec3& along, double distance) {
    const Vec3 rim = x_;
    for (int k = 0; k < most_steps; ++k) {
      const double left = distance - (x_ - rim).dot(along);
      if (left <= 0) break;
      const double to_go = left / std::max(way_.dot(along), steepest);
      if (!step(std::min(to_go, step_mm))) return x_ + to_go * way_;
    }
    return x_;
  }
  /// False at the border of the sheet.
  bool step(double mm) {
    Eigen::Matrix<double, 3, 2> slopes;
    slopes << at_.x_s, at_.x_t;
    const Vec2 next = st_ + slopes.colPivHouseholderQr().solve(mm * way_);
    if (next.minCoeff() < 0 || next.maxCoeff() > 1) return false;
    st_ = next;
    at_ = sheet_.evaluate(st_);
    x_ = at_.x;
    const Vec3 normal = at_.normal();
    way_ = (way_ - way_.dot(normal) * normal).normalized();
    return true;
  }

 private:
  const HermiteSheet& sheet_;
  Vec2 st_;
  SheetPoint at_;
  Vec3 x_, way_;
};

/// A node of the cut: u around the rim, the height from wall to skin, and how far it lies from there
/// (in a layer of muscle, behind the wall).
struct CutPlace {
  double u = 0, height = 0;
  Vec3 behind{0, 0, 0};
};

/// Places beyond the cut.
class Beyond {
 public:
  Beyond(const BreastGeometry& geometry, double width) : body_(geometry) {
    for (int k = 0; k < places; ++k) widths_.push_back(width_at(double(k) / places, width));
    widths_ = low_pass(widths_, smoothing);
  }

  /// The place of a node of the cut.
  CutPlace locate(const Vec3& x) const {
    constexpr int around = 720;
    double nearest = std::numeric_limits<double>::infinity();
    Vec2 start = Vec2::Zero();
    for (int k = 0; k < around; ++k) {
      const double u = double(k) / around;
      const Vec3 wall = body_.cut(0, u), up = body_.cut(1, u) - wall;
      const double height = std::clamp((x - wall).dot(up) / up.squaredNorm(), 0.0, 1.0);
      const double apart = (x - wall - height * up).squaredNorm();
      if (apart < nearest) nearest = apart, start = {u, height};
    }
    const Vec2 at = nearest_on_hull(body_, Hull::cut, start, x).at;
    const double height = std::clamp(at.y(), 0.0, 1.0);
    return {at.x(), height, x - body_.cut(height, at.x())};
  }

  /// The point beyond a place of the cut, at this part of the width there.
  Vec3 point(const CutPlace& from, double part) const {
    const double u = from.u, distance = part * width(u);
    Outwards on_wall = wall(u), on_skin = skin(u);
    const Vec3 along = on_wall.way();
    const Vec3 low = on_wall.point(along, distance), high = on_skin.point(along, distance);
    const double at_cut = body_.cut_height(u), here = (high - low).norm();
    const double share = std::clamp(here, thinnest * at_cut, thickest * at_cut) / here;
    return low + from.height * share * (high - low) + from.behind;
  }

  double mean_width() const {
    return std::accumulate(widths_.begin(), widths_.end(), 0.0) / double(places);
  }

 private:
  static constexpr double du = 1e-4;
  Outwards wall(double u) const {
    return {body_.wall_sheet(), body_.wall(1, u), body_.wall(1, u + du) - body_.wall(1, u - du)};
  }
  Outwards skin(double u) const {
    return {body_.skin_sheet(), body_.skin(1, u), body_.skin(1, u + du) - body_.skin(1, u - du)};
  }
  /// The width within the margin of the skin sheet, at most `most`.
  double width_at(double u, double most) const {
    Outwards out = skin(u);
    double width = 0;
    while (width < most && out.step(step_mm) && within_margin(out.parameters(), {}))
      width += step_mm;
    return std::clamp(width, std::min(least_mm, most), most);
  }
  double width(double u) const {
    const double at = (u - std::floor(u)) * places;
    const int k = std::min(int(at), places - 1);
    const double part = at - k;
    return (1 - part) * widths_[std::size_t(k)] + part * widths_[std::size_t((k + 1) % places)];
  }

  BodyMap body_;
  std::vector<double> widths_;  // mm, at equal steps of u
};

/// Mean length of the edges where the cut meets the skin.
double edge_length(const HexMesh& mesh) {
  const std::map<FaceEdge, std::size_t> cut = faces_at_edges(mesh, mesh.cut_faces),
                                        skin = faces_at_edges(mesh, mesh.skin_faces);
  double sum = 0;
  int count = 0;
  for (const auto& [edge, face] : skin) {
    if (!cut.contains(edge)) continue;
    sum += (mesh.imaged[std::size_t(edge.first)] - mesh.imaged[std::size_t(edge.second)]).norm();
    ++count;
  }
  return sum / count;
}

/// One layer from `from` to `to` of the width beyond the breast's cut. `at` has the places of the
/// nodes of the mesh's present cut, and receives those of the next.
void add_layer(const Beyond& beyond, double from, double to, std::map<int, CutPlace>& at,
               HexMesh& mesh) {
  const std::vector<Face> inner = mesh.cut_faces;
  const std::map<FaceEdge, std::size_t> skin = faces_at_edges(mesh, mesh.skin_faces),
                                        wall = faces_at_edges(mesh, mesh.pectoral_faces);
  Extrusion layer(mesh, [&](int node, double depth) {
    return beyond.point(at.at(node), from + depth * (to - from));
  });
  mesh.cut_faces.clear();
  for (const Face& face : inner) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    const int e = layer.element_over(face);
    mesh.tissue.push_back(Tissue::other);
    if (!mesh.fibroglandular_fraction.empty()) mesh.fibroglandular_fraction.push_back(0);
    mesh.cut_faces.push_back({e, 5});
    for (int c = 0; c < 4; ++c) {
      const Face side = Extrusion::side_over(e, c);
      if (const auto beside = skin.find(face_edge(nodes, c)); beside != skin.end()) {
        mesh.skin_faces.push_back(side);
        if (!mesh.skin_thickness.empty())
          mesh.skin_thickness.push_back(mesh.skin_thickness[beside->second]);
      }
      if (wall.contains(face_edge(nodes, c))) mesh.pectoral_faces.push_back(side);
    }
  }
  std::map<int, CutPlace> outer;
  for (const auto& [node, place] : at) outer[layer.node_over(node)] = place;
  at = std::move(outer);
}

/// The mesh with layers over this part of the width.
HexMesh surrounded(const Beyond& beyond, double part, int layers, std::map<int, CutPlace> at,
                   HexMesh mesh) {
  for (int k = 0; k < layers; ++k)
    add_layer(beyond, part * k / layers, part * (k + 1) / layers, at, mesh);
  mesh.scaled_jacobian = scaled_jacobians(mesh, mesh.points);
  return mesh;
}

}  // namespace

Surroundings add_surroundings(double width, HexMesh& mesh) {
  const Beyond beyond(*mesh.geometry, width);
  std::map<int, CutPlace> at;
  for (const int node : nodes_of(mesh, mesh.cut_faces))
    at[node] = beyond.locate(mesh.imaged[std::size_t(node)]);
  const double length = edge_length(mesh);
  const auto first = std::ptrdiff_t(mesh.elements());
  for (double part = 1; part > narrowest; part *= narrower) {
    const int layers = std::max(1, int(std::lround(part * beyond.mean_width() / length)));
    HexMesh whole = surrounded(beyond, part, layers, at, mesh);
    const double worst =
        *std::min_element(whole.scaled_jacobian.begin() + first, whole.scaled_jacobian.end());
    if (!(worst >= least_scaled_jacobian && mesh_quality(whole, whole.points).min_det_bound > 0))
      continue;
    mesh = std::move(whole);
    return {part * beyond.mean_width(), part, layers};
  }
  return {};
}

}  // namespace breast
