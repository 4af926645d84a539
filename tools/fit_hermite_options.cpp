// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit_hermite_options.hpp"

#include <cctype>
#include <cstdlib>

#include "core/error.hpp"

namespace breast {

namespace {

/// "10x12" -> patches along s (x) and t (z); auto: as many as the bound on the largest distance
/// requires.
void parse_elements(const std::string& text, FitOptions& options) {
  if (text == "auto") {
    options.most_patches = 15;
    return;
  }
  char* end = nullptr;
  const long s = std::strtol(text.c_str(), &end, 10);
  const bool cross = *end == 'x' || *end == 'X';
  const long t = cross && std::isdigit(static_cast<unsigned char>(end[1]))
                     ? std::strtol(end + 1, &end, 10)
                     : 0;
  if (!cross || *end != 0 || s < 3 || s > 40 || t < 3 || t > 40)
    throw input_error("--elements ", text,
                      ": must be auto or AxB with A and B in 3..40, such as 10x10");
  options.patches_s = int(s);
  options.patches_t = int(t);
}

void parse_smoothing(const std::string& text, FitOptions& options) {
  options.smoothing = 0;
  if (text == "auto") return;
  char* end = nullptr;
  options.smoothing = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || *end != 0 || !(options.smoothing > 0 && options.smoothing <= 1))
    throw input_error("--smoothing ", text,
                      ": must be auto or a number above 0 and at most 1 "
                      "(automatic choices lie between 1e-9 and 1e-6)");
}

}  // namespace

FitOptions FitChoices::options() const {
  FitOptions options;
  parse_elements(elements, options);
  parse_smoothing(smoothing, options);
  options.max_error_mm = max_error.value_or(0);
  return options;
}

void declare_fit_hermite(Tool& tool, FitChoices& choices) {
  tool.describe(
      "Fits two bicubic Hermite sheets, larger than the body, to the skin and to the front of "
      "the chest wall, and finds the rim: the closed curve at which the breast ends and a "
      "straight cut joins the sheets. The skin need not be a height field over the chest wall, "
      "since it is first mapped to a square. The fit alternates between closest-point "
      "projection and linear least squares, smoothed by a penalty on second derivatives.");
  tool.cite("Pathmanathan et al., IEEE Trans Biomed Eng 55(10), 2008, section II-A")
      .cite(
          "Yoshizawa, Belyaev, Seidel, Proc. Shape Modeling International, 2004 (map to the "
          "square)");
  tool.input(choices.labels, "LABELS.vtkhdf",
             "labels of one breast (segment), a segmentation of 3D Slicer (.seg.nrrd) or a "
             "label volume (.nrrd, .nii, .mha)");
  tool.output(choices.geometry, "GEOMETRY.vtkhdf", "geometry: the two sheets and the rim");
  tool.text(choices.elements, "--elements", "AxB|auto",
            "number of patches of each sheet along x and z; auto takes 10x10, and up to 15x15 "
            "for a skin that would otherwise be more than 2 mm off");
  tool.text(choices.smoothing, "--smoothing", "S|auto",
            "weight of the skin sheet's squared second derivatives (in mm, for parameters from "
            "0 to 1); auto lowers it until the rms distance to the skin is 0.3 mm");
  tool.number(choices.max_error, "--max-error", "MM",
              "refine the skin sheet until no point of the skin is farther from it than this", 0.05,
              100);
  declare_label_choices(tool, "fit-hermite", choices.foreign);
  tool.basic({"--elements", "--smoothing", "--max-error"});
  tool.example("fit-hermite labels.vtkhdf geometry.vtkhdf",
               "10 x 10 patches or a few more, automatic smoothing");
  tool.example("fit-hermite labels.vtkhdf geometry.vtkhdf --max-error 1",
               "as many patches as are needed to stay within 1 mm");
  tool.example("fit-hermite edited.seg.nrrd geometry.vtkhdf --native labels.vtkhdf",
               "labels corrected in 3D Slicer");
  tool.check([&choices] {
    choices.options();
    parse_tissue_codes(choices.foreign.codes);
  });
}

}  // namespace breast
