// SPDX-License-Identifier: GPL-3.0-or-later
// What noise, coil bias, thick slices, turned axes, cut fields of view, saturated fat and a coil's
// plate do to a segmentation.
//
//     bench_segment_robustness MR left|right [CASE]      all cases, or the one of that name
//
// failed: breast Dice below 0.93, wall 2 mm or nipple 10 mm away. flagged: refused, a warning, or a
// stage's quality below one half. Scans finer than a millimetre are halved in plane first.
//
// Prints one row per perturbation: the result compared with that of the unchanged scan. Where the
// scan is sampled again so are, in the same way, the labels and the fibroglandular fractions (that
// is, the brightness) of the unchanged one: "of_labels" is what the new voxels could hold,
// "of_fractions" what the limit between fat and gland would find in them if it stayed where it was.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <exception>
#include <string>

#include "core/error.hpp"
#include "evaluation/overlap.hpp"
#include "evaluation/wall_distance.hpp"
#include "fixtures/perturbed_scan.hpp"
#include "io/volume_file.hpp"
#include "segment/grid/filters.hpp"
#include "segment/grid/grid_ops.hpp"
#include "segment/quality.hpp"
#include "segment/segment.hpp"

namespace breast {
namespace {

/// The scan with its fat saturated; fat is the brightest tissue nearby.
Volume<float> saturated(const Volume<float>& scan) {
  const Volume<float> fat = box_maximum(gaussian(scan, 1.5), 25);
  return testing::fat_saturated(scan, [&](int i, int j, int k) { return fat.at(i, j, k); });
}

/// Dice of fibroglandular tissue between the labels and `share`, known of each voxel, sampled again
/// as the scan is and cut at `least`.
double sampled_again(const testing::Perturbation& perturbation, const LabelVolume& labels,
                     const std::vector<float>& share, double least) {
  Volume<float> before(labels.grid);
  before.voxels = share;
  const Volume<float> after = perturbation.apply(before);
  LabelVolume again;
  again.grid = after.grid;
  for (const float value : after.voxels)
    again.tissue.push_back(std::uint8_t(value >= least ? Tissue::fibroglandular : Tissue::air));
  return compare_labels(again, labels).tissue[std::size_t(Tissue::fibroglandular)].dice;
}

/// Of the labels at the best cut, and at one half of the fractions that brightness gave: columns of
/// the table.
std::string ceilings(const testing::Perturbation& perturbation, const LabelVolume& labels) {
  std::vector<float> gland;
  for (const std::uint8_t tissue : labels.tissue)
    gland.push_back(tissue == std::uint8_t(Tissue::fibroglandular));
  double best = 0;
  for (double least = 0.3; least < 0.65; least += 0.1)
    best = std::max(best, sampled_again(perturbation, labels, gland, least));
  return message(best, "\t",
                 sampled_again(perturbation, labels, labels.fibroglandular_fraction, 0.5));
}

struct Timed {
  Segmentation result;
  double seconds;
};

Timed timed(const Volume<float>& scan, Side side) {
  SegmentOptions options;
  options.side = side;
  Timer timer;
  const auto start = std::chrono::steady_clock::now();
  Segmentation result = segment_breast(scan, options, no_progress(), timer);
  return {std::move(result),
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()};
}

void print_row(const std::string& name, const Timed& found, const Segmentation& base,
               const std::string& most) {
  const Segmentation& result = found.result;
  const LabelOverlap overlap = compare_labels(result.labels, base.labels);
  const WallDistance wall = compare_walls(result.labels, base.labels);
  const double nipple =
      (result.labels.landmarks.at("nipple") - base.labels.landmarks.at("nipple")).norm();
  std::string doubts;
  for (const std::string& doubt : result.doubts) doubts += "; " + doubt;
  double least = 1;
  std::string scores;
  for (const StageQuality& quality : quality_of(result)) {
    least = std::min(least, quality.score);
    scores += message(quality.stage, " ", std::lround(100 * quality.score), " ");
  }
  const bool failed = overlap.breast.dice < 0.93 || wall.distance.mean_mm > 2 || nipple > 10;
  const bool flagged = !result.doubts.empty() || least < least_quality;
  std::printf("%s\t%.1f\t%.4f\t%.4f\t%s\t%.2f\t%.2f\t%.2f\t%.3f\t%d\t%d\t%s\t%s\n", name.c_str(),
              found.seconds, overlap.breast.dice, overlap.tissue[int(Tissue::fibroglandular)].dice,
              most.c_str(), wall.distance.mean_mm, wall.distance.p95_mm, nipple,
              result.bias_cv_after, int(failed), int(flagged), scores.c_str(),
              doubts.empty() ? "" : doubts.c_str() + 2);
  std::fflush(stdout);
}

int run(const std::string& file, Side side, const std::string& only) {
  Volume<float> scan = in_patient_order(read_volume(file));
  if (scan.grid.spacing[0] < 1 && scan.grid.spacing[1] < 1) scan = coarsened(scan, {2, 2, 1});
  std::printf(
      "case\tseconds\tbreast_dice\tfibroglandular_dice\tof_labels\tof_fractions\twall_mean_"
      "mm\twall_p95_mm\t"
      "nipple_mm\tfat_cv\tfailed\tflagged\tquality\tmessages\n");
  const Timed base = timed(scan, side);
  print_row("unchanged", base, base.result, "\t");
  auto cases =
      testing::perturbations(side == Side::left, base.result.labels.landmarks.at("nipple"));
  cases.push_back({"fat saturated", saturated});
  for (const testing::Perturbation& perturbation : cases) {
    if (!only.empty() && perturbation.name != only) continue;
    try {
      const Timed found = timed(perturbation.apply(scan), side);
      const std::string most = perturbation.samples_again
                                   ? ceilings(perturbation, base.result.labels)
                                   : std::string("\t");
      print_row(perturbation.name, found, base.result, most);
    } catch (const Error& error) {
      std::printf("%s\t\t\t\t\t\t\t\t\t\t0\t1\t\trefused: %s\n", perturbation.name.c_str(),
                  error.what());
    }
  }
  return 0;
}

}  // namespace
}  // namespace breast

int main(int argc, char** argv) {
  try {
    if (argc != 3 && argc != 4)
      throw breast::input_error("usage: bench_segment_robustness MR left|right [CASE]");
    return breast::run(argv[1], breast::side_from_name(argv[2]), argc > 3 ? argv[3] : "");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_segment_robustness: %s\n", error.what());
    return 1;
  }
}
