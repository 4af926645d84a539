// SPDX-License-Identifier: GPL-3.0-or-later
// population: the motion of breasts between postures, beside measurements on women.
#include <algorithm>
#include <cmath>
#include <map>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "evaluation/posture_motion.hpp"
#include "evaluation/spread.hpp"
#include "io/mesh_file.hpp"

using namespace breast;

namespace {

constexpr int decimals = 1;

struct Choices {
  std::vector<std::filesystem::path> meshes;
  std::filesystem::path table, women, summary;
  double muscle = 8;
};

using Quantities = std::vector<MotionQuantity>;

/// Mean, standard deviation and range of every quantity, beside the values of women.
Table summary_of(const std::vector<Quantities>& cases, const Choices& c) {
  std::map<std::string, std::size_t> women_row;
  Table women;
  if (!c.women.empty()) {
    women = read_table(c.women);
    for (std::size_t r = 0; r < women.rows.size(); ++r) women_row[women.cell(r, "quantity")] = r;
  }
  Table table{
      {"quantity", "mean", "sd", "lowest", "highest", "women_mean", "women_sd", "within_one_sd"},
      {}};
  for (std::size_t q = 0; q < cases.front().size(); ++q) {
    std::vector<Weighted> values;
    for (const Quantities& one : cases) values.push_back({one[q].value, one[q].weight});
    const Spread found = spread(values);
    const std::string& name = cases.front()[q].name;
    std::vector<std::string> row{
        name, format_fixed(found.mean, decimals), format_fixed(found.sd, decimals),
        format_fixed(found.low, decimals), format_fixed(found.high, decimals)};
    const auto known = women_row.find(name);
    if (known == women_row.end()) {
      row.insert(row.end(), {"-", "-", "-"});
    } else {
      const double centre = women.number(known->second, "mean"),
                   spread = women.number(known->second, "sd");
      row.insert(row.end(), {format_number(centre), format_number(spread),
                             std::abs(found.mean - centre) <= spread ? "yes" : "no"});
    }
    table.rows.push_back(row);
  }
  return table;
}

void run_population(const Choices& c, Run& run) {
  std::vector<Quantities> cases;
  Table table{{"case", "side"}, {}};
  for (const std::filesystem::path& file : c.meshes) {
    const HexMesh mesh = read_mesh(file, {.reference = true, .geometry = true});
    try {
      cases.push_back(motion_quantities(posture_motion(mesh, c.muscle)));
    } catch (const Error& error) {
      throw Error(error.kind(), file.string() + ": " + error.what());
    }
    const std::string folder = file.parent_path().filename().string();
    std::vector<std::string> row{folder.empty() ? file.stem().string() : folder,
                                 std::string(side_name(mesh.side))};
    for (const MotionQuantity& one : cases.back()) {
      if (table.rows.empty()) table.columns.push_back(one.name);
      row.push_back(format_fixed(one.value, decimals));
    }
    table.rows.push_back(row);
  }
  const Table summary = summary_of(cases, c);
  for (std::size_t r = 0; r < summary.rows.size(); ++r) {
    run.report().set("population/" + summary.rows[r][0] + "/mean", summary.number(r, "mean"));
    run.report().set("population/" + summary.rows[r][0] + "/sd", summary.number(r, "sd"));
  }
  run.report().set("cases", cases.size());
  run.report().set("muscle_mm", c.muscle);
  if (!c.summary.empty()) write_table(c.summary, summary);
  if (c.table.empty()) {
    run.print(table.text());
  } else {
    write_table(c.table, table);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("population",
            "motion of breasts between postures, compared with measurements on "
            "women");
  tool.describe(
      "Tabulates the displacement from the scan for every deformed mesh: of the nipple along "
      "the axes of the body, and of the tissue as a volume-weighted function of its distance "
      "from the rib cage in the scan. The ribs are assumed to lie behind the chest-wall surface "
      "by the thickness of the muscle. The table has one row per breast; --summary gives the "
      "mean, standard deviation and range, beside the values of --women. In the mean over "
      "the tissue at some distance from the ribs, a breast is weighted by the fraction of its "
      "volume at that distance, as in a mean over landmarks.");
  tool.inputs(c.meshes, "FILE.vtkhdf", "deformed meshes (forward) that have a chest-wall surface");
  tool.output_file(c.table, "--table", "OUT.tsv",
                   "table with one row per breast (default: stdout)");
  tool.output_file(c.summary, "--summary", "OUT.tsv", "summary over all breasts");
  tool.input_file(c.women, "--women", "TABLE.tsv",
                  "measurements on living women, with columns quantity, mean, sd");
  tool.number(c.muscle, "--muscle", "MM", "thickness of the muscle in front of the ribs", 0, 50);
  tool.example(
      "population runs/*/supine.vtkhdf --women pipelines/invivo/women.tsv "
      "--summary motion.tsv",
      "prone to supine of all runs");
  return tool.main(argc, argv, [&c](Run& run) { run_population(c, run); });
}
