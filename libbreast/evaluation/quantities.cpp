// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/quantities.hpp"

#include "evaluation/overlap.hpp"
#include "evaluation/wall_distance.hpp"

namespace breast {

std::vector<Quantity> distance_quantities(const std::string& name, const Distances& distances) {
  return {{name + "_mean_mm", name + "/mean_mm", distances.mean_mm, 3},
          {name + "_p95_mm", name + "/p95_mm", distances.p95_mm, 3},
          {name + "_max_mm", name + "/max_mm", distances.max_mm, 3}};
}

std::vector<Quantity> fraction_quantities(const PartialVolume& fractions) {
  const auto plain = [](const std::string& name, double value, int digits) {
    return Quantity{name, name, value, digits};
  };
  return {plain("fibroglandular_fraction_ml", fractions.given_ml, 2),
          plain("fibroglandular_fraction_truth_ml", fractions.truth_ml, 2),
          plain("fibroglandular_dice_within_voxels", fractions.dice, 4),
          plain("fibroglandular_dice_ceiling", fractions.ceiling, 4)};
}

std::vector<Quantity> label_quantities(const LabelVolume& given, const LabelVolume& truth,
                                       const std::vector<bool>& half) {
  std::vector<Quantity> all;
  const auto add = [&all](const std::string& name, const Overlap& overlap) {
    if (overlap.given_ml == 0 && overlap.truth_ml == 0) return;
    all.push_back({name + "_dice", "dice/" + name, overlap.dice, 4});
    all.push_back({name + "_ml", "volumes_ml/" + name, overlap.given_ml, 2});
    all.push_back({name + "_truth_ml", "truth_volumes_ml/" + name, overlap.truth_ml, 2});
  };
  const LabelOverlap overlap = compare_labels(given, truth);
  for (int t = int(Tissue::fat); t < n_tissues; ++t)
    add(std::string(tissue_name(static_cast<Tissue>(t))), overlap.tissue[std::size_t(t)]);
  add("breast", overlap.breast);
  add("body", overlap.body);
  all.push_back({"fibroglandular_in_breast_dice", "dice/fibroglandular_in_breast",
                 gland_dice_in_breast(given, truth, half), 4});
  const WallDistance wall = compare_walls(given, truth);
  if (wall.columns > 0) {
    const auto distances = distance_quantities("wall", wall.distance);
    all.insert(all.end(), distances.begin(), distances.end());
    all.push_back({"wall_bias_mm", "wall/bias_mm", wall.bias_mm, 3});
    all.push_back({"wall_missing_percent", "wall/missing_percent", wall.missing_percent, 2});
  }
  if (wall.columns_on_breast > 0) {
    const auto distances = distance_quantities("wall_on_breast", wall.on_breast);
    all.insert(all.end(), distances.begin(), distances.end());
  }
  const auto a = given.landmarks.find("nipple"), b = truth.landmarks.find("nipple");
  if (a != given.landmarks.end() && b != truth.landmarks.end())
    all.push_back({"nipple_mm", "nipple_mm", (a->second - b->second).norm(), 3});
  return all;
}

}  // namespace breast
