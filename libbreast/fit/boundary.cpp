// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Geometry>

#include "fit/fit_breast.hpp"

namespace breast {

namespace {

/// Polar fan over the inside of a rim; outward normals when `outward`, else turned over.
/// Returns the index of the first point of the outermost ring.
int add_fan(const HermiteSheet& sheet, const std::vector<Vec2>& rim, const Vec2& centre, int rings,
            bool outward, int part, BoundaryMesh& mesh) {
  const int n = int(rim.size()), base = int(mesh.points.size());
  const auto triangle = [&](int a, int b, int c) {
    if (outward)
      mesh.triangles.push_back({a, b, c});
    else
      mesh.triangles.push_back({a, c, b});
    mesh.part.push_back(part);
  };
  mesh.points.push_back(sheet.position(centre));
  for (int r = 1; r <= rings; ++r)
    for (int i = 0; i < n; ++i)
      mesh.points.push_back(sheet.position(centre + double(r) / rings * (rim[i] - centre)));
  const auto at = [&](int r, int i) { return r == 0 ? base : base + 1 + (r - 1) * n + i % n; };
  for (int r = 0; r < rings; ++r)
    for (int i = 0; i < n; ++i) {
      triangle(at(r, i), at(r + 1, i), at(r + 1, i + 1));
      if (r > 0) triangle(at(r, i), at(r + 1, i + 1), at(r, i + 1));
    }
  return at(rings, 0);
}

}  // namespace

BoundaryMesh boundary_mesh(const BreastGeometry& geometry, int rings) {
  BoundaryMesh mesh;
  const int n = int(geometry.rim_skin.size());
  const int skin = add_fan(geometry.skin, geometry.rim_skin, geometry.centre, rings, true, 0, mesh);
  const int wall =
      add_fan(geometry.wall, geometry.rim_wall, centroid(geometry.rim_wall), rings, false, 2, mesh);
  for (int i = 0; i < n; ++i) {
    const int j = (i + 1) % n;
    mesh.triangles.push_back({skin + i, wall + i, skin + j});
    mesh.triangles.push_back({skin + j, wall + i, wall + j});
    mesh.part.insert(mesh.part.end(), {1, 1});
  }
  return mesh;
}

double enclosed_volume(const BreastGeometry& geometry, int rings) {
  const BoundaryMesh mesh = boundary_mesh(geometry, rings);
  const Vec3 origin = mesh.points.front();
  double six = 0;
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.points[t[0]] - origin, b = mesh.points[t[1]] - origin;
    six += a.dot(b.cross(mesh.points[t[2]] - origin));
  }
  return six / 6;
}

}  // namespace breast
