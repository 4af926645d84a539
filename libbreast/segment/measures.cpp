// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/measures.hpp"

#include "core/units.hpp"
#include "segment/quality.hpp"

namespace breast {

std::vector<Quantity> measures_of(const Segmentation& result) {
  const LabelVolume& labels = result.labels;
  std::vector<double> millilitres(n_tissues, 0);
  double by_fraction = 0;
  const double voxel = labels.grid.voxel_volume() / mm3_per_ml;
  for (const auto code : labels.tissue) millilitres[code] += voxel;
  for (const float fraction : labels.fibroglandular_fraction) by_fraction += fraction * voxel;
  const double gland = millilitres[int(Tissue::fibroglandular)],
               fat = millilitres[int(Tissue::fat)], skin = millilitres[int(Tissue::skin)];
  std::vector<Quantity> all;
  const auto add = [&all](const std::string& name, const std::string& key, double value) {
    all.push_back({name, key, value});
  };
  for (int t = 1; t < n_tissues; ++t) {
    const std::string name(tissue_name(Tissue(t)));
    add(name + "_ml", "volumes_ml/" + name, millilitres[t]);
  }
  add("breast_ml", "breast_ml", fat + gland + skin);
  add("fibroglandular_by_fraction_ml", "fibroglandular_by_fraction_ml", by_fraction);
  add("density_percent", "density_percent", 100 * by_fraction / (gland + fat));
  add("fat_fraction", "fat_fraction", result.fat_fraction);
  add("fat_fraction_region_growing", "fat_fraction_region_growing", result.fat_fraction_grown);
  add("fibroglandular_agreement", "fibroglandular_agreement", result.fibroglandular_agreement);
  add("fibroglandular_expected_dice", "fibroglandular_expected_dice",
      result.fibroglandular_expected_dice);
  add("lost_edges_percent", "lost_edges_percent", result.lost_edges_percent);
  const Vec3& nipple = labels.landmarks.at("nipple");
  constexpr const char* axis[3] = {"x", "y", "z"};
  for (int d = 0; d < 3; ++d)
    add(std::string("nipple_") + axis[d] + "_mm", std::string("nipple_") + axis[d] + "_mm",
        nipple[d]);
  add("nipple_from_extreme_mm", "nipple_from_extreme_mm", result.nipple_from_extreme);
  add("papilla_height_mm", "papilla_height_mm", result.papilla_height);
  add("skin_thickness_mm", "skin_thickness_mm", labels.skin_thickness);
  add("debris_removed_ml", "debris_removed_ml", result.debris_ml);
  add("beside_torso_ml", "beside_torso_ml", result.beside_ml);
  add("compact_fibroglandular_mm", "compact_fibroglandular_mm", result.compact_dark_mm);
  add("cut_by_view_cm2", "cut_by_view_cm2", result.cut_by_view_cm2);
  add("flat_skin_cm2", "flat_skin_cm2", result.flat_skin_cm2);
  add("subcutaneous_brightness", "subcutaneous_brightness", result.contrast.subcutaneous);
  add("skin_to_subcutis", "skin_to_subcutis", result.contrast.skin_to_subcutis);
  add("saturation_evidence", "saturation_evidence", saturation_evidence(result.contrast));
  add("silent_percent", "silent_percent", 100 * result.contrast.silent_share);
  if (result.kind == Contrast::fat_suppressed) {
    add("muscle_over_fat", "muscle_over_fat", result.muscle_over_fat);
    add("muscle_over_fat_low", "muscle_over_fat_low", result.muscle_over_fat_low);
    add("unsuppressed_ml", "unsuppressed_ml", result.unsuppressed_ml);
  }
  if (result.kind == Contrast::dixon)
    add("exchanged_percent", "exchanged_percent", result.exchanged_percent);
  if (result.also.used) {
    add("skins_apart_mm", "also/skins_apart_mm", result.also.residual_mm);
    add("shared_percent", "also/shared_percent", result.also.shared_percent);
  }
  add("fat_cv_before", "bias/fat_cv_before", result.bias_cv_before);
  add("fat_cv_after", "bias/fat_cv_after", result.bias_cv_after);
  add("bias_range_factor", "bias/range_factor", result.bias_range);
  add("muscle_to_fat", "muscle_to_fat", result.muscle_ratio);
  add("fibroglandular_to_fat", "fibroglandular_to_fat", result.gland_ratio);
  add("wall_confidence_mean", "chest_wall/confidence_mean", result.wall_confidence_mean);
  add("wall_confident_percent", "chest_wall/confident_percent", result.wall_confident_percent);
  if (result.muscle_back_percent)
    add("muscle_back_percent", "chest_wall/muscle_back_percent", *result.muscle_back_percent);
  add("wall_expected_mm", "chest_wall/expected_mm", result.wall_expected_mm);
  add("wall_sigma_mean_mm", "chest_wall/sigma_mean_mm", result.wall_sigma_mean);
  add("wall_sigma_p95_mm", "chest_wall/sigma_p95_mm", result.wall_sigma_p95);
  add("wall_shift_sigmas", "chest_wall/shift_sigmas", result.wall_shift);
  add("sternal_thickness_mm", "chest_wall/sternal_thickness_mm", result.sternal_thickness);
  add("breast_depth_mm", "breast_depth_mm", result.greatest_thickness);
  add("breast_expected_dice", "extent/expected_dice", result.breast_expected_dice);
  add("front_left_out_percent", "extent/front_left_out_percent", result.front_left_out_percent);
  add("lateral_border_mm", "extent/lateral_border_mm", result.lateral_border_mm);
  add("nipple_depth_mm", "extent/nipple_depth_mm", result.nipple_depth_mm);
  add("view_behind_sternum_mm", "extent/view_behind_sternum_mm", result.view_behind_sternum_mm);
  for (const StageQuality& quality : quality_of(result))
    add("quality_" + quality.stage, "quality/" + quality.stage, quality.score);
  add("roll_degrees", "roll_degrees", result.roll_degrees);
  add("midline_mm", "midline_mm", result.midline_mm);
  return all;
}

}  // namespace breast
