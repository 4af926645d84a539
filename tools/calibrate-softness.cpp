// SPDX-License-Identifier: GPL-3.0-or-later
// calibrate-softness: finds the material set with which a cohort moves as women's breasts do.
#include "cli/tool.hpp"
#include "contact/options.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"
#include "identification/calibration/softness.hpp"
#include "io/mesh_file.hpp"
#include "lineage/origin.hpp"
#include "lineage/pairs.hpp"
#include "material/material_set.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path set, women, pressed;
  std::vector<std::filesystem::path> cohort;
  std::string from = "seed2008";
  SoftnessData data;  // with its defaults
  Observed pressing = PressedBreast{}.pressure;
  std::vector<double> expected, pressure;
  std::optional<double> law_ln_sd;
  double kept = 5, smoothing = 0.02, prestretch = 3, corner_bulk = 0;
  CompressionChoices press;

  Choices() {
    const Softness& s = data.expected;
    expected = {100 * s.low_order, 100 * s.quadratic, 100 * s.skin};
    pressure = {pressing.mean, pressing.sd};
    press.reduction = 50;
    press.image_edge = "auto";
  }
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Calibrates a material set so that the breasts of a cohort move from prone to supine as "
      "women's breasts do on average. The parameters are the stiffness of fat and fibroglandular "
      "tissue (with separate factors for the linear and the quadratic terms of the law), the "
      "stiffness of the skin, and the numbers of the supports of chest wall and cut.");
  tool.describe(
      "The data are the rows of --women whose column `unmodelled_sd` holds a number: the standard deviation of "
      "what no model explains, such as the place of the arms, which is added to the standard error. Both breasts of "
      "one scan count as one woman. With --pressed, a further breast is "
      "compressed between plates (CC), and the mean pressure should agree with the clinical one. "
      "The fit is by least squares in the logarithms, with a prior of a factor of three about "
      "--expected, --wall and --cut; the remaining uncertainty is written with the set as a covariance. "
      "The report also has every breast's own quantities, and the fit without each woman in turn.");
  tool.cite("Pathmanathan et al. 2008, equation (9) and Table II, scaled");
  tool.output_file(c.set, "--set", "OUT.tsv", "the material set found").required("--set");
  tool.inputs(c.cohort, "MESH.vtkhdf", "meshes of breasts imaged prone (hexmesh)");
  tool.input_file(c.women, "--women", "TABLE.tsv",
                  "measurements on living women, with columns quantity, mean, sd, unmodelled_sd")
      .required("--women");
  tool.input_file(c.pressed, "--pressed", "MESH.vtkhdf", "mesh of a breast to compress");
  tool.text(c.from, "--from", "NAME|FILE", "material set whose constants are scaled");
  tool.numbers(c.expected, "--expected", "LOW,QUADRATIC,SKIN", 3,
               "centre of the prior of the laws, in percent of those of --from");
  tool.text(c.data.expected.wall, "--wall", "SUPPORT",
            "support of the chest wall as in forward; its numbers are the centre of the prior");
  tool.text(c.data.expected.cut, "--cut", "SUPPORT", "the same of the cut");
  tool.number(c.data.expected_ln_sd, "--expected-ln-sd", "LN",
              "standard deviation of the prior, in the logarithm", 0.01, 10);
  tool.number(c.law_ln_sd, "--law-ln-sd", "LN",
              "the same of LOW and QUADRATIC (default: that of the others)", 0.01, 10);
  tool.numbers(c.pressure, "--pressure", "MEAN,SD", 2,
               "clinical mean and standard deviation of the paddle's pressure, kPa");
  tool.number(c.press.reduction, "--reduction", "PERCENT",
              "reduction of the thickness at which the pressure is compared", 1, 95);
  tool.text(c.press.image_edge, "--image-edge", "auto|MM",
            "position of the plates, as in compress");
  tool.number(c.data.muscle_mm, "--muscle", "MM", "thickness of the muscle in front of the ribs", 0,
              50);
  tool.number(c.data.muscle_stiffness, "--muscle-stiffness", "FACTOR",
              "stiffness of muscle relative to fibroglandular tissue (default: the law of the set)",
              0.1, 1000);
  tool.number(c.corner_bulk, "--corner-bulk", "PA",
              "bulk modulus with which the corners of elements resist large changes of volume, "
              "for all tissues except skin",
              0, 1e9);
  tool.number(c.kept, "--skin-compression", "PERCENT",
              "share of the skin's stiffness that remains in compression", 0.1, 100);
  tool.number(c.smoothing, "--skin-smoothing", "WIDTH",
              "half the width of the skin's transition to wrinkling, in squared stretches", 1e-4,
              0.5);
  tool.number(c.prestretch, "--skin-prestretch", "PERCENT",
              "stretch of the skin in the stress-free shape of the body", 0, 50);
  tool.topic("prior", {"--expected", "--wall", "--cut", "--expected-ln-sd", "--law-ln-sd"});
  tool.topic("compression", {"--pressed", "--pressure", "--reduction", "--image-edge"});
  tool.topic("body", {"--muscle", "--muscle-stiffness", "--corner-bulk", "--skin-compression",
                      "--skin-smoothing", "--skin-prestretch"});
  tool.basic({"--pressed", "--from", "--expected", "--wall", "--cut", "--pressure", "--reduction"});
  tool.check([&c] {
    wall_support(c.data.expected.wall), cut_support(c.data.expected.cut);
    compression_options(c.press, posture_gravity(Posture::upright));
  });
  tool.example(
      "calibrate-softness --women women.tsv --pressed large.vtkhdf --set invivo.tsv a.vtkhdf b.vtkhdf",
      "from the motion of two breasts and the pressure on a third");
}

