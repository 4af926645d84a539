// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/shapes/gland_surface.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>

#include "surface/marching_tetrahedra.hpp"

namespace breast {

namespace {

/// Number of cells along an element's edge, and the tetrahedra of a cell around its diagonal from
/// corner 0 to 7, where corner k is at (k & 1, k >> 1 & 1, k >> 2).
constexpr int cells = 3;
constexpr int side = cells + 1;
constexpr std::array<std::array<int, 4>, 6> tetrahedra = {
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

double fraction_of(const HexMesh& mesh, int element) {
  const auto e = std::size_t(element);
  if (!mesh.fibroglandular_fraction.empty()) return mesh.fibroglandular_fraction[e];
  return mesh.tissue[e] == Tissue::fibroglandular ? 1 : 0;
}

Vec3 local_at(double i, double j, double k) {
  return Vec3::Constant(-1) + 2.0 / cells * Vec3(i, j, k);
}

/// The continuous fraction as the first component of a nodal field, for element_position.
std::vector<Vec3> nodal_fraction(const HexMesh& mesh) {
  std::vector<Vec3> field(mesh.points.size(), Vec3::Zero());
  std::vector<int> count(mesh.points.size(), 0);
  for (int e = 0; e < mesh.elements(); ++e) {
    for (int a = 0; a < mesh.nodes_per_element(); ++a) {
      const auto node = std::size_t(mesh.element(e)[a]);
      field[node].x() += fraction_of(mesh, e);
      ++count[node];
    }
  }
  for (std::size_t n = 0; n < field.size(); ++n) field[n] /= std::max(1, count[n]);
  return field;
}

/// One cell of an element: its volume in the scan in mm³, and the fraction at its centre.
struct Cell {
  double volume, fraction;
};

void add_cells(const HexMesh& mesh, const std::vector<Vec3>& field, int element,
               std::vector<Cell>& list) {
  const auto at = [&](double i, double j, double k) {
    return element_position(mesh, mesh.imaged, element, local_at(i, j, k));
  };
  for (int k = 0; k < cells; ++k) {
    for (int j = 0; j < cells; ++j) {
      for (int i = 0; i < cells; ++i) {
        const Vec3 a = at(i + 1, j + 0.5, k + 0.5) - at(i, j + 0.5, k + 0.5),
                   b = at(i + 0.5, j + 1, k + 0.5) - at(i + 0.5, j, k + 0.5),
                   c = at(i + 0.5, j + 0.5, k + 1) - at(i + 0.5, j + 0.5, k);
        const Vec3 middle = local_at(i + 0.5, j + 0.5, k + 0.5);
        list.push_back(
            {std::abs(a.cross(b).dot(c)), element_position(mesh, field, element, middle).x()});
      }
    }
  }
}

double level_enclosing(std::vector<Cell> list, double volume) {
  std::sort(list.begin(), list.end(),
            [](const Cell& a, const Cell& b) { return a.fraction > b.fraction; });
  double sum = 0;
  for (const Cell& cell : list) {
    sum += cell.volume;
    if (sum >= volume) return std::max(cell.fraction, 1e-3);
  }
  return 1e-3;
}

// Normals are area-weighted means, averaged again over neighbours, so that thin triangles are not
// visible.
Facets shaded(TriMesh mesh) {
  std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Vec3 normal = (mesh.points[std::size_t(b)] - mesh.points[std::size_t(a)])
                            .cross(mesh.points[std::size_t(c)] - mesh.points[std::size_t(a)]);
    for (const int corner : {a, b, c}) normals[std::size_t(corner)] += normal;
  }
  for (int pass = 0; pass < 3; ++pass) {
    for (Vec3& n : normals) n.normalize();
    std::vector<Vec3> mean = normals;
    for (const auto& triangle : mesh.triangles) {
      for (const int corner : triangle) {
        for (const int other : triangle) mean[std::size_t(corner)] += normals[std::size_t(other)];
      }
    }
    normals = std::move(mean);
  }
  for (Vec3& n : normals) n.normalize();
  Facets facets{std::move(mesh.points), {}, std::move(normals)};
  for (const auto& [a, b, c] : mesh.triangles) facets.quads.push_back({a, b, c, c});
  return facets;
}

/// The level surface from corners that cells and elements share, for shading across them.
class Surface {
 public:
  Surface(const HexMesh& mesh, const std::vector<Vec3>& nodal, const std::vector<Vec3>& field,
          double level)
      : mesh_(mesh), nodal_(nodal), field_(field), level_(level) {}

  void add_element(int element) {
    std::array<MarchingTetrahedra::Corner, std::size_t(side * side * side)> lattice;
    bool above = false, below = false;
    for (int n = 0; n < int(lattice.size()); ++n) {
      const Vec3 local = local_at(n % side, n / side % side, n / (side * side));
      const double value = element_position(mesh_, field_, element, local).x() - level_;
      lattice[std::size_t(n)] = {0, value, local};
      (value > 0 ? above : below) = true;
    }
    if (!above || !below) return;
    for (MarchingTetrahedra::Corner& corner : lattice) {
      corner.id = id_of(element_position(mesh_, mesh_.imaged, element, corner.place));
      corner.place = element_position(mesh_, nodal_, element, corner.place);
    }
    for (int c = 0; c < cells * cells * cells; ++c) {
      const int i = c % cells, j = c / cells % cells, k = c / (cells * cells);
      for (const auto& tetrahedron : tetrahedra) {
        std::array<MarchingTetrahedra::Corner, 4> corners;
        for (std::size_t t = 0; t < 4; ++t) {
          const int v = tetrahedron[t];
          const int n = (i + (v & 1)) + side * ((j + (v >> 1 & 1)) + side * (k + (v >> 2)));
          corners[t] = lattice[std::size_t(n)];
        }
        surface_.add(corners);
      }
    }
  }
  Facets take() { return shaded(surface_.take()); }

 private:
  // Corners of neighbouring elements coincide in the scan except for rounding.
  std::size_t id_of(const Vec3& imaged) {
    const auto key = [](double x) { return std::llround(x * 1000); };
    return ids_.try_emplace({key(imaged.x()), key(imaged.y()), key(imaged.z())}, ids_.size())
        .first->second;
  }

  const HexMesh& mesh_;
  const std::vector<Vec3>&nodal_, &field_;
  double level_;
  std::map<std::tuple<long long, long long, long long>, std::size_t> ids_;
  MarchingTetrahedra surface_;
};

/// The cells of all elements; `volume` is the volume to which the fractions sum.
std::vector<Cell> all_cells(const HexMesh& mesh, const std::vector<Vec3>& field, double& volume) {
  std::vector<Cell> list;
  volume = 0;
  for (int e = 0; e < mesh.elements(); ++e) {
    const std::size_t first = list.size();
    add_cells(mesh, field, e, list);
    for (std::size_t c = first; c < list.size(); ++c) {
      volume += list[c].volume * fraction_of(mesh, e);
    }
  }
  return list;
}

}  // namespace

double gland_volume(const HexMesh& mesh) {
  double volume = 0;
  all_cells(mesh, nodal_fraction(mesh), volume);
  return volume;
}

Facets gland_facets(const HexMesh& mesh, const std::vector<Vec3>& nodal) {
  const std::vector<Vec3> field = nodal_fraction(mesh);
  double volume = 0;
  std::vector<Cell> list = all_cells(mesh, field, volume);
  if (!(volume > 0)) return {};
  Surface surface(mesh, nodal, field, level_enclosing(std::move(list), volume));
  for (int e = 0; e < mesh.elements(); ++e) surface.add_element(e);
  return surface.take();
}

}  // namespace breast
