// SPDX-License-Identifier: GPL-3.0-or-later
#include "surface/marching_tetrahedra.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace breast {

int MarchingTetrahedra::crossing(const Corner* a, const Corner* b) {
  if (a->id > b->id) std::swap(a, b);
  const auto [entry, added] = point_of_.try_emplace({a->id, b->id}, int(mesh_.points.size()));
  if (added) {
    const double f = std::clamp(a->above / (a->above - b->above), margin_, 1 - margin_);
    mesh_.points.push_back((1 - f) * a->place + f * b->place);
  }
  return entry->second;
}

void MarchingTetrahedra::triangle(int a, int b, int c, const Vec3& outward) {
  const Vec3 normal = (mesh_.points[b] - mesh_.points[a]).cross(mesh_.points[c] - mesh_.points[a]);
  if (normal.dot(outward) < 0) std::swap(b, c);
  mesh_.triangles.push_back({a, b, c});
}

void MarchingTetrahedra::add(const std::array<Corner, 4>& tetrahedron) {
  std::array<const Corner*, 4> in{}, out{};
  std::size_t inside = 0, outside = 0;
  for (const Corner& corner : tetrahedron)
    (corner.above > 0 ? in[inside++] : out[outside++]) = &corner;
  if (inside == 0 || outside == 0) return;
  Vec3 outward = Vec3::Zero();
  for (std::size_t k = 0; k < outside; ++k) outward += out[k]->place / double(outside);
  for (std::size_t k = 0; k < inside; ++k) outward -= in[k]->place / double(inside);
  if (inside == 2) {
    const int a = crossing(in[0], out[0]), b = crossing(in[0], out[1]);
    const int c = crossing(in[1], out[1]), d = crossing(in[1], out[0]);
    triangle(a, b, c, outward);
    triangle(a, c, d, outward);
    return;
  }
  const auto& one = inside == 1 ? in : out;
  const auto& three = inside == 1 ? out : in;
  const int a = crossing(one[0], three[0]), b = crossing(one[0], three[1]),
            c = crossing(one[0], three[2]);
  triangle(a, b, c, outward);
}

}  // namespace breast
