// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/skin_folds.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace breast {

namespace {

constexpr double sharp_deg = 45;

/// Corners of a face, in order, seen from outside.
using Corners = std::array<int, 4>;

struct Facet {
  Vec3 centre, normal;  // the normal of unit length, outwards
};

Facet facet(const Corners& corners, const std::vector<Vec3>& x) {
  const auto at = [&](int c) -> const Vec3& { return x[std::size_t(corners[std::size_t(c)])]; };
  return {0.25 * (at(0) + at(1) + at(2) + at(3)),
          (at(2) - at(0)).cross(at(3) - at(1)).normalized()};
}

/// Angle (degrees) between the normals of two faces with a common edge if they form a hollow; 0 if not.
double hollow_deg(const Corners& one, const Corners& other, const std::vector<Vec3>& x) {
  const Facet a = facet(one, x), b = facet(other, x);
  if (!((a.normal - b.normal).dot(a.centre - b.centre) < 0)) return 0;
  const double cosine = std::clamp(a.normal.dot(b.normal), -1.0, 1.0);
  return std::acos(cosine) * 180 / std::numbers::pi;
}

}  // namespace

SkinFolds skin_folds(const HexMesh& mesh, const std::vector<Vec3>& deformed) {
  SkinFolds folds;
  std::map<std::pair<int, int>, Corners> open;  // edges of which one face is known
  for (const Face& face : mesh.skin_faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    const Corners corners{nodes[0], nodes[1], nodes[2], nodes[3]};
    for (std::size_t c = 0; c < 4; ++c) {
      const std::pair edge = std::minmax(corners[c], corners[(c + 1) % 4]);
      const auto [found, is_new] = open.try_emplace({edge.first, edge.second}, corners);
      if (is_new) continue;
      const double now = hollow_deg(found->second, corners, deformed);
      if (!(now > sharp_deg && now > hollow_deg(found->second, corners, mesh.imaged))) continue;
      ++folds.edges;
      folds.sharpest_deg = std::max(folds.sharpest_deg, now);
    }
  }
  return folds;
}

}  // namespace breast
