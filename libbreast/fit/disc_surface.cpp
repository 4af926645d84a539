// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/disc_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>

#include "core/error.hpp"
#include "surface/marching_tetrahedra.hpp"

namespace breast {

namespace {

// The cube's seven edge directions in the split into six tetrahedra around one diagonal.
constexpr int edge_direction[7][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0},
                                      {1, 0, 1}, {0, 1, 1}, {1, 1, 1}};

struct Lattice {
  std::array<int, 3> size{};
  Vec3 origin, step;
  std::vector<float> value;

  std::size_t nodes() const { return std::size_t(size[0]) * size[1] * size[2]; }
  std::size_t offset(int i, int j, int k) const {
    return (std::size_t(k) * size[1] + j) * size[0] + i;
  }
  std::array<int, 3> index(std::size_t n) const {
    return {int(n % size[0]), int(n / size[0] % size[1]), int(n / size[0] / size[1])};
  }
  Vec3 position(std::size_t n) const {
    const auto i = index(n);
    return origin + step.cwiseProduct(Vec3(i[0], i[1], i[2]));
  }
  /// Whether the corners of the cell at (i, j, k) lie on both sides of the skin.
  bool crossed(int i, int j, int k) const {
    int inside = 0;
    for (int c = 0; c < 8; ++c)
      inside += value[offset(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2))] > 0.5f ? 1 : 0;
    return inside != 0 && inside != 8;
  }
};

Lattice sample(const OccupancyField& field, const Box& box, double step_mm) {
  Lattice lattice;
  for (int a = 0; a < 3; ++a) {
    const double length = box.high[a] - box.low[a];
    lattice.size[a] = std::max(4, int(std::lround(length / step_mm)) + 1);
    lattice.step[a] = length / (lattice.size[a] - 1);
  }
  lattice.origin = box.low;
  lattice.value.resize(lattice.nodes());
#pragma omp parallel for schedule(static)
  for (std::size_t n = 0; n < lattice.nodes(); ++n) {
    // Exactly 1/2 would put a crossing onto a node.
    const double v = field.value(lattice.position(n));
    lattice.value[n] = float(std::abs(v - 0.5) < 1e-4 ? 0.5001 : v);
  }
  return lattice;
}

/// Marks the nodes on one side of 1/2 that are joined to the seeds along the lattice's edges.
std::vector<char> joined(const Lattice& lattice, const std::vector<std::size_t>& seeds,
                         bool inside) {
  std::vector<char> mark(lattice.nodes(), 0);
  std::vector<std::size_t> stack;
  const auto push = [&](std::size_t n) {
    if (mark[n] == 0 && (lattice.value[n] > 0.5f) == inside) mark[n] = 1, stack.push_back(n);
  };
  for (const std::size_t n : seeds) push(n);
  while (!stack.empty()) {
    const auto at = lattice.index(stack.back());
    stack.pop_back();
    for (const auto& d : edge_direction)
      for (const int sign : {1, -1}) {
        const int i = at[0] + sign * d[0], j = at[1] + sign * d[1], k = at[2] + sign * d[2];
        if (i >= 0 && j >= 0 && k >= 0 && i < lattice.size[0] && j < lattice.size[1] &&
            k < lattice.size[2])
          push(lattice.offset(i, j, k));
      }
  }
  return mark;
}

/// Leaves one air region (open to the front) and one body region (the breast's).
void simplify(Lattice& lattice, const Vec3& nipple) {
  std::vector<std::size_t> front;
  for (int k = 0; k < lattice.size[2]; ++k)
    for (int i = 0; i < lattice.size[0]; ++i) front.push_back(lattice.offset(i, 0, k));
  const auto air = joined(lattice, front, false);
  for (std::size_t n = 0; n < lattice.nodes(); ++n)
    if (lattice.value[n] < 0.5f && air[n] == 0) lattice.value[n] = 0.75f;
  std::size_t seed = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < lattice.nodes(); ++n) {
    if (lattice.value[n] < 0.5f) continue;
    const double d = (lattice.position(n) - nipple).squaredNorm();
    if (d < nearest) nearest = d, seed = n;
  }
  const auto body = joined(lattice, {seed}, true);
  for (std::size_t n = 0; n < lattice.nodes(); ++n)
    if (lattice.value[n] > 0.5f && body[n] == 0) lattice.value[n] = 0.25f;
}

