// SPDX-License-Identifier: GPL-3.0-or-later
// A scalar volume in patient space (LPS, mm), with the conventions of ITK and DICOM.
#pragma once

#include <Eigen/LU>
#include <array>
#include <cstddef>
#include <vector>

#include "core/types.hpp"

namespace breast {

/// Regular grid: voxel (i,j,k) has its centre at origin + direction * (spacing .* (i,j,k)).
struct Grid {
  std::array<int, 3> size{0, 0, 0};
  Vec3 spacing{1, 1, 1};              ///< mm
  Vec3 origin{0, 0, 0};               ///< mm, centre of voxel (0,0,0), LPS
  Mat3 direction = Mat3::Identity();  ///< columns: directions of i, j, k

  std::size_t voxels() const { return std::size_t(size[0]) * size[1] * size[2]; }
  std::size_t offset(int i, int j, int k) const {
    return (std::size_t(k) * size[1] + j) * size[0] + i;
  }
  bool contains(int i, int j, int k) const {
    return i >= 0 && j >= 0 && k >= 0 && i < size[0] && j < size[1] && k < size[2];
  }
  Vec3 to_patient(const Vec3& index) const {
    return origin + direction * spacing.cwiseProduct(index);
  }
  Vec3 to_index(const Vec3& patient) const {
    return (direction.inverse() * (patient - origin)).cwiseQuotient(spacing);
  }
  double voxel_volume() const { return spacing.prod(); }  ///< mm^3
};

/// Voxels in memory order i fastest, then j, then k.
template <class T>
struct Volume {
  Grid grid;
  std::vector<T> voxels;

  Volume() = default;
  explicit Volume(const Grid& g, T value = T{}) : grid(g), voxels(g.voxels(), value) {}
  T& at(int i, int j, int k) { return voxels[grid.offset(i, j, k)]; }
  const T& at(int i, int j, int k) const { return voxels[grid.offset(i, j, k)]; }
};

/// Trilinear interpolation at a patient point; `outside` if the point lies more than half a voxel
/// beyond the outermost voxel centres (within half a voxel, the border value is used).
double sample_linear(const Volume<float>& volume, const Vec3& patient, double outside);

}  // namespace breast
