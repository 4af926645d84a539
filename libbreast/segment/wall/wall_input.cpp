// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/wall/wall_input.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "image/nearest_voxel.hpp"

namespace breast {

double apply_wall_labels(ChestWall& wall, const WallDomain& domain, const Grid& grid,
                         const Volume<float>& labels) {
  const NearestVoxel nearest(labels.grid);
  const auto muscle_at = [&](double i, double j, double k) {
    const std::ptrdiff_t voxel = nearest.at(grid.to_patient(Vec3(i, j, k)));
    return voxel >= 0 && std::lround(labels.voxels[std::size_t(voxel)]) == long(Tissue::muscle);
  };
  double replaced = 0, columns = 0;
  constexpr double fine = 0.25;  // voxels
  for (int k = 0; k < wall.depth.nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      columns += 1;
      for (double j = 0; j < grid.size[1]; j += fine) {
        if (!muscle_at(i, j, k)) continue;
        wall.depth.at(i, k) = j * grid.spacing[1];
        wall.confidence.at(i, k) = 1;
        replaced += 1;
        break;
      }
    }
  }
  if (replaced == 0) {
    throw input_error(
        "the chest-wall label map has no muscle (code 4) in front of this scan's columns");
  }
  return replaced / columns;
}

double end_muscle(LabelVolume& labels, const Volume<float>& given) {
  constexpr double least_mm = 2;  // of what lies behind; less is a hole
  const NearestVoxel nearest(given.grid);
  const Grid& grid = labels.grid;
  double columns = 0, ended = 0;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int i = 0; i < grid.size[0]; ++i) {
      bool seen = false;
      int back = 0, j = 0;  // voxels of other tissue behind the muscle
      for (; j < grid.size[1] && back * grid.spacing[1] < least_mm; ++j) {
        const std::ptrdiff_t at = nearest.at(grid.to_patient(Vec3(i, j, k)));
        const bool muscle =
            at >= 0 && std::lround(given.voxels[std::size_t(at)]) == long(Tissue::muscle);
        seen = seen || (muscle && labels.at(i, j, k) == Tissue::muscle);
        back = seen && at >= 0 && !muscle ? back + 1 : 0;
      }
      columns += seen;
      if (back * grid.spacing[1] < least_mm) continue;
      ended += 1;
      for (j -= back; j < grid.size[1]; ++j) {
        std::uint8_t& tissue = labels.tissue[grid.offset(i, j, k)];
        if (Tissue(tissue) == Tissue::muscle) tissue = std::uint8_t(Tissue::other);
      }
    }
  }
  return columns > 0 ? ended / columns : 0;
}

namespace {

double plate(const Vec2& a, const Vec2& b) {
  const double r2 = (a - b).squaredNorm();
  return r2 > 0 ? 0.5 * r2 * elementary::log(r2) : 0;
}

struct Correction {
  Vec2 site;     ///< mm across and along the wall
  double depth;  ///< mm, what the wall has to move there
};

// A surface, or a table as dense as one, has more points than a dense system can take: the mean of every cell of 8 mm
// stands for those in it, far below what a thin-plate spline between breast and ribs can resolve.
std::vector<Correction> thinned(const std::vector<Correction>& all) {
  constexpr std::size_t most = 400;
  if (all.size() <= most) return all;
  constexpr double cell = 8;  // mm
  std::map<std::array<int, 2>, std::pair<Correction, int>> cells;
  for (const Correction& one : all) {
    const std::array<int, 2> place{int(std::floor(one.site[0] / cell)),
                                   int(std::floor(one.site[1] / cell))};
    auto& [sum, count] = cells.try_emplace(place, Correction{Vec2::Zero(), 0}, 0).first->second;
    sum.site += one.site;
    sum.depth += one.depth;
    ++count;
  }
  std::vector<Correction> means;
  for (const auto& [place, entry] : cells) {
    means.push_back({entry.first.site / entry.second, entry.first.depth / entry.second});
  }
  return means;
}

bool on_wall(const ChestWall& wall, const WallDomain& domain, int i, int k) {
  return i >= domain.first && i <= domain.last && k >= 0 && k < wall.depth.nz &&
         std::isfinite(wall.depth.at(i, k));
}

}  // namespace

