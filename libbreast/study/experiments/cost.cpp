// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/experiments/cost.hpp"

#include "core/text/lists.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

struct Point {
  std::string name;
  fs::path reference, supine;  ///< without file extension
  StageReport backward, forward;
};

fs::path with(const fs::path& name, const char* ending) {
  return name.string() + ending;
}

Point read_point(const fs::path& folder, const std::string& name) {
  const fs::path reference = folder / name / "reference", supine = folder / name / "supine";
  return {name, reference, supine, StageReport::read(with(reference, ".json")),
          StageReport::read(with(supine, ".json"))};
}

double sum_of(const Point& point, const char* key) {
  return point.backward.number(key).value_or(0) + point.forward.number(key).value_or(0);
}

}  // namespace

std::optional<double> carried_estimate(const StageReport& backward, const StageReport& forward) {
  const auto first = backward.number("error_estimate_mm"),
             second = forward.number("error_estimate_mm");
  if (!first || !second) return {};
  return *first + *second;
}

Table cost_table(const fs::path& folder, const std::string& finest,
                 const std::vector<std::string>& points, const ShapeReader& read) {
  Table table{{"point", "element", "template", "solver", "elements", "unknowns",
               "newton_iterations", "cpu_s", "wall_s", "peak_mb", "stress_free_error_mm",
               "supine_error_mm", "stress_free_estimate_mm", "supine_estimate_mm"},
              {}};
  for (const std::string& name : points) {
    const std::vector<std::string> parts = split(name, '-');
    Row row{name, parts[0], parts.size() > 1 ? parts[1] : no_value,
            parts.size() > 3 ? parts[3] : "auto"};
    if (posture_failure_of(folder / name)) {
      row.resize(table.columns.size(), no_value);
      table.rows.push_back(row);
      continue;
    }
    const Point p = read_point(folder, name), best = read_point(folder, finest);
    const auto error = [&](const fs::path& here, const fs::path& there) {
      return format_fixed(most_apart(read, with(here, ".vtkhdf"), with(there, ".vtkhdf")), 4);
    };
    row.insert(
        row.end(),
        {p.forward.text("elements"), p.forward.text("unknowns"),
         p.backward.text("newton_iterations") + "+" + p.forward.text("newton_iterations"),
         format_fixed(sum_of(p, "cpu_seconds"), 2), format_fixed(sum_of(p, "seconds/total"), 2),
         fixed_cell(p.backward.number("peak_mb"), 0), error(p.reference, best.reference),
         error(p.supine, best.supine), fixed_cell(p.backward.number("error_estimate_mm"), 4),
         fixed_cell(carried_estimate(p.backward, p.forward), 4)});
    table.rows.push_back(row);
  }
  return table;
}

std::optional<Row> accuracy_row(const fs::path& folder, const std::string& point,
                                const std::string& coarser, double wanted,
                                const ShapeReader& read) {
  if (posture_failure_of(folder / point)) return {};
  const Point p = read_point(folder, point);
  std::optional<double> stress_free, supine;
  if (!point.starts_with("q2p1")) {
    stress_free = p.backward.number("error_estimate_mm");
    supine = carried_estimate(p.backward, p.forward);
  } else if (!coarser.empty()) {
    const Point before = read_point(folder, coarser);
    stress_free = most_apart(read, with(p.reference, ".vtkhdf"), with(before.reference, ".vtkhdf"));
    supine = most_apart(read, with(p.supine, ".vtkhdf"), with(before.supine, ".vtkhdf"));
  }
  const bool meets = stress_free && supine && *stress_free <= wanted && *supine <= wanted;
  return Row{point,
             p.forward.text("elements"),
             fixed_cell(stress_free, 4),
             fixed_cell(supine, 4),
             format_fixed(sum_of(p, "cpu_seconds"), 2),
             meets ? "yes" : "no"};
}

namespace {

// The cells of one view of a mesh: distance of the tumour from its position on the finest mesh and
// the estimate of this distance, mm; distance of the nipple, mm; forces of paddle and detector, N;
// reduction of the thickness, per cent.
Row converging_view(const fs::path& name, const fs::path& finest, const ShapeReader& read) {
  if (!fs::exists(with(name, ".vtkhdf"))) return Row(6, no_value);
  const StageReport report = StageReport::read(with(name, ".json"));
  const auto to_finest = [&](const char* landmark) {
    return fs::exists(finest)
               ? format_fixed(apart_at(read, with(name, ".vtkhdf"), finest, landmark), 2)
               : no_value;
  };
  const auto estimate =
      report.number("landmarks/" + report.landmark("tumour") + "/error_estimate_mm");
  return {to_finest("tumour"),
          fixed_cell(estimate, 2),
          to_finest("nipple"),
          fixed_cell(report.number("force_N"), 1),
          fixed_cell(report.number("detector_force_N"), 1),
          fixed_cell(report.number("reduction_percent"), 0)};
}

}  // namespace

Table convergence_table(const fs::path& folder, const std::vector<std::string>& meshes,
                        const ShapeReader& read) {
  Table table{{"N", "elements"}, {}};
  for (const std::string view : {"CC", "MLO"})
    for (const char* quantity : {"tumour_mm", "tumour_estimate_mm", "nipple_mm", "paddle_N",
                                 "detector_N", "reduction_percent"})
      table.columns.push_back(view + "_" + quantity);
  for (const std::string& n : meshes) {
    Row row{n, cell_or_dash(StageReport::read(folder / n / "mesh.json").text("elements"))};
    for (const std::string view : {"cc", "mlo"}) {
      const Row cells =
          converging_view(folder / n / view, folder / meshes.back() / (view + ".vtkhdf"), read);
      row.insert(row.end(), cells.begin(), cells.end());
    }
    table.rows.push_back(row);
  }
  return table;
}

}  // namespace breast
