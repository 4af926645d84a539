// SPDX-License-Identifier: GPL-3.0-or-later
// calibrate-softness: the material set with which a cohort moves as women's breasts do.
#include "calibration/softness.hpp"
#include "cli/tool.hpp"
#include "contact/options.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"
#include "io/mesh_file.hpp"
#include "material/material_table.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path set, women, pressed;
  std::vector<std::filesystem::path> cohort;
  std::string from = "seed2008";
  SoftnessData data;  // with its defaults
  std::vector<double> expected, pressure;
  double kept = 5, smoothing = 0.02, prestretch = 3;
  CompressionChoices press;

  Choices() {
    const Softness& s = data.expected;
    expected = {100 * s.low_order, 100 * s.quadratic, 100 * s.skin, s.wall, s.cut};
    pressure = {data.pressure.mean, data.pressure.sd};
    press.reduction = 50;
    press.image_edge = "auto";
  }
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Finds how soft fat and fibroglandular tissue are (linear and quadratic terms of the law "
      "apart), how stiff the skin is, and what resists sliding along the chest wall and at the cut, "
      "such that the breasts of a cohort move from prone to supine as women's do on average: the "
      "nipple's lateral and posterior motion, the tissue's change of distance from the ribs. The "
      "nipple's motion along the body is not used: it depends on where the arms lie. A further "
      "breast is pressed between plates (CC), whose mean pressure is to be the clinic's. Least "
      "squares in the logarithms, with a prior of a factor of three about --expected; the covariance "
      "of what the data leave open is written with the set.");
  tool.cite("Pathmanathan et al. 2008, equation (9) and Table II, scaled");
  tool.output_file(c.set, "--set", "OUT.tsv", "the material set found").required("--set");
  tool.inputs(c.cohort, "MESH.vtkhdf", "meshes of breasts imaged prone (hexmesh)");
  tool.input_file(c.women, "--women", "TABLE.tsv", "columns quantity, mean, sd of living women")
      .required("--women");
  tool.input_file(c.pressed, "--pressed", "MESH.vtkhdf", "mesh of the breast to press")
      .required("--pressed");
  tool.text(c.from, "--from", "NAME|FILE", "set whose constants are scaled");
  tool.numbers(c.expected, "--expected", "LOW,QUADRATIC,SKIN,WALL,CUT", 5,
               "middle of the prior: three times per cent, then kPa/mm twice");
  tool.number(c.data.expected_ln_sd, "--expected-ln-sd", "LN",
              "its standard deviation, of the logarithm", 0.01, 10);
  tool.numbers(c.pressure, "--pressure", "MEAN,SD", 2, "of the paddle, kPa");
  tool.number(c.press.reduction, "--reduction", "PERCENT", "at this reduction of the thickness", 1,
              95);
  tool.text(c.press.image_edge, "--image-edge", "auto|MM",
            "and with plates that stand as in the clinic, as compress places them by this option");
  tool.number(c.data.muscle_mm, "--muscle", "MM", "thickness of the muscle in front of the ribs", 0,
              50);
  tool.number(c.kept, "--skin-compression", "PERCENT",
              "of the skin's law that is kept in compression", 0.1, 100);
  tool.number(c.smoothing, "--skin-smoothing", "WIDTH", "of its transition, squared stretches",
              1e-4, 0.5);
  tool.number(c.prestretch, "--skin-prestretch", "PERCENT", "stretch of the skin at rest", 0, 50);
  tool.check([&c] { compression_options(c.press, posture_gravity(Posture::upright)); });
  tool.example(
      "calibrate-softness --women women.tsv --pressed large.vtkhdf --set invivo.tsv a.vtkhdf b.vtkhdf",
      "from two breasts, and the pressure on a third");
}

Observed observed(const Table& women, const std::string& quantity) {
  for (std::size_t r = 0; r < women.rows.size(); ++r) {
    if (women.cell(r, "quantity") == quantity)
      return {quantity, women.number(r, "mean"), women.number(r, "sd")};
  }
  throw input_error(women.name, ": no quantity '", quantity, "'");
}

HexMesh prone_mesh(const std::filesystem::path& file) {
  HexMesh mesh = read_mesh(file, {.geometry = true});
  if (!mesh.geometry || !mesh.geometry->thorax) {
    throw input_error(file.string(),
                      ": it holds no wall surface to slide on; make geometry and mesh "
                      "again with fit-hermite and hexmesh");
  }
  return mesh;
}

void report_found(const SoftnessFound& found, Run& run) {
  Table table{{"what", "found", "wanted", "sd"}, {}};
  for (std::size_t k = 0; k < found.wanted.size(); ++k) {
    const Observed& wanted = found.wanted[k];
    table.rows.push_back({wanted.quantity, format_fixed(found.found[k], 2),
                          format_number(wanted.mean), format_fixed(wanted.sd, 2)});
    run.report().set("data/" + wanted.quantity + "/found", found.found[k]);
    run.report().set("data/" + wanted.quantity + "/wanted", wanted.mean);
    run.report().set("data/" + wanted.quantity + "/sd", wanted.sd);
  }
  for (std::size_t k = 0; k < Softness::names().size(); ++k) {
    const std::string name = Softness::names()[k];
    const double value = found.softness.values()[k],
                 sd = std::sqrt(found.fit.covariance(Eigen::Index(k), Eigen::Index(k)));
    table.rows.push_back(
        {name, format_number(value), "-", format_fixed(sd, 2) + " of the logarithm"});
    run.report().set("softness/" + name, value);
    run.report().set("softness/" + name + "_ln_sd", sd);
  }
  run.report().set("evaluations", found.fit.evaluations);
  run.report().set("converged", found.fit.converged);
  run.print(table.text());
}

void run_calibration(const Choices& c, Run& run) {
  const Table women = read_table(c.women);
  SoftnessData data = c.data;
  data.lateral = observed(women, "nipple_lateral_mm");
  data.posterior = observed(women, "nipple_posterior_mm");
  data.ribs_change = observed(women, "ribs_change_mm");
  data.pressure.mean = c.pressure[0], data.pressure.sd = c.pressure[1];
  data.press = compression_options(c.press, posture_gravity(Posture::upright));
  data.expected = {c.expected[0] / 100, c.expected[1] / 100, c.expected[2] / 100, c.expected[3],
                   c.expected[4]};
  for (const std::filesystem::path& file : c.cohort) data.cohort.push_back(prone_mesh(file));
  data.pressed = prone_mesh(c.pressed);
  MaterialSet base = load_materials(c.from);
  base.skin = {c.kept / 100, c.smoothing, c.prestretch / 100};
  check_skin(base.skin, "skin");
  const SoftnessFound found = calibrate_softness(base, data, run.progress());
  if (!found.fit.converged) run.warn("the calibration stopped before its parameters settled");
  write_table(c.set, material_table(found.materials));
  report_found(found, run);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("calibrate-softness", "a material set with which breasts move as women's do");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_calibration(c, run); });
}
