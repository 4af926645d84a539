// SPDX-License-Identifier: GPL-3.0-or-later
// Fibroglandular volume found of a gland without fat in it, in the analytic breast, against the truth.
//
//     bench_compact_gland [SCALE BRIGHTNESS [BIAS=5] [NOISE=0.02] [VOXEL=2]]
//
// SCALE is the gland's semi-axes over the breast's (0.4, 0.5, 0.65, 0.78: 9, 17, 38, 66 % of the breast), BRIGHTNESS
// its own over that of fat, BIAS the brightness of fat at the nipple over that at the chest wall, NOISE relative to the
// dimmest fat, VOXEL the width of a voxel in mm (2: 2 x 2 x 4 mm, 3: 3 x 3 x 5 mm). One row a case; without arguments
// all cases of docs/validation/geometry.md. The last columns say whether the result is flagged, and by what.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "fixtures/compact_gland.hpp"
#include "segment/quality.hpp"
#include "segment/segment.hpp"

namespace breast {
namespace {

struct Case {
  double scale, brightness, bias = 5, noise = 0.02, voxel = 2;
};

testing::SyntheticScan breast_of(const Case& a) {
  auto scan = a.voxel > 2 ? testing::SyntheticScan::coarse() : testing::SyntheticScan();
  scan.gland_scale = a.scale;
  scan.bias = a.bias;
  scan.noise = a.noise;
  return scan;
}

/// The lowest score and the doubts.
std::string flags_of(const Segmentation& result) {
  std::string flags;
  for (const StageQuality& quality : quality_of(result)) {
    if (quality.score < least_quality)
      flags += message(quality.stage, ' ', quality.score, " (", quality.worst, "); ");
  }
  for (const std::string& doubt : result.doubts) flags += doubt + "; ";
  return flags;
}

void run(const Case& a) {
  const testing::SyntheticScan truth = breast_of(a);
  const Volume<float> scan = testing::scan_of_compact_gland(truth, a.brightness);
  std::printf("%g\t%g\t%g\t%g\t%g\t", a.scale, a.brightness, a.bias, a.noise, a.voxel);
  try {
    Timer timer;
    const Segmentation result = segment_breast(scan, {}, no_progress(), timer);
    const testing::GlandVolume volume = testing::compact_gland_volume(truth, result.labels);
    std::printf("%.1f\t%.1f\t", volume.true_ml, volume.found_ml);
    if (volume.true_ml > 0) std::printf("%+.1f", 100 * (volume.found_ml / volume.true_ml - 1));
    std::printf("\t%s\n", flags_of(result).c_str());
  } catch (const Error& error) {
    std::printf("\t\t\trefused: %s\n", error.what());
  }
  std::fflush(stdout);
}

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases{
      {0, 1},          {0.4, 0.5},      {0.4, 0.6},           {0.4, 0.7},
      {0.4, 0.8},      {0.5, 0.5},      {0.5, 0.6},           {0.5, 0.7},
      {0.5, 0.8},      {0.65, 0.5},     {0.65, 0.6},          {0.65, 0.7},
      {0.65, 0.8},     {0.78, 0.5},     {0.78, 0.6},          {0.78, 0.7},
      {0.78, 0.8},     {0.65, 0.6, 1},  {0.65, 0.7, 1},       {0.65, 0.7, 2},
      {0.65, 0.6, 10}, {0.65, 0.7, 10}, {0.65, 0.7, 5, 0.05}, {0.65, 0.7, 5, 0.02, 3},
      {0.5, 0.7, 10},  {0.78, 0.7, 2},  {0.78, 0.7, 10}};
  return cases;
}

}  // namespace
}  // namespace breast

int main(int argc, char** argv) {
  std::vector<double> values;
  for (int n = 1; n < argc; ++n) values.push_back(std::atof(argv[n]));
  if (values.size() == 1 || values.size() > 5) {
    std::fprintf(stderr, "usage: bench_compact_gland [SCALE BRIGHTNESS [BIAS] [NOISE] [VOXEL]]\n");
    return 2;
  }
  std::printf(
      "scale\tbrightness\tbias\tnoise\tvoxel_mm\ttrue_ml\tfound_ml\terror_percent\tflags\n");
  if (values.empty()) {
    for (const breast::Case& a : breast::all_cases()) breast::run(a);
    return 0;
  }
  breast::Case a{values[0], values[1]};
  if (values.size() > 2) a.bias = values[2];
  if (values.size() > 3) a.noise = values[3];
  if (values.size() > 4) a.voxel = values[4];
  breast::run(a);
  return 0;
}
