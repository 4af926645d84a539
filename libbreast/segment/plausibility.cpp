#include "segment/plausibility.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "segment/filters.hpp"
#include "segment/skin_patch.hpp"

namespace breast {

double subcutaneous_brightness(const Work& work) {
  const Grid& grid = work.scan.grid;
  Volume<float> tissue(grid);
  const auto at_depth = [&](std::size_t n, double from, double to) {
    const double depth = -work.skin_distance.voxels[n];
    return depth > from && depth < to;
  };
  // In front of the sternum's skin there is breast and nothing else.
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1] && j * grid.spacing[1] < work.torso.cleft[k]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        const std::size_t n = grid.offset(i, j, k);
        if (at_depth(n, 3, 1e9)) tissue.voxels[n] = work.scan.voxels[n];
      }
    }
  }
  const Volume<float> brightest = box_maximum(gaussian(tissue, 1.5), 25);
  std::vector<float> shares;
  for (std::size_t n = 0; n < tissue.voxels.size(); ++n) {
    if (tissue.voxels[n] > 0 && at_depth(n, 4, 8))
      shares.push_back(tissue.voxels[n] / brightest.voxels[n]);
  }
  if (shares.empty()) return 1;
  const auto middle = shares.begin() + std::ptrdiff_t(shares.size() / 2);
  std::nth_element(shares.begin(), middle, shares.end());
  return *middle;
}

void refuse_saturated_fat(const Work& work) {
  constexpr double least = 1.0 / 3;
  const double brightness = subcutaneous_brightness(work);
  if (!(brightness > least)) {
    throw input_error("the fat beneath the breast's skin has ", std::lround(100 * brightness),
                      " % of the brightness of the tissue around it (at least ",
                      std::lround(100 * least),
                      " % expected): fat is saturated; give the T1 series without fat saturation");
  }
}

double cut_by_view_cm2(const Mask& breast) {
  const Grid& grid = breast.grid;
  double area = 0;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!breast.at(i, j, k)) continue;
        const std::array<int, 3> index{i, j, k};
        for (int d = 0; d < 3; ++d) {
          const double face = grid.voxel_volume() / grid.spacing[d];
          if (index[d] == 0) area += face;
          if (index[d] == grid.size[d] - 1) area += face;
        }
      }
    }
  }
  return area / mm2_per_cm2;
}

double flat_skin_cm2(const Work& work) {
  constexpr double radius = 10, flattest = 1.0 / 250, clear_of_wall = 30;  // mm
  const Grid& grid = work.scan.grid;
  const Vec3 extent = grid.spacing.cwiseProduct(Vec3(grid.size[0], grid.size[1], grid.size[2]));
  std::vector<SkinFace> faces;
  for (const SkinFace& face : skin_faces(work.body.mask, 0.5 * extent, extent.norm())) {
    const int i = std::clamp(int(std::lround(face.centre[0] / grid.spacing[0])), 0,
                             grid.size[0] - 1),
              k = std::clamp(int(std::lround(face.centre[2] / grid.spacing[2])), 0,
                             grid.size[2] - 1);
    const bool on_side = i >= work.domain.first && i <= work.domain.last;
    if (on_side &&
        face.centre[1] < std::min(work.wall.depth.at(i, k) - clear_of_wall, work.torso.cleft[k]))
      faces.push_back(face);
  }
  // Every n-th face stands for n; its neighbourhood is asked of the mask.
  const std::size_t stride = std::max<std::size_t>(1, faces.size() / 1500);
  double flat = 0;
#pragma omp parallel for schedule(dynamic) reduction(+ : flat)
  for (std::size_t n = 0; n < faces.size(); n += stride) {
    const auto patch = skin_faces(work.body.mask, faces[n].centre, 1.3 * radius);
    const TangentFrame frame = tangent_frame(patch, faces[n].centre);
    const Quadric q = quadric_through(patch, frame, 0, radius);
    const double mean = q[3] + q[5], spread = std::hypot(q[3] - q[5], q[4]);
    if (std::abs(mean) + spread < flattest)
      flat += double(stride) * std::max(0.0, faces[n].area.dot(frame.out));
  }
  return flat / mm2_per_cm2;
}

}  // namespace breast
