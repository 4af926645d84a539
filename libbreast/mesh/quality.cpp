// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/quality.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "mesh/gauss.hpp"
#include "mesh/lattice.hpp"
#include "mesh/positivity.hpp"

namespace breast {

namespace {

// Neighbours of each corner along ξ, η, ζ, ordered so that a brick's determinant is positive.
constexpr std::array<std::array<int, 3>, 8> corner_neighbours = {
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

double normalised_determinant(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double lengths = a.norm() * b.norm() * c.norm();
  return lengths > 0 ? a.cross(b).dot(c) / lengths : 0;
}

struct LocalPoint {
  Vec3 at;
  double weight;  // Gauss weight, 0 for lattice points
};

std::vector<LocalPoint> gauss_points(int order) {
  std::vector<LocalPoint> points;
  for (const GaussCubePoint& point : gauss_cube(order + 1))
    points.push_back({point.at, point.weight});
  return points;
}

std::vector<LocalPoint> check_points(int order) {
  std::vector<LocalPoint> points = gauss_points(order);
  for (int a = 0; a < 27; ++a) {
    points.push_back({Vec3(a % 3 - 1, (a / 3) % 3 - 1, a / 9 - 1), 0});
  }
  return points;
}

std::array<Vec3, 27> lattice_points(const HexTopology& mesh, const std::vector<Vec3>& nodal,
                                    int e) {
  const int* vtk = lattice::vtk_nodes(mesh.order);
  std::array<Vec3, 27> own;
  for (int a = 0; a < mesh.nodes_per_element(); ++a) own[a] = nodal[mesh.element(e)[vtk[a]]];
  return own;
}

double det_at(const HexTopology& mesh, const std::array<Vec3, 27>& own, const Vec3& local) {
  Vec3 x;
  Mat3 jacobian;
  lattice::evaluate(mesh.order, own.data(), local, x, jacobian);
  return jacobian.determinant();
}

}  // namespace

double scaled_jacobian(const Vec3* corners) {
  double worst = 1;
  for (int c = 0; c < 8; ++c) {
    const auto& next = corner_neighbours[c];
    worst = std::min(
        worst, normalised_determinant(corners[next[0]] - corners[c], corners[next[1]] - corners[c],
                                      corners[next[2]] - corners[c]));
  }
  const auto axis = [&](std::array<int, 4> plus, std::array<int, 4> minus) {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < 4; ++i) sum += corners[plus[i]] - corners[minus[i]];
    return sum;
  };
  return std::min(worst, normalised_determinant(axis({1, 2, 5, 6}, {0, 3, 4, 7}),
                                                axis({2, 3, 6, 7}, {0, 1, 4, 5}),
                                                axis({4, 5, 6, 7}, {0, 1, 2, 3})));
}

namespace {

// The same measure of a curved element: the tangents at its 27 lattice points for the edges.
double curved_scaled_jacobian(const HexTopology& mesh, const std::array<Vec3, 27>& own) {
  double worst = 1;
  for (int a = 0; a < 27; ++a) {
    Vec3 x;
    Mat3 jacobian;
    lattice::evaluate(mesh.order, own.data(), Vec3(a % 3 - 1, (a / 3) % 3 - 1, a / 9 - 1), x,
                      jacobian);
    worst =
        std::min(worst, normalised_determinant(jacobian.col(0), jacobian.col(1), jacobian.col(2)));
  }
  return worst;
}

}  // namespace

double scaled_jacobian(const HexTopology& mesh, const std::vector<Vec3>& nodal, int element) {
  if (mesh.order == 2) return curved_scaled_jacobian(mesh, lattice_points(mesh, nodal, element));
  std::array<Vec3, 8> corners;
  for (int a = 0; a < 8; ++a) corners[a] = nodal[mesh.element(element)[a]];
  return scaled_jacobian(corners.data());
}

std::vector<double> scaled_jacobians(const HexTopology& mesh, const std::vector<Vec3>& nodal) {
  std::vector<double> all(mesh.elements());
  for (int e = 0; e < mesh.elements(); ++e) all[e] = scaled_jacobian(mesh, nodal, e);
  return all;
}

std::vector<double> element_volumes(const HexTopology& mesh, const std::vector<Vec3>& nodal) {
  const std::vector<LocalPoint> gauss = gauss_points(mesh.order);
  std::vector<double> volumes(mesh.elements(), 0.0);
  for (int e = 0; e < mesh.elements(); ++e) {
    const std::array<Vec3, 27> own = lattice_points(mesh, nodal, e);
    for (const LocalPoint& point : gauss) volumes[e] += point.weight * det_at(mesh, own, point.at);
  }
  return volumes;
}

double mesh_volume(const HexTopology& mesh, const std::vector<Vec3>& nodal) {
  double sum = 0;
  for (const double volume : element_volumes(mesh, nodal)) sum += volume;
  return sum;
}

MeshQuality mesh_quality(const HexTopology& mesh, const std::vector<Vec3>& nodal) {
  if (mesh.elements() == 0) throw input_error("mesh quality: the mesh has no elements");
  MeshQuality quality;
  std::vector<double> scaled = scaled_jacobians(mesh, nodal);
  const std::vector<LocalPoint> checks = check_points(mesh.order);
  quality.min_det = std::numeric_limits<double>::infinity();
  quality.max_det = -quality.min_det;
  quality.min_det_bound = quality.min_det;
  for (int e = 0; e < mesh.elements(); ++e) {
    const std::array<Vec3, 27> own = lattice_points(mesh, nodal, e);
    double least = std::numeric_limits<double>::infinity();
    for (const LocalPoint& point : checks) {
      const double det = det_at(mesh, own, point.at);
      least = det < least || std::isnan(det) ? det : least;
      quality.max_det = std::max(quality.max_det, det);
    }
    if (!(least >= quality.min_det)) quality.min_det = least, quality.worst_det_element = e;
    const double proved = std::min(least, jacobian_lower_bound(mesh, nodal, e));
    if (!(proved >= quality.min_det_bound)) quality.min_det_bound = proved;
    if (!(proved > 0)) ++quality.folded;
    ++quality.histogram[scaled[e] > 0 ? std::min(int(10 * scaled[e]), 9) : 0];
    if (!(scaled[e] >= 0.1)) ++quality.below_01;
    if (!(scaled[e] >= 0.2)) ++quality.below_02;
  }
  quality.worst_element = int(std::min_element(scaled.begin(), scaled.end()) - scaled.begin());
  quality.min_scaled_jacobian = scaled[quality.worst_element];
  quality.median_scaled_jacobian = median(std::move(scaled));
  return quality;
}

}  // namespace breast
