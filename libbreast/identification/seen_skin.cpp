// SPDX-License-Identifier: GPL-3.0-or-later
#include "identification/seen_skin.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "mesh/surroundings.hpp"

namespace breast {

namespace {

constexpr std::size_t least_points = 50, most_points = 20000;
constexpr double least_reach = 5, spacings = 3;  // in mm; multiple of the distance between points

// For every point the sum of the area vectors of its triangles.
std::vector<Vec3> area_vectors(const TriMesh& surface) {
  std::vector<Vec3> sum(surface.points.size(), Vec3::Zero());
  for (const auto& [a, b, c] : surface.triangles) {
    const Vec3 area = (surface.points[std::size_t(b)] - surface.points[std::size_t(a)])
                          .cross(surface.points[std::size_t(c)] - surface.points[std::size_t(a)]);
    for (const int node : {a, b, c}) sum[std::size_t(node)] += area;
  }
  return sum;
}

// Median distance to the nearest other point, over a few hundred points.
double spacing_of(const std::vector<Vec3>& points) {
  const std::size_t stride = std::max<std::size_t>(1, points.size() / 300);
  std::vector<double> nearest;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < points.size(); ++k) {
      const double apart = (points[i] - points[k]).squaredNorm();
      if (k != i && apart > 0) best = std::min(best, apart);
    }
    nearest.push_back(std::sqrt(best));
  }
  return median(std::move(nearest));
}

Vec3 middle_of(int local_face) {
  Vec3 local = Vec3::Zero();
  local[local_face / 2] = local_face % 2 == 0 ? -1 : 1;
  return local;
}

std::set<int> rim_nodes(const HexTopology& mesh) {
  std::set<int> rim;
  for (const std::vector<Face>* faces : {&mesh.cut_faces, &mesh.pectoral_faces}) {
    const std::vector<int> nodes = nodes_of(mesh, *faces);
    rim.insert(nodes.begin(), nodes.end());
  }
  return rim;
}

}  // namespace

SeenSurface seen_surface(const TriMesh& surface, double deviation, const std::string& where) {
  const std::vector<Vec3> normals =
      surface.triangles.empty() ? surface.normals : area_vectors(surface);
  if (normals.size() != surface.points.size()) {
    throw input_error(where, ": points without triangles or normals; give a triangle surface");
  }
  const auto kind = surface.point_data.find("surface");
  const auto is_skin = [&](std::size_t k) {
    return kind == surface.point_data.end() || kind->second[k] == 0;
  };
  SeenSurface seen;
  seen.deviation = deviation;
  const double keep = std::min(1.0, double(most_points) / double(surface.points.size()));
  for (std::size_t k = 0; k < surface.points.size(); ++k) {
    const bool kept = std::floor(double(k + 1) * keep) > std::floor(double(k) * keep);
    if (!kept || !is_skin(k) || !(normals[k].norm() > 0)) continue;
    seen.points.push_back(surface.points[k]);
    seen.normals.push_back(normals[k].normalized());
  }
  if (seen.points.size() < least_points) {
    throw input_error(where, ": ", seen.points.size(), " points with a normal; at least ",
                      least_points, " are needed");
  }
  seen.reach = std::max(least_reach, spacings * spacing_of(seen.points));
  return seen;
}

std::vector<Location> skin_samples(const HexMesh& mesh, double spacing) {
  const std::set<int> rim = rim_nodes(mesh);
  std::vector<Location> samples;
  std::vector<Vec3> places;
  for (const Face& face : of_breast(mesh, mesh.skin_faces)) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    if (std::any_of(nodes.begin(), nodes.end(), [&](int n) { return rim.contains(n); })) continue;
    const Vec3 local = middle_of(face.local),
               at = element_position(mesh, mesh.imaged, face.element, local);
    const bool close = std::any_of(places.begin(), places.end(),
                                   [&](const Vec3& p) { return (p - at).norm() < spacing; });
    if (close) continue;
    places.push_back(at);
    samples.push_back({face.element, local, 0});
  }
  return samples;
}

std::optional<SurfaceDistance> distance_to(const SeenSurface& surface, const Vec3& x) {
  double nearest = std::numeric_limits<double>::infinity();
  std::size_t at = 0;
  for (std::size_t k = 0; k < surface.points.size(); ++k) {
    const double apart = (x - surface.points[k]).squaredNorm();
    if (apart < nearest) nearest = apart, at = k;
  }
  const Vec3 away = x - surface.points[at], &normal = surface.normals[at];
  const double along = away.dot(normal);
  if (!((away - along * normal).norm() <= surface.reach)) return {};
  return SurfaceDistance{along, normal};
}

}  // namespace breast
