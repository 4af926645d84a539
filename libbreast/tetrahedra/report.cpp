// SPDX-License-Identifier: GPL-3.0-or-later
#include "tetrahedra/report.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/units.hpp"

namespace breast {

namespace {

// Smallest angle between two faces, degrees.
double least_dihedral(const TetMesh& mesh, const std::array<int, 4>& tetrahedron) {
  constexpr std::array<std::array<int, 3>, 4> face = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  std::array<Vec3, 4> normal;
  for (int f = 0; f < 4; ++f) {
    const Vec3& a = mesh.points[tetrahedron[face[f][0]]];
    normal[f] = (mesh.points[tetrahedron[face[f][1]]] - a)
                    .cross(mesh.points[tetrahedron[face[f][2]]] - a)
                    .normalized();
  }
  double largest_cosine = -1;
  for (int f = 0; f < 4; ++f) {
    for (int g = 0; g < f; ++g)
      largest_cosine = std::max(largest_cosine, -normal[f].dot(normal[g]));
  }
  return std::acos(std::clamp(largest_cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
}

}  // namespace

TetQuality tet_quality(const TetMesh& mesh) {
  TetQuality quality;
  quality.least_volume = quality.least_dihedral = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t) {
    const double volume = tetrahedron_volume(mesh, t);
    quality.volume += volume;
    quality.least_volume = std::min(quality.least_volume, volume);
    quality.least_dihedral =
        std::min(quality.least_dihedral, least_dihedral(mesh, mesh.tetrahedra[t]));
  }
  return quality;
}

void write_report(const TetMesh& mesh, double hex_volume, Report& report) {
  const TetQuality quality = tet_quality(mesh);
  report.set("tetrahedra/count", int(mesh.tetrahedra.size()));
  report.set("tetrahedra/nodes", int(mesh.points.size()));
  report.set("tetrahedra/volume_ml", quality.volume / mm3_per_ml);
  report.set("tetrahedra/volume_error_percent", 100 * (quality.volume / hex_volume - 1));
  report.set("tetrahedra/least_volume_mm3", quality.least_volume);
  report.set("tetrahedra/least_dihedral_deg", quality.least_dihedral);
  std::array<double, n_tissues> volumes{};
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    volumes[int(mesh.tissue[t])] += tetrahedron_volume(mesh, t);
  for (int t = 0; t < n_tissues; ++t) {
    if (volumes[t] > 0) {
      report.set("tetrahedra/volumes_ml/" + std::string(tissue_name(Tissue(t))),
                 volumes[t] / mm3_per_ml);
    }
  }
}

}  // namespace breast
