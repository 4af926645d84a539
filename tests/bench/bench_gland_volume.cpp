// SPDX-License-Identifier: GPL-3.0-or-later
// Fibroglandular volume of a segmentation against the truth, for a label map with a simulated signal.
//
//     bench_gland_volume LABELS FRACTION SIDES left|right|both [NOISE=0.02] [GLAND=0.3,0.5,0.7]
//
// LABELS has codes 0 air, 1 fat, 2 skin, 29 fibroglandular, 33 nipple, 40 muscle, 60 chest wall, 61
// lung, 62 heart, 88 ligament, 150 vessel; FRACTION the share of fibroglandular tissue (0 to 255);
// SIDES 1 left, 2 right. Fat has a signal of 1, twice as much towards the coil. One row a side and
// brightness of gland: true volume by fraction and by majority, found by fraction and by labels, and
// where the true volume lies that the fractions lack.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"
#include "io/volume_file.hpp"
#include "segment/grid/filters.hpp"
#include "segment/segment.hpp"

namespace breast {
namespace {

double signal_of(int code, double fraction, double gland) {
  switch (code) {
    case 0:
      return 0;
    case 2:
    case 33:
      return 0.5;
    case 40:
      return 0.35;
    case 60:
      return 0.35;
    case 61:
      return 0.08;
    case 62:
      return 0.4;
    case 88:
      return fraction * gland + (1 - fraction) * 0.7;
    case 150:
      return fraction * gland + (1 - fraction) * 0.5;
    default:
      return fraction * gland + (1 - fraction);
  }
}

Volume<float> simulated(const Volume<float>& codes, const Volume<float>& fraction, double gland,
                        double noise) {
  Volume<float> scan(codes.grid);
  const auto& size = codes.grid.size;
  for (std::size_t n = 0; n < scan.voxels.size(); ++n) {
    scan.voxels[n] =
        float(signal_of(int(std::lround(codes.voxels[n])), fraction.voxels[n] / 255, gland));
  }
  scan = gaussian(scan, 0.3);
  std::mt19937 random(5);
  std::normal_distribution<double> normal(0, noise);
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      const double gain = 300 * std::pow(2.0, 1 - 2.0 * j / size[1]);
      for (int i = 0; i < size[0]; ++i) {
        float& v = scan.at(i, j, k);
        v = float(300 * std::hypot(v * gain / 300 + normal(random), normal(random)));
      }
    }
  }
  return scan;
}

void compare(const std::string& name, const Volume<float>& codes, const Volume<float>& fraction,
             const Volume<float>& sides, const LabelVolume& labels, const Segmentation& result) {
  const double voxel = codes.grid.voxel_volume() / mm3_per_ml;
  const int wanted = labels.side == Side::left ? 1 : 2;
  // Loss by our label of the voxel, then by true fraction where it is fat or gland.
  double truth = 0, majority = 0, by_label[n_tissues] = {}, found = 0, labelled = 0, inside[4] = {},
         common = 0;
  for (int k = 0; k < codes.grid.size[2]; ++k) {
    for (int j = 0; j < codes.grid.size[1]; ++j) {
      for (int i = 0; i < codes.grid.size[0]; ++i) {
        if (std::lround(sides.at(i, j, k)) != wanted) continue;
        const double share = fraction.at(i, j, k) / 255 * voxel;
        truth += share;
        const bool is_gland = std::lround(codes.at(i, j, k)) == 29;
        majority += is_gland ? voxel : 0;
        const Vec3 at = labels.grid.to_index(codes.grid.to_patient(Vec3(i, j, k)));
        const int a = int(std::lround(at[0])), b = int(std::lround(at[1])),
                  c = int(std::lround(at[2]));
        if (!labels.grid.contains(a, b, c)) {
          by_label[0] += share;
          continue;
        }
        const std::size_t n = labels.grid.offset(a, b, c);
        const double ours = labels.fibroglandular_fraction[n] * voxel;
        by_label[labels.tissue[n]] += share - ours;
        common += is_gland && labels.tissue[n] == std::uint8_t(Tissue::fibroglandular) ? voxel : 0;
        if (labels.tissue[n] == 1 || labels.tissue[n] == 2)
          inside[std::min(3, int(4 * share / voxel))] += share - ours;
      }
    }
  }
  const double own = labels.grid.voxel_volume() / mm3_per_ml;
  for (std::size_t n = 0; n < labels.tissue.size(); ++n) {
    found += labels.fibroglandular_fraction[n] * own;
    labelled += labels.tissue[n] == std::uint8_t(Tissue::fibroglandular) ? own : 0;
  }
  std::printf(
      "%s\t%.1f\t%.1f\t%.1f (%+.1f %%)\t%.1f (%+.1f %%)\t%.3f\tskin %.1f muscle %.1f other %.1f "
      "air %.1f\t<1/4 %.1f, <1/2 %.1f, <3/4 %.1f, <=1 %.1f\tgland %.3f cv %.3f muscle %.2f\n",
      name.c_str(), truth, majority, found, 100 * (found / truth - 1), labelled,
      100 * (labelled / truth - 1), 2 * common / (labelled + majority), by_label[3], by_label[4],
      by_label[6], by_label[0], inside[0], inside[1], inside[2], inside[3], result.gland_ratio,
      result.bias_cv_after, result.muscle_ratio);
  std::fflush(stdout);
}

int run(const std::vector<std::string>& arguments) {
  const Volume<float> codes = read_volume(arguments[0]), fraction = read_volume(arguments[1]),
                      sides = read_volume(arguments[2]);
  const double noise = arguments.size() > 4 ? std::atof(arguments[4].c_str()) : 0.02;
  std::vector<double> glands{0.3, 0.5, 0.7};
  if (arguments.size() > 5) glands = {std::atof(arguments[5].c_str())};
  std::printf(
      "case\ttruth_ml\tmajority_ml\tby_fraction\tby_label\tdice\tlost in\tlost by fraction\tfound\n");
  for (const double gland : glands) {
    const Volume<float> scan = simulated(codes, fraction, gland, noise);
    for (const Side side : {Side::left, Side::right}) {
      if (arguments[3] != "both" && arguments[3] != side_name(side)) continue;
      SegmentOptions options;
      options.side = side;
      Timer timer;
      try {
        const Segmentation result = segment_breast(scan, options, no_progress(), timer);
        compare(message(side_name(side), " gland ", gland), codes, fraction, sides, result.labels,
                result);
      } catch (const Error& error) {
        std::printf("%s gland %g\trefused: %s\n", std::string(side_name(side)).c_str(), gland,
                    error.what());
      }
    }
  }
  return 0;
}

}  // namespace
}  // namespace breast

int main(int argc, char** argv) {
  const std::vector<std::string> arguments(argv + 1, argv + argc);
  if (arguments.size() < 4 || arguments.size() > 6) {
    std::fprintf(stderr,
                 "usage: bench_gland_volume LABELS FRACTION SIDES left|right|both [NOISE] "
                 "[GLAND]\n");
    return 2;
  }
  try {
    return breast::run(arguments);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
