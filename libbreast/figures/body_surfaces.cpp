// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/body_surfaces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

namespace breast {

namespace {

// Corner, edge and centre nodes of a VTK_BIQUADRATIC_QUAD as four quadrilaterals.
constexpr std::array<std::array<int, 4>, 4> quarters = {
    {{0, 4, 8, 7}, {4, 1, 5, 8}, {8, 5, 2, 6}, {7, 8, 6, 3}}};

/// Height of the upright wall behind a plate's rounded edge, mm.
constexpr double wall_shown = 15;

class Builder {
 public:
  explicit Builder(const std::vector<Vec3>& nodal) : nodal_(nodal) {}
  int node(int n) {
    const auto [at, added] = index_.try_emplace(n, int(facets_.points.size()));
    if (added) facets_.points.push_back(nodal_[n]);
    return at->second;
  }
  void face(const std::vector<int>& nodes) {
    if (nodes.size() == 4) {
      facets_.quads.push_back({node(nodes[0]), node(nodes[1]), node(nodes[2]), node(nodes[3])});
      return;
    }
    for (const auto& q : quarters) {
      facets_.quads.push_back(
          {node(nodes[q[0]]), node(nodes[q[1]]), node(nodes[q[2]]), node(nodes[q[3]])});
    }
  }
  Facets take() { return std::move(facets_); }

 private:
  const std::vector<Vec3>& nodal_;
  std::map<int, int> index_;
  Facets facets_;
};

bool inside_polygon(const std::vector<Vec2>& polygon, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0, j = polygon.size() - 1; i < polygon.size(); j = i++) {
    const Vec2 &a = polygon[i], &b = polygon[j];
    if ((a.y() > p.y()) != (b.y() > p.y()) &&
        p.x() < (b.x() - a.x()) * (p.y() - a.y()) / (b.y() - a.y()) + a.x()) {
      inside = !inside;
    }
  }
  return inside;
}

}  // namespace

Facets face_facets(const HexMesh& mesh, const std::vector<Vec3>& nodal,
                   const std::vector<Face>& faces) {
  Builder builder(nodal);
  for (const Face& face : faces) builder.face(face_nodes(mesh, face));
  return builder.take();
}

Facets tissue_facets(const HexMesh& mesh, const std::vector<Vec3>& nodal, Tissue tissue) {
  HexMesh part;  // the elements of that tissue alone, whose boundary is drawn
  part.order = mesh.order;
  std::vector<int> whole;  // element of the mesh
  for (int e = 0; e < mesh.elements(); ++e) {
    if (mesh.tissue[e] != tissue) continue;
    whole.push_back(e);
    part.connectivity.insert(part.connectivity.end(), mesh.element(e),
                             mesh.element(e) + mesh.nodes_per_element());
  }
  // Faces on the body's own boundary coincide with skin or muscle, which are drawn already.
  std::set<std::pair<int, int>> outer;
  for (const Face& face : boundary_faces(mesh)) outer.emplace(face.element, face.local);
  std::vector<Face> inner;
  for (const Face& face : boundary_faces(part)) {
    if (!outer.contains({whole[face.element], face.local})) inner.push_back(face);
  }
  return face_facets(part, nodal, inner);
}

Facets plate_facets(const PlateRecord& plate, double length, double half_width) {
  const Vec3 normal = plate.normal.normalized();
  const Vec3 anterior = plate.anterior.normalized(), lateral = normal.cross(anterior);
  std::vector<Vec3> profile;  // down the wall, round the edge, to the front
  const double r = plate.edge_radius;
  profile.push_back(plate.origin - r * anterior - (r + wall_shown) * normal);
  constexpr int steps = 24;
  for (int k = steps; k >= 0; --k) {
    const double angle = 0.5 * std::numbers::pi * k / steps;
    profile.push_back(plate.origin - r * std::sin(angle) * anterior -
                      r * (1 - std::cos(angle)) * normal);
  }
  profile.push_back(plate.origin + length * anterior);
  Facets facets;
  for (const Vec3& x : profile) {
    facets.points.push_back(x - half_width * lateral);
    facets.points.push_back(x + half_width * lateral);
  }
  for (int k = 0; k + 1 < int(profile.size()); ++k) {
    facets.quads.push_back({2 * k, 2 * k + 1, 2 * k + 3, 2 * k + 2});
  }
  return facets;
}

SheetFacets sheet_facets(const HermiteSheet& sheet, const std::vector<Vec2>& rim, int fineness) {
  SheetFacets out;
  const int nu = sheet.nu * fineness, nv = sheet.nv * fineness;
  std::vector<Vec3> points;
  for (int j = 0; j <= nv; ++j) {
    for (int i = 0; i <= nu; ++i) {
      points.push_back(sheet.position({double(i) / nu, double(j) / nv}));
    }
  }
  out.inside.points = out.outside.points = points;
  for (int j = 0; j < nv; ++j) {
    for (int i = 0; i < nu; ++i) {
      const std::array<int, 4> quad{j * (nu + 1) + i, j * (nu + 1) + i + 1,
                                    (j + 1) * (nu + 1) + i + 1, (j + 1) * (nu + 1) + i};
      const Vec2 middle((i + 0.5) / nu, (j + 0.5) / nv);
      (inside_polygon(rim, middle) ? out.inside : out.outside).quads.push_back(quad);
    }
  }
  const auto trace = [&](bool along_s, double fixed) {
    std::vector<Vec3> line;
    const int steps = 2 * (along_s ? nu : nv);
    for (int k = 0; k <= steps; ++k) {
      const double moving = double(k) / steps;
      const Vec2 st = along_s ? Vec2(moving, fixed) : Vec2(fixed, moving);
      if (inside_polygon(rim, st)) {
        line.push_back(sheet.position(st));
      } else if (!line.empty()) {
        out.patch_lines.push_back(std::move(line));
        line.clear();
      }
    }
    if (!line.empty()) out.patch_lines.push_back(line);
  };
  for (int j = 0; j <= sheet.nv; ++j) trace(true, double(j) / sheet.nv);
  for (int i = 0; i <= sheet.nu; ++i) trace(false, double(i) / sheet.nu);
  for (std::size_t i = 0; i < rim.size();
       ++i) {  // straight in (s,t), so sampled between its points
    for (int k = 0; k < 4; ++k) {
      const Vec2 st = rim[i] + 0.25 * k * (rim[(i + 1) % rim.size()] - rim[i]);
      out.rim.push_back(sheet.position(st));
    }
  }
  if (!out.rim.empty()) out.rim.push_back(out.rim.front());
  return out;
}

}  // namespace breast