TriMesh skin_of(const Lattice& lattice) {
  const int order[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
  MarchingTetrahedra surface(0.1);  // evened out afterwards
  const auto corner = [&](const std::array<int, 3>& at) {
    const std::size_t n = lattice.offset(at[0], at[1], at[2]);
    return MarchingTetrahedra::Corner{n, lattice.value[n] - 0.5, lattice.position(n)};
  };
  for (int k = 0; k + 1 < lattice.size[2]; ++k)
    for (int j = 0; j + 1 < lattice.size[1]; ++j)
      for (int i = 0; i + 1 < lattice.size[0]; ++i) {
        if (!lattice.crossed(i, j, k)) continue;
        for (const auto& axes : order) {
          std::array<int, 3> at{i, j, k};
          std::array<MarchingTetrahedra::Corner, 4> corners{corner(at)};
          for (std::size_t c = 0; c < 3; ++c) {
            ++at[std::size_t(axes[c])];
            corners[c + 1] = corner(at);
          }
          surface.add(corners);
        }
      }
  return surface.take();
}

/// The component whose nearest point to `seed` is nearest, renumbered.
TriMesh component_at(const TriMesh& mesh, const Vec3& seed) {
  std::vector<int> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](int n) {
    while (parent[n] != n) n = parent[n] = parent[parent[n]];
    return n;
  };
  for (const auto& t : mesh.triangles) {
    parent[root(t[1])] = root(t[0]);
    parent[root(t[2])] = root(t[0]);
  }
  int nearest = 0;
  for (int n = 1; n < int(mesh.points.size()); ++n)
    if ((mesh.points[n] - seed).squaredNorm() < (mesh.points[nearest] - seed).squaredNorm())
      nearest = n;
  TriMesh kept;
  std::vector<int> number(mesh.points.size(), -1);
  for (int n = 0; n < int(mesh.points.size()); ++n)
    if (root(n) == root(nearest)) {
      number[n] = int(kept.points.size());
      kept.points.push_back(mesh.points[n]);
    }
  for (const auto& t : mesh.triangles)
    if (number[t[0]] >= 0) kept.triangles.push_back({number[t[0]], number[t[1]], number[t[2]]});
  return kept;
}

/// Border loops, each with the surface on its left seen from outside; longest (mm) first.
std::vector<std::vector<int>> border_loops(const TriMesh& mesh) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : mesh.triangles)
    for (int e = 0; e < 3; ++e) ++edges[{t[e], t[(e + 1) % 3]}];
  std::unordered_map<int, int> next;
  for (const auto& [edge, count] : edges)
    if (!edges.contains({edge.second, edge.first})) next[edge.first] = edge.second;
  std::vector<int> starts;
  for (const auto& [from, to] : next) starts.push_back(from);
  std::sort(starts.begin(), starts.end());
  std::vector<std::pair<double, std::vector<int>>> loops;
  std::vector<char> used(mesh.points.size(), 0);
  for (const int start : starts) {
    if (used[start]) continue;
    std::vector<int> loop;
    double length = 0;
    for (int n = start; !used[n]; n = next.at(n)) {
      used[n] = 1;
      loop.push_back(n);
      length += (mesh.points[next.at(n)] - mesh.points[n]).norm();
    }
    loops.emplace_back(length, std::move(loop));
  }
  std::stable_sort(loops.begin(), loops.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<std::vector<int>> result;
  for (auto& loop : loops) result.push_back(std::move(loop.second));
  return result;
}

int euler_number(const TriMesh& mesh) {
  std::map<std::pair<int, int>, int> edges;
  for (const auto& t : mesh.triangles)
    for (int e = 0; e < 3; ++e) ++edges[std::minmax(t[e], t[(e + 1) % 3])];
  return int(mesh.points.size()) - int(edges.size()) + int(mesh.triangles.size());
}

