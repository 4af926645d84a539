// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/distance.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>

namespace breast {

std::vector<double> distances_to_triangles(const std::vector<Vec3>& points,
                                           const std::vector<std::array<int, 3>>& triangles,
                                           const std::vector<Vec3>& queries) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Faces = std::vector<Kernel::Triangle_3>;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Faces::iterator>;
  const auto to = [](const Vec3& p) { return Kernel::Point_3(p.x(), p.y(), p.z()); };
  Faces faces;
  faces.reserve(triangles.size());
  for (const auto& t : triangles)
    faces.emplace_back(to(points[t[0]]), to(points[t[1]]), to(points[t[2]]));
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree(faces.begin(), faces.end());
  tree.build();
  tree.accelerate_distance_queries();
  std::vector<double> distance(queries.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t q = 0; q < queries.size(); ++q)
    distance[q] = std::sqrt(tree.squared_distance(to(queries[q])));
  return distance;
}

}  // namespace breast