void apply_wall_points(ChestWall& wall, const WallDomain& domain, const Grid& grid,
                       const std::vector<Vec3>& points) {
  std::vector<Correction> given;
  for (const Vec3& point : points) {
    const Vec3 index = grid.to_index(point);
    const int i = int(std::lround(index[0])), k = int(std::lround(index[2]));
    if (!on_wall(wall, domain, i, k)) {
      throw input_error("chest-wall point (", point.transpose(),
                        ") mm lies beside the searched chest wall");
    }
    given.push_back({Vec2(index[0] * grid.spacing[0], index[2] * grid.spacing[2]),
                     index[1] * grid.spacing[1] - wall.depth.at(i, k)});
  }
  std::vector<Vec2> sites;
  std::vector<double> corrections;
  for (const Correction& one : thinned(given)) {
    sites.push_back(one.site);
    corrections.push_back(one.depth);
  }
  const std::size_t clicked = sites.size();
  if (clicked == 0) return;
  const int di = std::max(1, int(25 / grid.spacing[0])),
            dk = std::max(1, int(25 / grid.spacing[2]));
  for (int k = 0; k < wall.depth.nz; k += dk) {
    for (int i = domain.first; i <= domain.last; i += di) {
      const Vec2 site(i * grid.spacing[0], k * grid.spacing[2]);
      const auto near = [&](const Vec2& other) { return (site - other).norm() < 50; };
      if (std::any_of(sites.begin(), sites.begin() + std::ptrdiff_t(clicked), near)) continue;
      sites.push_back(site);
      corrections.push_back(0);
    }
  }
  const int n = int(sites.size());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(n + 3, n + 3);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 3);
  for (int a = 0; a < n; ++a) {
    for (int b = 0; b < n; ++b) matrix(a, b) = plate(sites[a], sites[b]);
    matrix(a, a) += 1e-3;  // two clicks on one spot are averaged
    matrix.block<1, 3>(a, n) << 1, sites[a][0], sites[a][1];
    matrix.block<3, 1>(n, a) = matrix.block<1, 3>(a, n).transpose();
    right[a] = corrections[a];
  }
  if (n < 3) matrix.bottomRightCorner<2, 2>().setIdentity();
  const Eigen::VectorXd solution = matrix.fullPivLu().solve(right);
  for (int k = 0; k < wall.depth.nz; ++k) {
    for (int i = domain.first; i <= domain.last; ++i) {
      const Vec2 site(i * grid.spacing[0], k * grid.spacing[2]);
      double move = solution[n] + solution[n + 1] * site[0] + solution[n + 2] * site[1];
      for (int a = 0; a < n; ++a) move += solution[a] * plate(site, sites[a]);
      wall.depth.at(i, k) += move;
      for (std::size_t a = 0; a < clicked; ++a) {
        if ((site - sites[a]).norm() < 10) wall.confidence.at(i, k) = 1;
      }
    }
  }
}

void apply_wall_surface(ChestWall& wall, const WallDomain& domain, const Grid& grid,
                        const std::vector<Vec3>& points) {
  struct Sum {
    Vec3 points = Vec3::Zero();
    double count = 0;
  };
  constexpr double cell = 8;  // mm
  std::map<std::array<int, 2>, Sum> cells;
  const auto beside = [&](const Vec3& index) {
    return !on_wall(wall, domain, int(std::lround(index[0])), int(std::lround(index[2])));
  };
  for (const Vec3& point : points) {
    const Vec3 index = grid.to_index(point);
    if (beside(index)) continue;
    Sum& sum = cells[{int(std::floor(index[0] * grid.spacing[0] / cell)),
                      int(std::floor(index[2] * grid.spacing[2] / cell))}];
    sum.points += point;
    sum.count += 1;
  }
  std::vector<Vec3> means;
  for (const auto& [place, sum] : cells) {
    const Vec3 mean = sum.points / sum.count;
    if (!beside(grid.to_index(mean))) means.push_back(mean);
  }
  if (means.empty()) {
    throw input_error("none of the chest-wall surface's ", points.size(),
                      " points lies on the searched chest wall of this scan");
  }
  apply_wall_points(wall, domain, grid, means);
}

std::vector<Vec3> wall_surface_points(const TriMesh& surface, const std::string& name) {
  const auto kind = surface.point_data.find("surface");
  if (kind == surface.point_data.end()) return surface.points;
  std::vector<Vec3> points;
  for (std::size_t n = 0; n < surface.points.size(); ++n) {
    if (kind->second[n] == 1) points.push_back(surface.points[n]);
  }
  if (points.empty()) {
    throw input_error(name, ": its scalar 'surface' marks no point as chest wall (1)");
  }
  return points;
}

}  // namespace breast
