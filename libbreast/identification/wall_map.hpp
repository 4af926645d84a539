// SPDX-License-Identifier: GPL-3.0-or-later
// The chest wall of a label volume as a smooth height field.
#pragma once

#include <optional>
#include <vector>

#include "image/label_volume.hpp"

namespace breast {

class WallMap {
 public:
  /// Takes the front of the muscle behind tissue in every column with a confidence above one half,
  /// smoothed over 5 mm.
  explicit WallMap(const LabelVolume& labels);

  /// Distance of x behind the wall along its normal, to first order (mm), and that normal, which
  /// points backwards; no value where the wall was not observed.
  struct Distance {
    double value = 0;
    Vec3 normal{0, 1, 0};
  };
  std::optional<Distance> distance(const Vec3& x) const;
  /// Places on the wall about `spacing` mm apart across and along the body (mm, LPS).
  std::vector<Vec3> places(double spacing) const;

 private:
  bool seen(int i, int k) const;
  double depth(int i, int k) const {
    return depth_[std::size_t(k) * std::size_t(nx_) + std::size_t(i)];
  }

  Grid grid_;
  int nx_ = 0, nz_ = 0;
  std::vector<double> depth_;  ///< in voxels j; not a number where the wall was not observed
};

}  // namespace breast
