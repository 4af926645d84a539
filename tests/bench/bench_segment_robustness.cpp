// What noise, coil bias, thick slices, turned axes and cut fields of view do to a segmentation.
//
//     bench_segment_robustness MR left|right [CASE]      all cases, or the one of that name
//
// Prints one row per perturbation: the result compared with that of the unchanged scan.
#include <chrono>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "evaluation/overlap.hpp"
#include "evaluation/wall_distance.hpp"
#include "fixtures/perturbed_scan.hpp"
#include "io/volume_file.hpp"
#include "segment/segment.hpp"

namespace breast {
namespace {

void print_row(const std::string& name, double seconds, const Segmentation& result,
               const Segmentation& base) {
  const LabelOverlap overlap = compare_labels(result.labels, base.labels);
  const WallDistance wall = compare_walls(result.labels, base.labels);
  const double nipple =
      (result.labels.landmarks.at("nipple") - base.labels.landmarks.at("nipple")).norm();
  std::string doubts;
  for (const std::string& doubt : result.doubts) doubts += "; " + doubt;
  std::printf("%s\t%.1f\t%.4f\t%.4f\t%.2f\t%.2f\t%.2f\t%.3f\t%s\n", name.c_str(), seconds,
              overlap.breast.dice, overlap.tissue[int(Tissue::fibroglandular)].dice,
              wall.distance.mean_mm, wall.distance.p95_mm, nipple, result.bias_cv_after,
              doubts.empty() ? "" : doubts.c_str() + 2);
  std::fflush(stdout);
}

int run(const std::string& file, Side side, const std::string& only) {
  const Volume<float> scan = read_volume(file);
  std::optional<Segmentation> base;
  std::printf(
      "case\tseconds\tbreast_dice\tfibroglandular_dice\twall_mean_mm\twall_p95_mm\t"
      "nipple_mm\tfat_cv\tmessages\n");
  for (const auto& perturbation : testing::perturbations(side == Side::left)) {
    if (base && !only.empty() && perturbation.name != only) continue;
    SegmentOptions options;
    options.side = side;
    const auto start = std::chrono::steady_clock::now();
    try {
      Timer timer;
      const Segmentation result =
          segment_breast(perturbation.apply(scan), options, no_progress(), timer);
      const double seconds =
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (!base) base = result;
      print_row(perturbation.name, seconds, result, *base);
    } catch (const Error& error) {
      if (!base) throw;
      std::printf("%s\t\t\t\t\t\t\t\trefused: %s\n", perturbation.name.c_str(), error.what());
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
