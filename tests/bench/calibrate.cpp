// SPDX-License-Identifier: GPL-3.0-or-later
// calibrate: fits a phantom to given landmark displacements.
#include <array>

#include "bench/phantom_fit.hpp"
#include "cli/tool.hpp"
#include "core/error.hpp"
#include "core/table.hpp"

using namespace breast;

namespace {

struct Choices {
  std::string preset = "paper", side = "left", materials = "seed2008";
  std::vector<double> supine{8.8, 3.0}, free{4.5, 1.6}, gain{1, 1};
  int seed = 1, evaluations = 10;
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Fits a phantom to given displacements of its nipple and tumour from the prone to the "
      "supine and to the stress-free shape. The parameters are the size of the breast and the "
      "position of the tumour. The given displacements are results of the chain; --gain is their "
      "ratio to the phantom's own displacements, which is measured once. The fit is by least squares with BOBYQA "
      "(NLopt) on a coarse phantom mesh. The tool prints the parameters for the preset with the "
      "bounds of the search, and warns if a parameter lies on a bound.");
  tool.cite("Pathmanathan et al. 2008, Tables III and IV: 8.8 and 3.0 mm, 4.5 and 1.6 mm")
      .cite("Powell 2009, The BOBYQA algorithm, DAMTP 2009/NA06; Johnson, NLopt");
  tool.choice(c.preset, "--preset", preset_names(), "kind of breast");
  tool.integer(c.seed, "--seed", "N", "seed of the phantom: another breast of the same kind", 0,
               1000000000);
  tool.choice(c.side, "--side", {"left", "right"}, "which breast");
  tool.numbers(c.supine, "--supine", "NIPPLE,TUMOUR", 2,
               "target displacements from prone to supine, mm");
  tool.numbers(c.free, "--stress-free", "NIPPLE,TUMOUR", 2,
               "target displacements from prone to stress-free, mm");
  tool.numbers(c.gain, "--gain", "NIPPLE,TUMOUR", 2,
               "ratio of the chain's displacement to the phantom's, measured on a finished case");
  tool.text(c.materials, "--materials", "NAME|FILE", "material set of the breasts");
  tool.integer(c.evaluations, "--evaluations", "N", "largest number of trial breasts", 4, 1000);
  tool.check([&c] {
    if (!preset_slides(c.preset)) return;
    throw input_error("--preset ", c.preset,
                      ": its breasts slide on their ribs, and trial breasts here are held; ",
                      "choose paper, flat, small, large or pendulous");
  });
  tool.example("calibrate --preset paper --gain 1.28,1.39",
               "the paper's displacements, for a chain whose displacements are 28 and 39 % "
               "larger than the phantom's");
}

void run_calibrate(const Choices& c, Run& run) {
  LandmarkMotion wanted{c.supine[0] / c.gain[0], c.supine[1] / c.gain[1], c.free[0] / c.gain[0],
                        c.free[1] / c.gain[1]};
  const Calibration found =
      calibrate(c.preset, std::uint64_t(c.seed), side_from_name(c.side), wanted,
                load_materials(c.materials), {4, 2, 1, 1, 3, 2}, c.evaluations, run.progress());
  Table table{{"what", "wanted", "found", "lowest", "highest"}, {}};
  const auto row = [&](const std::string& what, double want, double have) {
    table.rows.push_back({what, format_fixed(want, 3), format_fixed(have, 3), "-", "-"});
    run.report().set("motion/" + what, have);
  };
  row("nipple_supine_mm", wanted.nipple_supine, found.motion.nipple_supine);
  row("tumour_supine_mm", wanted.tumour_supine, found.motion.tumour_supine);
  row("nipple_stress_free_mm", wanted.nipple_free, found.motion.nipple_free);
  row("tumour_stress_free_mm", wanted.tumour_free, found.motion.tumour_free);
  const std::array values = {found.size, found.tumour_aside, found.tumour_level};
  for (std::size_t k = 0; k < values.size(); ++k) {
    const FittedParameter& fitted = fitted_parameters()[k];
    table.rows.push_back({fitted.name, "-", format_fixed(values[k], 4), format_number(fitted.low),
                          format_number(fitted.high)});
    run.report().set(fitted.name, values[k]);
  }
  for (const std::string& bound : found.on_bounds()) run.warn(bound);
  table.rows.push_back({"misfit_mm", "-", format_fixed(found.misfit_mm, 4), "-", "-"});
  run.report().set("misfit_mm", found.misfit_mm);
  run.report().set("evaluations", found.evaluations);
  run.print(table.text());
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("calibrate", "fit a phantom's size to given landmark displacements");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_calibrate(c, run); });
}
