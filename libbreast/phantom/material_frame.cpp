// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/material_frame.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "mesh/lattice.hpp"

namespace breast {

BreastFrames::BreastFrames(const PhantomBreast& breast, const Grid& grid)
    : breast_(breast),
      grid_(grid),
      locator_(breast.imaged_mesh(), breast.imaged_mesh().points),
      nipple_(breast.mesh.points[breast.mesh.nipple_node]) {
  const Vec3 margin(16, 16, 16);
  // Corners of the box in a grid that may be rotated relative to it.
  const Vec3 low = locator_.lower() - margin, high = locator_.upper() + margin;
  Vec3 a = grid.to_index(low), b = a;
  for (int corner = 1; corner < 8; ++corner) {
    const Vec3 at = grid.to_index(Vec3((corner & 1 ? high : low).x(), (corner & 2 ? high : low).y(),
                                       (corner & 4 ? high : low).z()));
    a = a.cwiseMin(at), b = b.cwiseMax(at);
  }
  for (int d = 0; d < 3; ++d) {
    low_[d] = std::clamp(int(std::floor(a[d])), 0, grid.size[d] - 1);
    size_[d] = std::clamp(int(std::ceil(b[d])), 0, grid.size[d] - 1) - low_[d] + 1;
  }
  element_.assign(std::size_t(size_[0]) * size_[1] * size_[2], -1);
#pragma omp parallel for schedule(dynamic) num_threads(threads())
  for (int k = 0; k < size_[2]; ++k)
    for (int j = 0; j < size_[1]; ++j) {
      int hint = -1;
      for (int i = 0; i < size_[0]; ++i) {
        const Vec3 x = grid_.to_patient(Vec3(i + low_[0], j + low_[1], k + low_[2]));
        const auto location = locator_.find(x, hint);
        hint = location ? location->element : -1;
        element_[(std::size_t(k) * size_[1] + j) * size_[0] + i] = hint;
      }
    }
}

// Whether a neighbouring voxel lies in the mesh.
bool BreastFrames::touches(int i, int j, int k) const {
  for (int c = std::max(0, k - 1); c <= std::min(size_[2] - 1, k + 1); ++c)
    for (int b = std::max(0, j - 1); b <= std::min(size_[1] - 1, j + 1); ++b)
      for (int a = std::max(0, i - 1); a <= std::min(size_[0] - 1, i + 1); ++a)
        if (element_[(std::size_t(c) * size_[1] + b) * size_[0] + a] >= 0) return true;
  return false;
}

bool BreastFrames::at(int i, int j, int k, MaterialFrame& out) const {
  const Vec3 x = grid_.to_patient(Vec3(i, j, k));
  i -= low_[0], j -= low_[1], k -= low_[2];
  if (i < 0 || j < 0 || k < 0 || i >= size_[0] || j >= size_[1] || k >= size_[2]) return false;
  const int element = element_[(std::size_t(k) * size_[1] + j) * size_[0] + i];
  if (element >= 0) {
    if (const auto location = locator_.find(x, element)) {
      out = frame(*location, x);
      return true;
    }
  }
  if (!touches(i, j, k) && (x - nipple_).norm() > 15) return false;
  if (breast_.shape.torso().wall_distance(x) > 0 && !breast_.inside_cut(x, 0)) {
    return false;
  }
  out = frame(locator_.nearest(x), x);
  return true;
}

// Outside the mesh the map is extrapolated linearly from the nearest point of the mesh.
MaterialFrame BreastFrames::frame(const Location& location, const Vec3& x) const {
  const HexMesh& mesh = breast_.imaged_mesh();
  std::array<Vec3, 27> imaged, stress_free;
  const int* vtk = lattice::vtk_nodes(mesh.order);
  const int* nodes = mesh.element(location.element);
  for (int a = 0; a < mesh.nodes_per_element(); ++a) {
    imaged[a] = mesh.points[nodes[vtk[a]]];
    stress_free[a] = mesh.reference[nodes[vtk[a]]];
  }
  Vec3 at, material;
  Mat3 imaged_jacobian, jacobian;
  lattice::evaluate(mesh.order, imaged.data(), location.local, at, imaged_jacobian);
  lattice::evaluate(mesh.order, stress_free.data(), location.local, material, jacobian);
  MaterialFrame out;
  out.gradient = jacobian * imaged_jacobian.inverse();
  out.imaged = x;
  out.stress_free = material + out.gradient * (x - at);
  return out;
}

}  // namespace breast
