// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/paper/slopes.hpp"

#include <cmath>
#include <optional>

#include "core/error.hpp"
#include "study/cells.hpp"
#include "study/paper/conclusions.hpp"
#include "study/stage_report.hpp"

namespace breast {

double slope_between(double low, double u_low, double high, double u_high) {
  return std::log(u_high / u_low) / std::log(high / low);
}

SlopeComparison compare_slopes(const TangentSlope& tangent, const ResolvedPlaces& r) {
  std::array<double, 4> s{};
  for (std::size_t i = 0; i < s.size(); ++i) s[i] = std::log(r.stiffness[i]);
  const auto log_length = [&](const Vec3& place) { return std::log((place - r.imaged).norm()); };
  const auto slope_of = [&](std::size_t i, std::size_t j) {
    return parabola_slope(s[i], s[j], log_length(r.base), log_length(r.places[i]),
                          log_length(r.places[j]));
  };
  const double near = slope_of(0, 1), wide = slope_of(2, 3);
  const double ratio =
      // The error of the formula is proportional to the product of its steps.
      s[2] * s[3] / (s[0] * s[1]);
  const Vec3 derivative = parabola_slope<Vec3>(s[0], s[1], r.base, r.places[0], r.places[1]);
  SlopeComparison result;
  result.resolved = near;
  result.difference = tangent.slope - near;
  result.step_error = std::abs((wide - near) / (ratio - 1));
  const double size = derivative.norm();
  result.vector_percent = size > 0 ? 100 * (derivative - tangent.derivative).norm() / size : 0;
  result.agrees = std::abs(result.difference) <= 2 * result.step_error + 1e-4;
  return result;
}

namespace {

Row slope_row(const std::string& tissue, const std::string& landmark, const StageReport& zero,
              const std::filesystem::path& scaled, const Table& slopes) {
  const bool one_sided = tissue == "tumour";
  const std::array<const char*, 4> steps =
      one_sided ? std::array{"150", "200", "200", "500"} : std::array{"90", "110", "50", "200"};
  const auto found = slope_row_of(slopes, landmark, tissue);
  const auto imaged = zero.place(landmark, "imaged"), base = zero.place(landmark, "position");
  if (!found || !imaged || !base)
    return {tissue, landmark, "-", "-", "-", "-", "-", "not evaluated"};
  TangentSlope tangent{slopes.number(*found, "dlnu"), Vec3(0, 0, 0)};
  for (int d = 0; d < 3; ++d)
    tangent.derivative[d] = slopes.number(*found, std::string("d") + "xyz"[d] + "_mm");
  ResolvedPlaces resolved{*imaged, *base, {}, {}};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const StageReport report =
        StageReport::read(scaled / (tissue + "-" + steps[i]) / "supine.json");
    const auto place = report.place(landmark, "position");
    if (!place)
      return {tissue, landmark,       format_fixed(tangent.slope, 5), "-", "-", "-",
              "-",    "not evaluated"};
    resolved.stiffness[i] = parse_number(steps[i], "stiffness") / 100;
    resolved.places[i] = *place;
  }
  const SlopeComparison c = compare_slopes(tangent, resolved);
  return {tissue,
          landmark,
          format_fixed(tangent.slope, 5),
          format_fixed(c.resolved, 5),
          format_fixed(c.difference, 5),
          format_fixed(c.step_error, 5),
          format_fixed(c.vector_percent, 2),
          c.agrees ? "agrees" : "differs"};
}

}  // namespace

Table slopes_table(const std::filesystem::path& base, const std::filesystem::path& scaled,
                   const Table& slopes, const Table& tumour_slopes) {
  Table table{{"tissue", "landmark", "tangent", "resolved", "difference", "step_error",
               "vector_difference_percent", "verdict"},
              {}};
  const StageReport own = StageReport::read(base),
                    stiff = StageReport::read(scaled / "tumour-100/supine.json");
  for (const std::string tissue : {"fat", "fibroglandular", "skin", "tumour"})
    for (const std::string landmark : {"tumour", "nipple"})
      table.rows.push_back(tissue == "tumour"
                               ? slope_row(tissue, landmark, stiff, scaled, tumour_slopes)
                               : slope_row(tissue, landmark, own, scaled, slopes));
  return table;
}

}  // namespace breast
