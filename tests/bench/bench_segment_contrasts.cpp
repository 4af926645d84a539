// SPDX-License-Identifier: GPL-3.0-or-later
// Segmentations of known anatomies in the contrasts of breast MR.
//
//     bench_segment_contrasts TRUTH... [--side left|right] [--only CASE]...
//
// TRUTH are label maps as of bench_segment_truth. Each is imaged by the signal equation of the
// phantom (phantom/mr_contrast.hpp) with coil bias and noise: T1; water and fat of a Dixon scan,
// with and without a tenth of the body in which they are exchanged, with all of it exchanged, and
// each alone; suppressed fat, which is not said, with muscle 4, 2, 1.4 and 1 times as bright, with and
// without a tenth in which suppression fails, and with T1 as second scan. --only leaves T1 and the
// cases named, and --side one of the two sides. Prints a row for each side: what the scan was taken
// for, errors of the wall and of the nipple (mm), gland (ml and Dice), breast (ml), where water and
// fat were found exchanged (% of the breast), the evidence of saturation and the silent share
// (contrast/evidence.hpp), or why it was refused.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <functional>
#include <string>

#include "core/error.hpp"
#include "fixtures/label_truth.hpp"
#include "io/volume_file.hpp"
#include "phantom/random.hpp"
#include "phantom/scanner.hpp"
#include "segment/grid/filters.hpp"
#include "segment/grid/grid_ops.hpp"

namespace breast {
namespace {

using namespace testing;

constexpr double bias = 3, noise_percent = 2;

Matter matter_of(int code) {
  switch (code) {
    case 0:
      return Matter::air;
    case 2:
      return Matter::skin;
    case 33:
      return Matter::nipple;
    case 29:
    case tumour:
      return Matter::gland;
    case 40:
      return Matter::muscle;
    case 60:
      return Matter::brawn;
    case 61:
      return Matter::lung;
    case 62:
      return Matter::heart;
    case 88:
      return Matter::ligament;
    case 150:
      return Matter::blood;
    default:
      return Matter::fat;
  }
}

/// An anatomy placed in the coil of the phantom, and its place in the patient.
struct Anatomy {
  Volume<float> truth;
  PhantomImage image;
  Volume<float> coil;
  double midline = 0;

  explicit Anatomy(const std::string& file) : truth(in_patient_order(read_volume(file))) {
    constexpr double blur = 0.4, front = -110;  // mm
    const Grid& grid = truth.grid;
    image.signal = Volume<float>(grid);
    image.parts = {image.signal, image.signal};
    image.tissue.resize(grid.voxels());
    image.side.resize(grid.voxels());
    int first = grid.size[1];
    midline = grid.to_patient(Vec3(0.5 * grid.size[0], 0, 0))[0];
    for (int k = 0; k < grid.size[2]; ++k) {
      for (int j = 0; j < grid.size[1]; ++j) {
        for (int i = 0; i < grid.size[0]; ++i) {
          const std::size_t n = grid.offset(i, j, k);
          const int code = int(std::lround(truth.voxels[n]));
          if (code != 0) first = std::min(first, j);
          WaterFat part = matter_water_fat(matter_of(code));
          if (code == half_gland) {
            const WaterFat gland = matter_water_fat(Matter::gland);
            part = {0.5 * (part.water + gland.water), 0.5 * (part.fat + gland.fat)};
          }
          image.parts.water.voxels[n] = float(part.water);
          image.parts.fat.voxels[n] = float(part.fat);
          image.tissue[n] = std::uint8_t(tissue_of(code));
          image.side[n] = i < grid.size[0] / 2 ? 2 : 1;
        }
      }
    }
    image.parts = {gaussian(image.parts.water, blur), gaussian(image.parts.fat, blur)};
    for (std::size_t n = 0; n < grid.voxels(); ++n)
      image.signal.voxels[n] = image.parts.water.voxels[n] + image.parts.fat.voxels[n];
    // The coil of the phantom stands around breasts that end 110 mm in front of its origin.
    image.signal.grid.origin =
        Vec3(-0.5 * grid.size[0] * grid.spacing[0], front - first * grid.spacing[1],
             -0.5 * grid.size[2] * grid.spacing[2]);
    coil = coil_sensitivity(image, bias, 5);
  }

