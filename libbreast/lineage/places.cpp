// SPDX-License-Identifier: GPL-3.0-or-later
#include "lineage/places.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace breast {

namespace {

constexpr double least_part = 0.5, most_apart_mm = 15, margin_mm = 5, least_common_breast = 0.7;

/// Part of the smaller box that lies in the other, 0 to 1, with a margin around both.
double common_part(Eigen::AlignedBox3d a, Eigen::AlignedBox3d b) {
  for (Eigen::AlignedBox3d* box : {&a, &b}) {
    box->min() -= Vec3::Constant(margin_mm);
    box->max() += Vec3::Constant(margin_mm);
  }
  const Eigen::AlignedBox3d both = a.intersection(b);
  return both.isEmpty() ? 0 : both.volume() / std::min(a.volume(), b.volume());
}

std::string words(const Eigen::AlignedBox3d& box) {
  const auto point = [](const Vec3& at) {
    return message(std::lround(at[0]), ",", std::lround(at[1]), ",", std::lround(at[2]));
  };
  return point(box.min()) + " to " + point(box.max());
}

}  // namespace

std::string places_differ(const Origin& a, const Origin& b) {
  if (!a.place.isEmpty() && !b.place.isEmpty()) {
    const double part = common_part(a.place, b.place);
    if (part < least_part) {
      return message("lie at different places (", words(a.place), " and ", words(b.place), " mm, ",
                     std::lround(100 * part), " % in common, at least ",
                     std::lround(100 * least_part), " expected)");
    }
  }
  if (a.nipple && b.nipple) {
    const double distance = (*a.nipple - *b.nipple).norm();
    if (distance > most_apart_mm) {
      return message("have nipples ", std::lround(distance), " mm apart, at most ", most_apart_mm,
                     " expected");
    }
  }
  return "";
}

std::string breasts_differ(const LabelVolume& a, const LabelVolume& b) {
  const auto breast_ml = [](const LabelVolume& labels) {
    const auto voxels = std::count_if(labels.tissue.begin(), labels.tissue.end(),
                                      [](std::uint8_t code) { return is_breast(Tissue(code)); });
    return 1e-3 * double(voxels) * labels.grid.voxel_volume();
  };
  double common = 0;
  const Grid &grid = a.grid, &there = b.grid;
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!is_breast(a.at(i, j, k))) continue;
        const Vec3 at = there.to_index(grid.to_patient(Vec3(i, j, k))).array().round();
        const bool inside = there.contains(int(at[0]), int(at[1]), int(at[2]));
        if (inside && is_breast(b.at(int(at[0]), int(at[1]), int(at[2]))))
          common += 1e-3 * grid.voxel_volume();
      }
    }
  }
  const double all = breast_ml(a) + breast_ml(b) - common;
  if (!(all > 0) || common >= least_common_breast * all) return "";
  return message("are of different breasts, which have ", std::lround(100 * common / all),
                 " % of their volume in common, at least ", std::lround(100 * least_common_breast),
                 " expected");
}

}  // namespace breast
