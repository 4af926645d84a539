// SPDX-License-Identifier: GPL-3.0-or-later
// Segmentations of scans whose tissue is known, under what scanners and operators do to a scan.
//
//     bench_segment_truth MR TRUTH left|right [CASE]      all cases, or the one of that name
//
// TRUTH is a label map with the codes of the FDA's breast phantoms: 0 air, 1 fat, 2 skin, 29
// fibroglandular, 33 nipple, 34 half fibroglandular, 40 muscle, 60 and 61 behind it, 62 heart, 88
// ligament, 150 vessels, 200 tumour.
//
// Prints one row per case: Dice of the body and of fibroglandular tissue, distance of the wall from
// the truth (mm), the share of the wall within its stated 90 % band and the band's median
// half-width, each by thirds from the midline to the side, what is labelled breast though it is
// dark, where the nipple went, the scores of quality, CPU seconds and the process's peak memory. A
// mirror image is compared with the mirrored truth.
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "evaluation/overlap.hpp"
#include "fixtures/label_truth.hpp"
#include "fixtures/perturbed_scan.hpp"
#include "io/volume_file.hpp"
#include "segment/grid/grid_ops.hpp"
#include "segment/quality.hpp"
#include "segment/segment.hpp"

namespace breast {
namespace {

using namespace testing;

/// Fat and fibroglandular tissue (ml) darker than a tenth of the scan's fat.
double dark_breast_ml(const Segmentation& result, const Volume<float>& scan,
                      const Volume<float>& truth) {
  std::vector<float> fat;
  const LabelVolume& labels = result.labels;
  double dark = 0;
  const auto each = [&](const auto& visit) {
    for (int k = 0; k < labels.grid.size[2]; ++k)
      for (int j = 0; j < labels.grid.size[1]; ++j)
        for (int i = 0; i < labels.grid.size[0]; ++i) {
          const Tissue tissue = labels.at(i, j, k);
          if (tissue != Tissue::fat && tissue != Tissue::fibroglandular) continue;
          const Vec3 p = labels.grid.to_patient(Vec3(i, j, k));
          visit(p, float(sample_linear(scan, p, 0)));
        }
  };
  each([&](const Vec3& p, float value) {
    if (code_at(truth, p) == 1) fat.push_back(value);
  });
  const double limit = 0.1 * percentile(std::move(fat), 0.5, 0);
  each([&](const Vec3&, float value) { dark += value < limit; });
  return dark * labels.grid.voxel_volume() / 1000;
}

double cpu_seconds() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return double(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * double(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

double peak_mb() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return double(used.ru_maxrss) / 1024;
}

double breast_ml(const LabelVolume& labels) {
  double count = 0;
  for (const std::uint8_t code : labels.tissue) count += is_breast(Tissue(code));
  return count * labels.grid.voxel_volume() / 1000;
}

void print_row(const std::string& name, const Segmentation& result, const Volume<float>& scan,
               const Volume<float>& truth, double seconds) {
  LabelVolume known;
  known.grid = truth.grid;
  for (const float code : truth.voxels)
    known.tissue.push_back(std::uint8_t(tissue_of(int(std::lround(code)))));
  const auto walls = wall_scores(result, truth);
  std::printf("%s\t%.1f\t%.0f\t%.4f\t%.3f\t%.2f\t%.2f", name.c_str(), seconds, peak_mb(),
              compare_labels(result.labels, known).body.dice,
              gland_dice(result.labels, truth, result.midline_mm), walls[0].mean(),
              percentile(walls[0].error, 0.95, 0));
  for (const WallScores& wall : walls)
    std::printf("\t%.2f\t%.0f\t%.1f", wall.error.empty() ? 0 : wall.mean(), wall.coverage(),
                percentile(wall.half_width, 0.5, 0));
  const Vec3& nipple = result.labels.landmarks.at("nipple");
  std::printf("\t%.1f\t%.0f\t%.1f %.1f %.1f", dark_breast_ml(result, scan, truth),
              breast_ml(result.labels), nipple[0], nipple[1], nipple[2]);
  for (const StageQuality& quality : quality_of(result))
    std::printf("\t%.2f %s", quality.score, quality.worst.c_str());
  std::string doubts;
  for (const std::string& doubt : result.doubts) doubts += doubt + "; ";
  std::printf("\t%s\n", doubts.c_str());
  std::fflush(stdout);
}

/// What is done to the scan; `truth` moves only with a mirror.
struct Case {
  testing::Perturbation change;
  bool mirrored = false;
};

std::vector<Case> cases() {
  using testing::Perturbation;
  std::vector<Case> all{{{"unchanged", [](const Volume<float>& s) { return s; }}}};
  for (const Perturbation& change : testing::resamplings()) all.push_back({change});
  all.push_back({{"mirrored", testing::mirrored}, true});
  return all;
}

int run(const std::string& scan_file, const std::string& truth_file, Side side,
        const std::string& only) {
  const Volume<float> scan = in_patient_order(read_volume(scan_file));
  const Volume<float> truth = in_patient_order(read_volume(truth_file));
  std::printf("case\tcpu_s\tpeak_mb\tbody\tgland\twall_mean\twall_p95");
  for (const char* region : {"all", "sternal", "mid", "lateral"})
    std::printf("\t%s_mm\t%s_in_90\t%s_half", region, region, region);
  std::printf("\tdark_ml\tbreast_ml\tnipple\tcontrast\twall\textent\ttissue\tmessages\n");
  for (const Case& one : cases()) {
    if (!only.empty() && one.change.name != only) continue;
    const Volume<float> seen = one.change.apply(scan);
    const Volume<float> known = one.mirrored ? testing::mirrored(truth) : truth;
    SegmentOptions options;
    options.side = one.mirrored == (side == Side::left) ? Side::right : Side::left;
    Timer timer;
    const double start = cpu_seconds();
    try {
      const Segmentation result = segment_breast(seen, options, no_progress(), timer);
      print_row(one.change.name, result, seen, known, cpu_seconds() - start);
    } catch (const Error& error) {
      std::printf("%s\t%.1f\trefused: %s\n", one.change.name.c_str(), cpu_seconds() - start,
                  error.what());
    }
  }
  return 0;
}

}  // namespace
}  // namespace breast

int main(int argc, char** argv) {
  try {
    if (argc != 4 && argc != 5)
      throw breast::input_error("usage: bench_segment_truth MR TRUTH left|right [CASE]");
    return breast::run(argv[1], argv[2], breast::side_from_name(argv[3]), argc > 4 ? argv[4] : "");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_segment_truth: %s\n", error.what());
    return 1;
  }
}
