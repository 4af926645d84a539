// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/label_surface.hpp"

#include <unordered_map>

#include "evaluation/overlap.hpp"

namespace breast {

namespace {

// Corners shared by neighbouring faces become one point.
class CornerPoints {
 public:
  CornerPoints(const Grid& grid, TriMesh& mesh) : grid_(grid), mesh_(mesh) {}
  int point(const std::array<int, 3>& corner) {
    const long key =
        (long(corner[2]) * (grid_.size[1] + 1) + corner[1]) * (grid_.size[0] + 1) + corner[0];
    const auto [entry, fresh] = known_.try_emplace(key, int(mesh_.points.size()));
    if (fresh) {
      mesh_.points.push_back(
          grid_.to_patient(Vec3(corner[0] - 0.5, corner[1] - 0.5, corner[2] - 0.5)));
    }
    return entry->second;
  }

 private:
  const Grid& grid_;
  TriMesh& mesh_;
  std::unordered_map<long, int> known_;
};

}  // namespace

TriMesh breast_surface(const LabelVolume& labels) {
  const Grid& grid = labels.grid;
  TriMesh mesh;
  CornerPoints corners(grid, mesh);
  const auto inside = [&](const std::array<int, 3>& v) {
    return grid.contains(v[0], v[1], v[2]) && is_breast(labels.at(v[0], v[1], v[2]));
  };
  const auto add_face = [&](const std::array<int, 3>& voxel, int axis, int side) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    std::array<int, 4> quad{};
    constexpr int order[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int c = 0; c < 4; ++c) {
      std::array<int, 3> corner = voxel;
      corner[std::size_t(axis)] += side;
      corner[std::size_t(u)] += order[c][0];
      corner[std::size_t(v)] += order[c][1];
      quad[std::size_t(c)] = corners.point(corner);
    }
    mesh.triangles.push_back({quad[0], quad[1], quad[2]});
    mesh.triangles.push_back({quad[0], quad[2], quad[3]});
  };
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!inside({i, j, k})) continue;
        for (int axis = 0; axis < 3; ++axis) {
          for (const int side : {0, 1}) {
            std::array<int, 3> neighbour{i, j, k};
            neighbour[std::size_t(axis)] += side ? 1 : -1;
            if (!inside(neighbour)) add_face({i, j, k}, axis, side);
          }
        }
      }
    }
  }
  return mesh;
}

}  // namespace breast
