// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/experiments/draws.hpp"

#include <algorithm>
#include <cstdio>
#include <map>

#include "core/text/lists.hpp"
#include "study/cells.hpp"

namespace breast {

namespace {

// Sums and largest values of the columns over the draws of one study, truth and mesh.
struct Draws {
  std::string study, truth, elements;
  int count = 0, alarms = 0;
  std::map<std::string, double> sum, most;
};

std::string share(double part, double whole) {
  return whole > 0 ? format_fixed(100 * part / whole, 0) : no_value;
}

double number_or_0(const Table& table, std::size_t row, const std::string& column) {
  return number_of(table.cell(row, column)).value_or(0);  // "-" if it is not part of this study
}

Row draws_row(const Draws& d) {
  const auto sum = [&](const char* column) { return d.sum.at(column); };
  const auto mean = [&](const char* column, int decimals) {
    return format_fixed(sum(column) / d.count, decimals);
  };
  const bool surface = d.study.starts_with("surface"), directions = sum("directions") > 0;
  return {d.study,
          d.truth,
          std::to_string(d.count),
          d.elements,
          general(sum("converged")),
          mean("pairs", 1),
          general(d.most.at("pairs")),
          mean("cpu_s", 1),
          directions ? general(sum("identifiable")) : no_value,
          share(sum("within_10_percent"), sum("identifiable")),
          share(sum("within_2_sd"), sum("identifiable")),
          share(sum("all_within_2_sd"), sum("directions")),
          mean("motion_mm", 0),
          surface ? no_value : mean("left_out_mm", 2),
          mean("true_mm", 2),
          format_fixed(d.most.at("true_mm"), 2),
          surface ? no_value : share(d.alarms, d.count)};
}

}  // namespace

Table identification_table(const std::vector<Table>& studies) {
  std::vector<Draws> all;
  for (const Table& table : studies) {
    for (std::size_t r = 0; r < table.rows.size(); ++r) {
      const std::string &study = table.cell(r, "study"), &truth = table.cell(r, "truth");
      const std::string& elements = table.cell(r, "elements");
      auto draws = std::find_if(all.begin(), all.end(), [&](const Draws& d) {
        return d.study == study && d.truth == truth && d.elements == elements;
      });
      if (draws == all.end())
        draws = all.insert(all.end(), Draws{study, truth, elements, 0, 0, {}, {}});
      ++draws->count;
      draws->alarms += number_or_0(table, r, "probability") < 0.05 ? 1 : 0;
      for (const std::string column :
           {"pairs", "cpu_s", "converged", "identifiable", "within_10_percent", "within_2_sd",
            "directions", "all_within_2_sd", "motion_mm", "left_out_mm", "true_mm"}) {
        const double value = number_or_0(table, r, column);
        draws->sum[column] += value;
        draws->most[column] = std::max(draws->most[column], value);
      }
    }
  }
  Table table{{"study", "truth", "draws", "elements", "settled", "pairs", "pairs_most", "cpu_s",
               "known_5_percent", "within_10_percent_%", "within_2_sd_%", "all_within_2_sd_%",
               "moved_mm", "left_out_mm", "true_mm", "true_worst_mm", "alarms_%"},
              {}};
  for (const Draws& draws : all) table.rows.push_back(draws_row(draws));
  return table;
}

namespace {

struct Outcome {
  std::string solve, outcome;
  int cases = 0;
  double worst_residual = 0, least_det_F = 0, most_newton = 0, seconds = 0;
  std::vector<std::string> which;
};

void add_cases(const Table& table, const std::string& solve, std::vector<Outcome>& outcomes) {
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const bool as_stated = !table.has("verdict") || table.cell(r, "verdict") == "success";
    const std::string outcome = table.cell(r, "outcome"),
                      shown = outcome + (as_stated ? "" : ", not as stated");
    const std::string name = solve.empty() ? table.cell(r, "direction") : solve;
    auto found = std::find_if(outcomes.begin(), outcomes.end(), [&](const Outcome& o) {
      return o.solve == name && o.outcome == shown;
    });
    if (found == outcomes.end())
      found = outcomes.insert(outcomes.end(), Outcome{name, shown, 0, 0, 0, 0, 0, {}});
    ++found->cases;
    found->worst_residual = std::max(found->worst_residual, number_or_0(table, r, "residual"));
    const double det_F = number_or_0(table, r, "min_det_F");
    if (det_F > 0 && (found->least_det_F == 0 || det_F < found->least_det_F))
      found->least_det_F = det_F;
    found->most_newton = std::max(found->most_newton, number_or_0(table, r, "newton"));
    found->seconds += number_or_0(table, r, "seconds");
    if (!as_stated || outcome != "converged") found->which.push_back(table.cell(r, "case"));
  }
}

std::string exponential(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.1e", value);
  return buffer;
}

}  // namespace

Table stability_table(const Table& mechanics, const Table& contact) {
  Table table{{"solve", "outcome", "cases", "worst_residual", "least_det_F", "most_newton",
               "seconds", "which"},
              {}};
  std::vector<Outcome> outcomes;
  Table plain = mechanics;  // only contact cases have a verdict
  if (plain.has("verdict"))
    plain.columns[std::size_t(plain.column("verdict"))] = "mechanics_verdict";
  add_cases(plain, "", outcomes);
  add_cases(contact, "compression", outcomes);
  for (const Outcome& o : outcomes) {
    const bool reached =
        // False for a scene refused before its first state, which has neither residual nor det F.
        o.least_det_F > 0;
    table.rows.push_back({o.solve, o.outcome, std::to_string(o.cases),
                          reached ? exponential(o.worst_residual) : no_value,
                          reached ? format_fixed(o.least_det_F, 3) : no_value,
                          general(o.most_newton), format_fixed(o.seconds, 1),
                          cell_or_dash(join(o.which, "; "))});
  }
  return table;
}

}  // namespace breast
