// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/cohort/cohort_table.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text/lists.hpp"
#include "core/text/one_line.hpp"
#include "study/cells.hpp"
#include "study/stage_report.hpp"
#include "study/summary.hpp"

namespace breast {

namespace fs = std::filesystem;

std::vector<CohortCase> read_cases(const fs::path& runs) {
  std::vector<CohortCase> cases;
  std::istringstream in(read_text(runs / ".cases"));
  for (std::string line; std::getline(in, line);) {
    CohortCase one{split(line, '\t').front(), "failed", "never started"};
    const fs::path file = runs / (one.name + ".status");
    if (fs::is_regular_file(file)) {
      const std::string text = read_text(file), first = text.substr(0, text.find('\n'));
      one.status = first.substr(0, first.find('\t'));
      one.reason =
          first.find('\t') == std::string::npos ? "" : one_line(first.substr(first.find('\t') + 1));
      if (one.status == "running")
        one = {one.name, "failed",
               "ended without a message: it was killed, ran out of memory, lost its node, or is "
               "still running"};
    }
    cases.push_back(one);
  }
  return cases;
}

std::string far_motion(const Table& motion, const Table& women) {
  std::string first;
  int far = 0;
  for (std::size_t r = 0; r < motion.rows.size(); ++r) {
    for (const std::string& column : motion.columns) {
      const auto value = number_of(motion.cell(r, column)), mean = number_at(women, column, "mean"),
                 sd = number_at(women, column, "sd");
      if (!value || !mean || !sd || !(*sd > 0) || !(std::abs(*value - *mean) > 2 * *sd)) continue;
      if (far++ == 0)
        first = column + " " + motion.cell(r, column) + " (women " +
                cell_at(women, column, "mean") + ", sd " + cell_at(women, column, "sd") + ")";
    }
  }
  return far > 1 ? first + " and " + std::to_string(far - 1) + " more" : first;
}

std::vector<std::string> looks(const fs::path& run, const std::vector<Advice>& advice,
                               const Table& women) {
  std::vector<std::string> said;
  if (const std::size_t count = warnings_of(run, advice).size(); count > 0)
    said.push_back(std::to_string(count) + " warnings");
  const StageReport labels = StageReport::read(run / "labels.json");
  for (const std::string part : {"contrast", "wall", "extent", "tissue"})
    if (const auto grade = labels.number("quality/" + part); grade && *grade < 0.5)
      said.push_back("quality of " + part + " " + format_fixed(*grade, 2));
  if (const auto shape = StageReport::read(run / "mesh.json").number("min_scaled_jacobian");
      shape && *shape < 0.1)
    said.push_back("element shape " + format_fixed(*shape, 2));
  for (const std::string view : {"cc", "mlo"}) {
    const StageReport report = StageReport::read(run / (view + ".json"));
    if (!report.empty() && report.text("status") != "converged")
      said.push_back((view == "cc" ? "CC " : "MLO ") + one_line(report.text("status")));
  }
  if (const auto motion = table_if_any(run / "motion.tsv"))
    if (const std::string far = far_motion(*motion, women); !far.empty()) said.push_back(far);
  return said;
}

Table cohort_table(const fs::path& runs, const std::vector<CohortCase>& cases,
                   const std::vector<Advice>& advice, const Table& women) {
  Table table{{"case", "status", "volume_ml", "min_scaled_jacobian", "supine_nipple_mm",
               "supine_tumour_mm", "tumour", "cc_thickness_mm", "cc_force_N", "mlo_thickness_mm",
               "mlo_force_N", "look", "log", "reason"},
              {}};
  for (const CohortCase& one : cases) {
    const fs::path run = runs / one.name;
    const StageReport mesh = StageReport::read(run / "mesh.json"),
                      cc = StageReport::read(run / "cc.json"),
                      mlo = StageReport::read(run / "mlo.json");
    const auto displacements = table_if_any(run / "displacements.tsv");
    const auto moved = [&](const char* column) {
      return displacements ? cell_or_dash(cell_at(*displacements, "supine.vtkhdf", column))
                           : no_value;
    };
    const auto of = [](const StageReport& report, const char* key, int decimals) {
      return fixed_cell(report.number(key), decimals);
    };
    table.rows.push_back({one.name, one.status, of(mesh, "volume_ml", 0),
                          of(mesh, "min_scaled_jacobian", 2), moved("nipple_mm"),
                          moved("tumour_mm"), tumour_origin(mesh), of(cc, "thickness_mm", 1),
                          of(cc, "force_N", 1), of(mlo, "thickness_mm", 1), of(mlo, "force_N", 1),
                          cell_or_dash(join(looks(run, advice, women), "; ")), one.name + ".log",
                          cell_or_dash(one.reason)});
  }
  std::stable_partition(table.rows.begin(), table.rows.end(),
                        [](const Row& row) { return row[1] != "done"; });
  return table;
}

Table cohort_cost(const fs::path& runs, const std::vector<CohortCase>& cases) {
  Table table{{"case", "elements", "wall_seconds", "cpu_seconds", "peak_mb"}, {}};
  for (const CohortCase& one : cases) {
    std::vector<fs::path> files;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(runs / one.name, ignored))
      if (entry.path().extension() == ".json") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    double elements = 0, wall = 0, cpu = 0, peak = 0;
    for (const fs::path& file : files) {
      const StageReport report = StageReport::read(file);
      wall += report.number("seconds/total").value_or(0);
      cpu += report.number("cpu_seconds").value_or(0);
      peak = std::max(peak, report.number("peak_mb").value_or(0));
      if (elements == 0) elements = report.first("elements").value_or(0);
    }
    table.rows.push_back({one.name, format_fixed(elements, 0), format_fixed(wall, 0),
                          format_fixed(cpu, 0), format_fixed(peak, 0)});
  }
  return table;
}

CaseCost case_cost(const Table* measured, const Table& assumed, int cores,
                   const std::string& element, double size) {
  constexpr double times_longer = 3, times_more = 1.5, least_minutes = 5, least_mb = 256;
  const auto asked = [&](double seconds, double mb, const std::string& source) {
    return CaseCost{int(least_minutes + times_longer * seconds / 60),
                    int(least_mb + times_more * mb), source};
  };
  int count = 0;
  double seconds = 0, mb = 0;
  for (std::size_t r = 0; measured != nullptr && r < measured->rows.size(); ++r) {
    const double cpu = measured->number(r, "cpu_seconds");
    count += cpu > 0 ? 1 : 0;
    seconds = std::max({seconds, measured->number(r, "wall_seconds"), cpu / cores});
    mb = std::max(mb, measured->number(r, "peak_mb"));
  }
  constexpr int enough_cases = 3;
  if (count >= enough_cases)
    return asked(seconds, mb,
                 message("the most expensive of ", count, " cases in cost.tsv: ", int(seconds),
                         " seconds, ", int(mb), " MB"));
  const auto known = number_at(assumed, element, "elements");
  if (!known) throw input_error(assumed.name, ": contains no cost of element '", element, "'");
  const double ratio = std::max(1.0, size / *known);
  seconds = number_at(assumed, element, "cpu_seconds").value_or(0) * std::pow(ratio, 4);
  mb = number_at(assumed, element, "peak_mb").value_or(0) * std::pow(ratio, 3);
  return asked(seconds, mb,
               message("pipelines/cohort-cost.tsv, ", element, ", ELEMENTS=", int(size), ": about ",
                       int(seconds), " CPU seconds, ", int(mb), " MB"));
}

}  // namespace breast
