// SPDX-License-Identifier: GPL-3.0-or-later
#include "material/material_table.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace breast {

std::string percent_text(double fraction) {
  // 100 times 0.07 is not 7, but a neighbour of it.
  const double product = 100 * fraction;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const double near :
       {product, std::nextafter(product, -infinity), std::nextafter(product, infinity)})
    if (near / 100 == fraction) return format_number(near);
  return format_number(product);
}

namespace {

using Row = std::map<std::string, std::string>;

Row law_row(const MaterialSet& set, Tissue tissue) {
  const Law& law = set.law(tissue);
  Row row{{"tissue", std::string(tissue_name(tissue))},
          {"law", std::string(law_kind_name(law.kind))}};
  row["density_g_per_mm3"] = format_number(set.density[std::size_t(tissue)]);
  const std::vector<std::string_view> names = law_constant_names(law.kind);
  for (std::size_t k = 0; k < names.size(); ++k)
    row[law_constant_column(names[k])] = format_number(law.constants[k]);
  if (tissue == Tissue::skin) {
    row["compression_percent"] = percent_text(set.skin.kept);
    row["smoothing"] = format_number(set.skin.smoothing);
    row["prestretch_percent"] = percent_text(set.skin.prestretch);
  }
  return row;
}

Row support_row(const char* where, double stiffness, const char* law = "support") {
  return {{"tissue", where}, {"law", law}, {"support_kPa_per_mm", format_number(stiffness)}};
}

/// Without the rounding errors of its division.
double correlation(double value) {
  constexpr double digits = 1e12;
  return std::clamp(std::round(digits * value) / digits, -1.0, 1.0);
}

void add_uncertainty(const SoftnessUncertainty& known, std::vector<Row>& rows) {
  for (std::size_t i = 0; i < known.parameters.size(); ++i) {
    Row row{{"tissue", known.parameters[i]}, {"law", "uncertainty"}};
    const double sd = std::sqrt(known.covariance(i, i));
    row["ln_sd"] = format_number(sd);
    for (std::size_t j = 0; j < known.parameters.size(); ++j) {
      const double scale = sd * std::sqrt(known.covariance(j, j));
      row["correlation_" + known.parameters[j]] =
          format_number(scale > 0 ? correlation(known.covariance(i, j) / scale) : double(i == j));
    }
    rows.push_back(row);
  }
}

}  // namespace

Table material_table(const MaterialSet& set) {
  std::vector<Row> rows;
  for (const Tissue tissue :
       {Tissue::fat, Tissue::fibroglandular, Tissue::muscle, Tissue::tumour, Tissue::skin})
    rows.push_back(law_row(set, tissue));
  for (const Tissue tissue : {Tissue::air, Tissue::other})
    if (!set.alike(tissue, Tissue::fat)) rows.push_back(law_row(set, tissue));
  if (set.wall_support) rows.push_back(support_row("wall", *set.wall_support));
  if (set.cut_support)
    rows.push_back(support_row("cut", *set.cut_support, set.tissue_beyond ? "tissue" : "support"));
  if (set.sternum_support) rows.push_back(support_row("sternum", *set.sternum_support));
  add_uncertainty(set.uncertainty, rows);
  Table table{{"tissue", "law", "density_g_per_mm3", "a10_Pa", "a01_Pa", "a20_Pa", "a02_Pa",
               "a11_Pa", "c1_Pa", "c2_Pa", "c3_Pa", "a_Pa", "b", "c_Pa", "compression_percent",
               "smoothing", "prestretch_percent", "support_kPa_per_mm", "ln_sd"},
              {}};
  for (const std::string& name : set.uncertainty.parameters)
    table.columns.push_back("correlation_" + name);
  std::erase_if(table.columns, [&](const std::string& column) {
    return std::none_of(rows.begin(), rows.end(), [&](const Row& r) { return r.contains(column); });
  });
  for (Row& row : rows) {
    std::vector<std::string> cells;
    for (const std::string& column : table.columns)
      cells.push_back(row.contains(column) ? row.at(column) : "-");
    table.rows.push_back(cells);
  }
  return table;
}

}  // namespace breast
