// SPDX-License-Identifier: GPL-3.0-or-later
#include "material/material_set.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"
#include "material/embedded.hpp"
#include "material/stability.hpp"

namespace breast {

namespace {

Law read_law(const Table& table, std::size_t row, const std::string& where) {
  Law law;
  law.kind = &law_kind(table.cell(row, "law"));
  for (const ConstantKind& constant : law.kind->constants) {
    law.constants.push_back(table.number(row, constant.column()));
  }
  check_law(law, where);
  return law;
}

std::optional<double> optional_number(const Table& table, std::size_t row,
                                      const std::string& column) {
  if (!table.has(column) || table.cell(row, column) == "-") return {};
  return table.number(row, column);
}

void read_skin(const Table& table, std::size_t row, const std::string& where, SkinBehaviour& skin) {
  skin.kept = optional_number(table, row, "compression_percent").value_or(100) / 100;
  skin.smoothing = optional_number(table, row, "smoothing").value_or(skin.smoothing);
  skin.prestretch = optional_number(table, row, "prestretch_percent").value_or(0) / 100;
  check_skin(skin, where);
}

double read_corner_bulk(const Table& table, std::size_t row, const std::string& where) {
  constexpr double most = 1e9;
  const double bulk = optional_number(table, row, "corner_bulk_Pa").value_or(0);
  if (!(bulk >= 0 && bulk <= most)) {
    throw input_error(where, ": corner_bulk_Pa ", bulk, " must lie in 0 to ", most);
  }
  return bulk;
}

/// Rows "wall" and "cut" with the law "support".
bool read_support(const Table& table, std::size_t row, const std::string& name, MaterialSet& set) {
  if (table.cell(row, "law") != "support") return false;
  const std::string where = table.cell(row, "tissue"), text = table.cell(row, "support");
  std::string* const support = where == "wall" ? &set.wall : where == "cut" ? &set.cut : nullptr;
  if (support == nullptr || text.empty() || text == "-") {
    throw input_error("materials ", name, ", support of ", where, ": '", text,
                      "'; 'wall' and 'cut' take a support such as slide:0.01 or spring:0.01");
  }
  if (!support->empty()) throw input_error("materials ", name, ": two supports of ", where);
  *support = text;
  return true;
}

/// Rows with the law "uncertainty": one per parameter, with its correlations to all of them.
SoftnessUncertainty read_uncertainty(const Table& table, const std::string& name) {
  SoftnessUncertainty known;
  std::vector<std::size_t> rows;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (table.cell(row, "law") != "uncertainty") continue;
    known.parameters.push_back(table.cell(row, "tissue"));
    rows.push_back(row);
  }
  const Eigen::Index n = Eigen::Index(rows.size());
  known.covariance.resize(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double sd = table.number(rows[std::size_t(i)], "ln_sd");
    if (!(sd >= 0 && sd <= 10)) {
      throw input_error("materials ", name, ", uncertainty of ", known.parameters[std::size_t(i)],
                        ": ln_sd ", sd, " must lie in 0 to 10");
    }
    for (Eigen::Index j = 0; j < n; ++j) {
      const std::string column = "correlation_" + known.parameters[std::size_t(j)];
      const double r = table.number(rows[std::size_t(i)], column);
      if (!(std::abs(r) <= 1)) {
        throw input_error("materials ", name, ", uncertainty of ", known.parameters[std::size_t(i)],
                          ": ", column, " ", r, " must lie in -1 to 1");
      }
      known.covariance(i, j) = sd * table.number(rows[std::size_t(j)], "ln_sd") * r;
    }
  }
  return known;
}

}  // namespace

MaterialSet read_materials(const Table& table, const std::string& name) {
  MaterialSet set;
  set.name = name;
  std::array<bool, n_tissues> given{};
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (read_support(table, row, name, set) || table.cell(row, "law") == "uncertainty") continue;
    const std::string tissue_text = table.cell(row, "tissue");
    const auto tissue = static_cast<std::size_t>(tissue_from_name(tissue_text));
    const std::string where = "materials " + name + ", tissue " + tissue_text;
    if (given[tissue]) throw input_error(where, ": appears twice");
    given[tissue] = true;
    set.laws[tissue] = read_law(table, row, where);
    if (Tissue(tissue) == Tissue::skin) read_skin(table, row, where, set.skin);
    const double density = table.number(row, "density_g_per_mm3");
    if (!(density >= 0) || density > 0.1) {
      throw input_error(where, ": density ", density, " g/mm^3 must lie in 0 to 0.1 (water 0.001)");
    }
    set.density[tissue] = density;
    set.corner_bulk[tissue] = read_corner_bulk(table, row, where);
  }
  set.uncertainty = read_uncertainty(table, name);
  const auto fill = [&](Tissue to, Tissue from) {
    const auto t = static_cast<std::size_t>(to), f = static_cast<std::size_t>(from);
    if (given[t]) return;
    if (!given[f]) {
      throw input_error("materials ", name, ": tissue ", tissue_name(from), " is missing");
    }
    set.laws[t] = set.laws[f];
    set.density[t] = set.density[f];
    set.corner_bulk[t] = set.corner_bulk[f];
    given[t] = true;
  };
  fill(Tissue::fibroglandular, Tissue::fibroglandular);
  fill(Tissue::skin, Tissue::skin);
  fill(Tissue::tumour, Tissue::fibroglandular);  // an undiagnosed tumour is as stiff as its bed
  for (const Tissue t : {Tissue::air, Tissue::muscle, Tissue::other}) fill(t, Tissue::fat);
  return set;
}