  /// Scanned, in the place of the patient.
  Volume<float> scanned(const Volume<float>& signal, std::uint64_t seed, int number = 0) const {
    const Volume<std::int16_t> seen = magnitude(signal, coil, noise_percent, seed, number);
    Volume<float> out(truth.grid);
    out.voxels.assign(seen.voxels.begin(), seen.voxels.end());
    return out;
  }
};

struct Case {
  std::string name;
  std::function<Volume<float>(const Anatomy&, SegmentOptions&, std::uint64_t)> scan;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back({"T1", [](const Anatomy& a, SegmentOptions&, std::uint64_t seed) {
                   return a.scanned(a.image.signal, seed);
                 }});
  for (const double failed : {0.0, 0.1}) {
    all.push_back({failed > 0 ? "water + fat, 10 % exchanged" : "water + fat",
                   [failed](const Anatomy& a, SegmentOptions& options, std::uint64_t seed) {
                     const SignalImages shown =
                         exchanged(a.image.parts, failing_region(a.image.signal, failed, seed));
                     options.fat = a.scanned(shown.fat, seed, 1);
                     return a.scanned(shown.water, seed);
                   }});
  }
  all.push_back({"fat + water", [](const Anatomy& a, SegmentOptions& options, std::uint64_t seed) {
                   options.fat = a.scanned(a.image.parts.water, seed, 1);
                   return a.scanned(a.image.parts.fat, seed);
                 }});
  all.push_back({"water alone", [](const Anatomy& a, SegmentOptions&, std::uint64_t seed) {
                   return a.scanned(a.image.parts.water, seed);
                 }});
  all.push_back({"fat alone", [](const Anatomy& a, SegmentOptions&, std::uint64_t seed) {
                   return a.scanned(a.image.parts.fat, seed);
                 }});
  for (const double ratio : {4.0, 2.0, 1.4, 1.0}) {
    for (const double failed : {0.0, 0.1}) {
      all.push_back({message("suppressed ", ratio, failed > 0 ? ", 10 % failed" : ""),
                     [ratio, failed](const Anatomy& a, SegmentOptions&, std::uint64_t seed) {
                       return a.scanned(saturated(a.image.parts, fat_left(ratio),
                                                  failing_region(a.image.signal, failed, seed)),
                                        seed);
                     }});
    }
    all.push_back({message("suppressed ", ratio, " beside T1"),
                   [ratio](const Anatomy& a, SegmentOptions& options, std::uint64_t seed) {
                     options.also = a.scanned(a.image.signal, seed, 2);
                     return a.scanned(saturated(a.image.parts, fat_left(ratio), {}), seed);
                   }});
  }
  return all;
}

double gland_ml(const LabelVolume& labels) {
  double sum = 0;
  for (const float share : labels.fibroglandular_fraction) sum += share;
  return sum * labels.grid.voxel_volume() / 1000;
}

double breast_ml(const LabelVolume& labels) {
  double count = 0;
  for (const std::uint8_t code : labels.tissue) count += is_breast(Tissue(code));
  return count * labels.grid.voxel_volume() / 1000;
}

void print_row(const Segmentation& result, const Anatomy& anatomy, const Vec3& nipple_in_t1) {
  const auto walls = wall_scores(result, anatomy.truth);
  std::printf("%s\t%.2f\t%.2f\t%.1f\t%.0f\t%.3f\t%.0f\t%.2f\t%.0f\t%.0f\t%.2f\t%.3f\t",
              std::string(contrast_name(result.kind)).c_str(), walls[0].mean(),
              percentile(walls[0].error, 0.95, 0),
              (result.labels.landmarks.at("nipple") - nipple_in_t1).norm(), gland_ml(result.labels),
              gland_dice(result.labels, anatomy.truth, result.midline_mm), breast_ml(result.labels),
              result.exchanged_percent, result.unsuppressed_ml, walls[0].coverage(),
              saturation_evidence(result.contrast), result.contrast.silent_share);
  for (const std::string& doubt : result.doubts) std::printf("%s; ", doubt.c_str());
  std::printf("\n");
  std::fflush(stdout);
}

void run(const std::string& file, const std::vector<Side>& sides,
         const std::vector<std::string>& only) {
  const Anatomy anatomy(file);
  const std::string name = std::filesystem::path(file).filename().string();
  for (const Side side : sides) {
    Vec3 nipple = Vec3::Zero();
    for (const Case& one : cases()) {
      if (!only.empty() && one.name != "T1" &&
          std::find(only.begin(), only.end(), one.name) == only.end())
        continue;
      SegmentOptions options;
      options.side = side;
      // The region that fails lies on the side that is segmented.
      const Volume<float> scan = one.scan(anatomy, options, side == Side::left ? 3 : 4);
      std::printf("%s\t%s\t%s\t", name.c_str(), std::string(side_name(side)).c_str(),
                  one.name.c_str());
      Timer timer;
      try {
        const Segmentation result = segment_breast(scan, options, no_progress(), timer);
        if (one.name == "T1") nipple = result.labels.landmarks.at("nipple");
        print_row(result, anatomy, nipple);
      } catch (const Error& error) {
        std::printf("refused\t\t\t\t\t\t\t\t\t\t\t\t%s\n", error.what());
        std::fflush(stdout);
      }
    }
  }
}

}  // namespace
}  // namespace breast

int main(int argc, char** argv) {
  try {
    std::vector<std::string> files, only;
    std::vector<breast::Side> sides{breast::Side::left, breast::Side::right};
    for (int n = 1; n < argc; ++n) {
      const std::string word = argv[n];
      if (word == "--only" && n + 1 < argc) {
        only.emplace_back(argv[++n]);
      } else if (word == "--side" && n + 1 < argc) {
        sides = {breast::side_from_name(argv[++n])};
      } else {
        files.push_back(word);
      }
    }
    if (files.empty())
      throw breast::input_error(
          "usage: bench_segment_contrasts TRUTH... [--side left|right] [--only CASE]");
    std::printf(
        "truth\tside\tscan\ttaken_for\twall_mean\twall_p95\tnipple_mm\tgland_ml\tgland_dice\t"
        "breast_ml\texchanged\tunsuppressed_ml\tin_band\tevidence\tsilent\tmessages\n");
    for (const std::string& file : files) breast::run(file, sides, only);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "bench_segment_contrasts: %s\n", error.what());
    return 1;
  }
}
