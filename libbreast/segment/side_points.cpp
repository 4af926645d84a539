// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "segment/grid/filters.hpp"
#include "segment/work.hpp"

namespace breast {

namespace {

constexpr double smoothing = 3;         // mm, of the body of which normals are the gradient
constexpr double surely_seen = 0.5;     // confidence
constexpr double clear_of_deepest = 3;  // mm: a wall there was held by the search, not seen
constexpr double least_tissue = 8;      // mm in front of a wall, where one is sought

/// Towards less of the smoothed body, along the grid's axes.
Vec3 outward(const Volume<float>& filled, int i, int j, int k) {
  const auto& size = filled.grid.size;
  const auto slope = [&](int a, int b, int c, int d, int e, int f, double step) {
    return double(filled.at(a, b, c) - filled.at(d, e, f)) / step;
  };
  const int i0 = std::max(i - 1, 0), i1 = std::min(i + 1, size[0] - 1), j0 = std::max(j - 1, 0),
            j1 = std::min(j + 1, size[1] - 1), k0 = std::max(k - 1, 0),
            k1 = std::min(k + 1, size[2] - 1);
  const Vec3& mm = filled.grid.spacing;
  return {slope(i0, j, k, i1, j, k, (i1 - i0) * mm[0]),
          slope(i, j0, k, i, j1, k, (j1 - j0) * mm[1]),
          slope(i, j, k0, i, j, k1, (k1 - k0) * mm[2])};
}

/// Points of one kind with what is known of each.
class SidePoints {
 public:
  explicit SidePoints(const Grid& grid) : grid_(grid) {}
  void add(const Vec3& index, const Vec3& normal, double kind, double sure, double deviation) {
    if (!(normal.norm() > 0)) return;
    mesh_.points.push_back(grid_.to_patient(index));
    mesh_.normals.push_back((grid_.direction * normal).normalized());
    mesh_.point_data["surface"].push_back(kind);
    mesh_.point_data["confidence"].push_back(sure);
    mesh_.point_data["sigma_mm"].push_back(deviation);
  }
  TriMesh take() { return std::move(mesh_); }

 private:
  const Grid& grid_;
  TriMesh mesh_;
};

void add_skin(const Work& work, SidePoints& points) {
  const Mask& body = work.body.mask;
  const Grid& grid = body.grid;
  Volume<float> filled(grid);
  for (std::size_t n = 0; n < filled.voxels.size(); ++n) filled.voxels[n] = body.voxels[n];
  filled = gaussian(filled, smoothing);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = work.domain.first; i <= work.domain.last; ++i) {
      const int end = std::min(grid.size[1], int(work.domain.deepest.at(i, k) / grid.spacing[1]));
      for (int j = 0; j < end; ++j) {
        if (!body.at(i, j, k)) continue;
        for (const auto& s : face_neighbours) {
          if (!grid.contains(i + s[0], j + s[1], k + s[2]) || body.at(i + s[0], j + s[1], k + s[2]))
            continue;
          points.add(Vec3(i + 0.5 * s[0], j + 0.5 * s[1], k + 0.5 * s[2]), outward(filled, i, j, k),
                     0, 1, grid.spacing.norm() / 6);
        }
      }
    }
  }
}

/// Every second column each way: the wall is smooth.
void add_wall(const Work& work, SidePoints& points) {
  const Grid& grid = work.scan.grid;
  const HeightField& depth = work.wall.depth;
  for (int k = 1; k + 1 < depth.nz; ++k) {
    for (int i = work.domain.first + 1; i < work.domain.last; i += 2) {
      const double across = depth.at(i + 1, k) - depth.at(i - 1, k),
                   along = depth.at(i, k + 1) - depth.at(i, k - 1);
      if (!(work.wall.confidence.at(i, k) > surely_seen &&
            depth.at(i, k) < work.domain.deepest.at(i, k) - clear_of_deepest &&
            depth.at(i, k) - work.domain.skin.at(i, k) > least_tissue) ||
          std::isnan(across + along))
        continue;
      const Vec3 normal(across / (2 * grid.spacing[0]), -1, along / (2 * grid.spacing[2]));
      points.add(Vec3(i, depth.at(i, k) / grid.spacing[1], k), normal, 1,
                 work.wall.confidence.at(i, k), work.wall.sigma.at(i, k));
    }
  }
}

}  // namespace

TriMesh side_points(const Work& work) {
  SidePoints points(work.scan.grid);
  add_skin(work, points);
  add_wall(work, points);
  return points.take();
}

}  // namespace breast