MaterialSet load_materials(const std::string& name_or_file) {
  for (const EmbeddedTable& table : embedded_materials()) {
    if (table.name == name_or_file) {
      return read_materials(parse_table(std::string(table.text), name_or_file), name_or_file);
    }
  }
  if (!std::filesystem::exists(name_or_file)) {
    std::string names;
    for (const std::string& name : material_set_names())
      names += (names.empty() ? "" : ", ") + name;
    throw input_error("materials '", name_or_file, "': neither a file nor one of ", names);
  }
  const std::filesystem::path file(name_or_file);
  return read_materials(read_table(file), file.filename().string());
}

std::vector<std::string> material_set_names() {
  std::vector<std::string> names;
  for (const EmbeddedTable& table : embedded_materials()) names.emplace_back(table.name);
  std::sort(names.begin(), names.end());  // not as their files, whose ending comes after a hyphen
  return names;
}

void check_skin(const SkinBehaviour& skin, const std::string& where) {
  const auto check = [&](double value, double low, double high, const char* what) {
    if (!(value >= low && value <= high)) {
      throw input_error(where, ": ", what, " ", value, " must lie in ", low, " to ", high);
    }
  };
  check(skin.kept, 0.001, 1, "fraction of the skin's law kept in compression");
  check(skin.smoothing, 1e-4, 0.5, "smoothing of the skin's tension field");
  check(skin.prestretch, 0, 0.5, "pre-stretch of the skin");
  const double stretched = (1 + skin.prestretch) * (1 + skin.prestretch) - 1;
  if (skin.kept < 1 && !(stretched >= skin.smoothing)) {
    throw input_error(where, ": a pre-stretch of ", 100 * skin.prestretch,
                      " % leaves the skin of the stress-free shape within the transition to "
                      "wrinkling; give at least ",
                      100 * (std::sqrt(1 + skin.smoothing) - 1), " %, or less smoothing");
  }
}

void scale_materials(MaterialSet& set, const std::vector<std::string>& settings) {
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos) {
      throw input_error("--scale '", setting, "': write TISSUE=PERCENT, for example fat=50");
    }
    const Tissue tissue = tissue_from_name(setting.substr(0, equals));
    const double percent = parse_number(setting.substr(equals + 1), "--scale " + setting);
    if (!(percent > 0) || percent > 1e8) {
      throw input_error("--scale ", setting, ": percent must lie above 0 and up to 1e8");
    }
    Law& law = set.laws[static_cast<std::size_t>(tissue)];
    law = law.scaled(percent / 100);
  }
}

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
  Row row{{"tissue", std::string(tissue_name(tissue))}, {"law", std::string(law.kind->name)}};
  row["density_g_per_mm3"] = format_number(set.density[std::size_t(tissue)]);
  for (std::size_t k = 0; k < law.constants.size(); ++k)
    row[law.kind->constants[k].column()] = format_number(law.constants[k]);
  const double corner_bulk = set.corner_bulk[std::size_t(tissue)];
  if (corner_bulk > 0) row["corner_bulk_Pa"] = format_number(corner_bulk);
  if (tissue == Tissue::skin) {
    row["compression_percent"] = percent_text(set.skin.kept);
    row["smoothing"] = format_number(set.skin.smoothing);
    row["prestretch_percent"] = percent_text(set.skin.prestretch);
  }
  return row;
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
  for (const auto& [where, text] : {std::pair("wall", set.wall), {"cut", set.cut}}) {
    if (!text.empty()) rows.push_back({{"tissue", where}, {"law", "support"}, {"support", text}});
  }
  add_uncertainty(set.uncertainty, rows);
  Table table{{"tissue", "law", "density_g_per_mm3"}, {}};
  for (const LawKind* kind : law_kinds()) {
    for (const ConstantKind& constant : kind->constants) {
      if (!table.has(constant.column())) table.columns.push_back(constant.column());
    }
  }
  for (const char* column : {"corner_bulk_Pa", "compression_percent", "smoothing",
                             "prestretch_percent", "support", "ln_sd"})
    table.columns.push_back(column);
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