std::vector<Observed> fitted_rows(const Table& women) {
  std::vector<Observed> rows;
  for (std::size_t r = 0; r < women.rows.size(); ++r) {
    if (women.cell(r, "unmodelled_sd") == "-") continue;
    rows.push_back({women.cell(r, "quantity"), women.number(r, "mean"), women.number(r, "sd"),
                    women.number(r, "unmodelled_sd")});
  }
  if (rows.empty())
    throw input_error(women.name, ": no row has a number in the column unmodelled_sd");
  return rows;
}

HexMesh prone_mesh(const std::filesystem::path& file) {
  HexMesh mesh = read_mesh(file, {.geometry = true});
  if (!mesh.geometry || !mesh.geometry->thorax) {
    throw input_error(file.string(),
                      ": it has no chest-wall surface to slide on; run fit-hermite and hexmesh "
                      "again");
  }
  return mesh;
}

CohortBreast breast_in(const std::filesystem::path& file) {
  HexMesh mesh = prone_mesh(file);
  const std::string folder = file.parent_path().filename().string(),
                    name = folder.empty() ? file.stem().string() : folder,
                    scan = scan_behind(origin_of(file, mesh));
  return {name, scan.empty() ? name : scan, std::move(mesh)};
}

// Every breast's own quantities, and the fits without one woman.
void report_breasts(const SoftnessData& data, const SoftnessFound& found, Run& run) {
  for (std::size_t b = 0; b < found.of_breast.size(); ++b)
    for (std::size_t q = 0; q < data.motion.size(); ++q)
      run.report().set("breasts/" + data.cohort[b].name + "/" + data.motion[q].quantity,
                       found.of_breast[b][q]);
  for (const WithoutWoman& one : found.without) {
    const std::string at = "without/" + one.woman + "/";
    for (std::size_t k = 0; k < one.factors.size(); ++k)
      run.report().set(at + found.parameters[k].name + "_factor", one.factors[k]);
    for (std::size_t q = 0; q < one.predicted.size(); ++q)
      run.report().set(at + data.motion[q].quantity, one.predicted[q]);
  }
}

void report_found(const SoftnessData& c, const SoftnessFound& found, Run& run) {
  Table table{{"what", "found", "wanted", "sd"}, {}};
  for (std::size_t k = 0; k < found.wanted.size(); ++k) {
    const Observed& wanted = found.wanted[k];
    table.rows.push_back({wanted.quantity, format_fixed(found.found[k], 2),
                          format_number(wanted.mean), format_fixed(wanted.sd, 2)});
    run.report().set("data/" + wanted.quantity + "/found", found.found[k]);
    run.report().set("data/" + wanted.quantity + "/wanted", wanted.mean);
    run.report().set("data/" + wanted.quantity + "/sd", wanted.sd);
  }
  report_breasts(c, found, run);
  const Eigen::MatrixXd covariance = found.fit.covariance();
  for (std::size_t k = 0; k < found.parameters.size(); ++k) {
    const auto& [name, value] = found.parameters[k];
    const double sd = std::sqrt(covariance(Eigen::Index(k), Eigen::Index(k)));
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
  data.motion = fitted_rows(women);
  data.law_ln_sd = c.law_ln_sd.value_or(c.data.expected_ln_sd);
  data.expected.low_order = c.expected[0] / 100, data.expected.quadratic = c.expected[1] / 100;
  data.expected.skin = c.expected[2] / 100;
  for (const std::filesystem::path& file : c.cohort) data.cohort.push_back(breast_in(file));
  if (!c.pressed.empty()) {
    CompressionOptions press = compression_options(c.press, posture_gravity(Posture::upright));
    press.must_grip = false;  // a fit passes through sets with which the plates do not
    data.pressed = {prone_mesh(c.pressed), press, {"pressure_kPa", c.pressure[0], c.pressure[1]}};
  }
  MaterialSet base = load_materials(c.from);
  base.skin = {c.kept / 100, c.smoothing, c.prestretch / 100};
  check_skin(base.skin, "skin");
  if (c.corner_bulk > 0) {
    base.corner_bulk.fill(c.corner_bulk);
    base.corner_bulk[std::size_t(Tissue::skin)] = 0;
  }
  const SoftnessFound found = calibrate_softness(base, data, run.progress());
  if (!found.fit.converged) run.warn("the calibration stopped before its parameters settled");
  write_table(c.set, material_table(found.materials));
  report_found(data, found, run);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("calibrate-softness", "a material set with which breasts move as women's do");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_calibration(c, run); });
}
