// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/quality.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"

namespace breast {

namespace {

class Score {
 public:
  explicit Score(std::string stage) { quality_.stage = std::move(stage); }
  /// `usual` scores 1, `limit` 0.5, as far beyond again 0.
  Score& of(const char* name, double value, double usual, double limit) {
    const double beyond = (value - usual) / (limit - usual);
    const double score = std::isnan(beyond) ? 0 : std::clamp(1 - 0.5 * beyond, 0.0, 1.0);
    if (score < quality_.score) quality_.score = score, quality_.worst = name;
    return *this;
  }
  const StageQuality& quality() const { return quality_; }

 private:
  StageQuality quality_;
};

double breast_ml(const LabelVolume& labels) {
  double voxels = 0;
  for (const std::uint8_t code : labels.tissue) voxels += is_breast(static_cast<Tissue>(code));
  return voxels * labels.grid.voxel_volume() / mm3_per_ml;
}

}  // namespace

double expected_gland_dice(const LabelVolume& labels) {
  double labelled = 0, sum = 0, in_labelled = 0;
  for (std::size_t n = 0; n < labels.tissue.size(); ++n) {
    const auto tissue = static_cast<Tissue>(labels.tissue[n]);
    if (tissue != Tissue::fat && tissue != Tissue::fibroglandular) continue;
    const double fraction = labels.fibroglandular_fraction[n];
    sum += fraction;
    if (tissue != Tissue::fibroglandular) continue;
    labelled += 1;
    in_labelled += fraction;
  }
  return labelled + sum > 0 ? 2 * in_labelled / (labelled + sum) : 1;
}

std::vector<StageQuality> quality_of(const Segmentation& result) {
  const double volume = breast_ml(result.labels);
  Score contrast("contrast"), wall("wall"), extent("extent"), tissue("tissue");
  contrast.of("saturation_evidence", saturation_evidence(result.contrast), 0, 0.75)
      .of("fat_cv", result.bias_cv_after, 0.05, 0.086);
  // A large deviation on few columns, usual at the side, is a doubt instead (doubts.cpp).
  wall.of("expected_mm", result.wall_expected_mm, 0, 1.2)
      .of("muscle_to_fat", result.muscle_ratio, 0.2, 0.12)
      .of("muscle_to_fat", result.muscle_ratio, 0.4, 0.5);
  extent.of("expected_dice", result.breast_expected_dice, 1, 0.93)
      .of("breast_ml", volume, 100, 50)
      .of("breast_ml", volume, 2500, 3500)
      .of("lateral_border_mm", result.lateral_border_mm, 90, 70)
      .of("lateral_border_mm", result.lateral_border_mm, 200, 230);
  // A supine breast neither stands in front of the sternum nor has its nipple foremost.
  if (result.posture == Posture::prone) {
    extent.of("front_left_out_percent", result.front_left_out_percent, 5, 12)
        .of("nipple_depth_mm", result.nipple_depth_mm, 0.8 * result.greatest_thickness,
            0.6 * result.greatest_thickness)
        .of("view_behind_sternum_mm", result.view_behind_sternum_mm, 36, 30);
  }
  // Of a few specks two methods find different ones.
  constexpr double least_gland = 0.01;
  if (1 - result.fat_fraction > least_gland)
    tissue.of("fibroglandular_agreement", result.fibroglandular_agreement, 0.8, 0.5)
        .of("fibroglandular_expected_dice", result.fibroglandular_expected_dice, 1, 0.6);
  tissue.of("lost_edges_percent", result.lost_edges_percent, 40, 60);
  return {contrast.quality(), wall.quality(), extent.quality(), tissue.quality()};
}

}  // namespace breast