void close_by_fan(TriMesh& mesh, const std::vector<int>& loop, std::vector<char>& filled) {
  Vec3 middle = Vec3::Zero();
  for (const int n : loop) middle += mesh.points[n] / double(loop.size());
  const int hub = int(mesh.points.size());
  mesh.points.push_back(middle);
  filled.push_back(1);
  for (std::size_t i = 0; i < loop.size(); ++i)
    mesh.triangles.push_back({loop[(i + 1) % loop.size()], loop[i], hub});
}

void find_normals(DiscSurface& surface) {
  surface.normals.assign(surface.points.size(), Vec3::Zero());
  surface.areas.assign(surface.points.size(), 0);
  for (const auto& t : surface.triangles) {
    const Vec3 n = (surface.points[t[1]] - surface.points[t[0]])
                       .cross(surface.points[t[2]] - surface.points[t[0]]);
    for (const int v : t) {
      surface.normals[v] += n;
      surface.areas[v] += n.norm() / 6;
    }
  }
  for (Vec3& n : surface.normals) n.normalize();
}

/// Moves inner points to their neighbours' mean along the surface and back onto the skin.
void even_out(DiscSurface& surface, const OccupancyField& field, int rounds) {
  const std::size_t count = surface.points.size();
  std::vector<char> fixed = surface.filled;
  for (const int n : surface.border) fixed[n] = 1;
  for (int round = 0; round < rounds; ++round) {
    find_normals(surface);
    std::vector<Vec3> sum(count, Vec3::Zero());
    std::vector<double> weight(count, 0);
    for (const auto& t : surface.triangles)
      for (int e = 0; e < 3; ++e) {
        const int a = t[e], b = t[(e + 1) % 3];
        sum[a] += surface.points[b], sum[b] += surface.points[a];
        ++weight[a], ++weight[b];
      }
#pragma omp parallel for schedule(static)
    for (std::size_t n = 0; n < count; ++n) {
      if (fixed[n]) continue;
      const Vec3 move = sum[n] / weight[n] - surface.points[n];
      Vec3 p = surface.points[n] + 0.7 * (move - surface.normals[n] * surface.normals[n].dot(move));
      for (int i = 0; i < 3; ++i) {
        const Vec3 g = field.gradient(p);
        const double g2 = g.squaredNorm();
        if (!(g2 > 1e-6)) break;
        Vec3 step = (0.5 - field.value(p)) / g2 * g;
        if (step.norm() > 1) step *= 1 / step.norm();
        p += step;
      }
      if ((p - surface.points[n]).norm() < 5) surface.points[n] = p;
    }
  }
  find_normals(surface);
}

}  // namespace

DiscSurface extract_skin(const OccupancyField& field, const Box& box, const Vec3& nipple,
                         double step_mm) {
  Lattice lattice = sample(field, box, step_mm);
  const auto [low, high] = std::minmax_element(lattice.value.begin(), lattice.value.end());
  if (!(*low < 0.5f && *high > 0.5f))
    throw input_error("labels: no skin in the box around the breast (body fraction ", *low, " to ",
                      *high, "): the body mask has no air or no tissue there");
  simplify(lattice, nipple);
  TriMesh mesh = component_at(skin_of(lattice), nipple);

  DiscSurface surface;
  surface.filled.assign(mesh.points.size(), 0);
  const auto loops = border_loops(mesh);
  if (loops.empty())
    throw input_error(
        "labels: the skin of the breast is a closed surface: the body behind the breast is "
        "missing");
  for (std::size_t l = 1; l < loops.size(); ++l) close_by_fan(mesh, loops[l], surface.filled);
  if (const int euler = euler_number(mesh); euler != 1)
    throw input_error(
        "labels: the skin around the breast does not have the topology of a disc "
        "(Euler number ",
        euler, " instead of 1): the body mask has handles; smooth or close it in segment");
  surface.points = std::move(mesh.points);
  surface.triangles = std::move(mesh.triangles);
  surface.border = loops[0];
  even_out(surface, field, 6);
  return surface;
}

}  // namespace breast
