// SPDX-License-Identifier: GPL-3.0-or-later
// Material sets: the embedded tables of pipelines/materials, or a file of the same columns.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"
#include "material/embedded.hpp"
#include "material/law.hpp"
#include "material/set_parameter.hpp"
#include "material/stability.hpp"

namespace breast {

std::string law_constant_column(std::string_view constant) {
  return constant == "b" ? "b" : std::string(constant) + "_Pa";
}

namespace {

Law read_law(const Table& table, std::size_t row, const std::string& where) {
  Law law;
  law.kind = law_kind_from_name(table.cell(row, "law"));
  for (const std::string_view constant : law_constant_names(law.kind)) {
    law.constants.push_back(table.number(row, law_constant_column(constant)));
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

/// Rows "wall", "cut" and "sternum" with the law "support"; the cut may have the law "tissue" instead.
bool read_support(const Table& table, std::size_t row, const std::string& name, MaterialSet& set) {
  const std::string law = table.cell(row, "law"), where = table.cell(row, "tissue");
  const bool beyond = law == "tissue" && where == "cut";
  if (law != "support" && !beyond) return false;
  const double stiffness = table.number(row, "support_kPa_per_mm");
  std::optional<double>* const support = support_in(set, where);
  if (support == nullptr || !(stiffness >= 0 && stiffness <= 1e6)) {
    throw input_error("materials ", name, ", support of ", where, ": ", stiffness,
                      " kPa/mm; 'wall', 'cut' and 'sternum' take 0 to 1e6");
  }
  if (*support) throw input_error("materials ", name, ": two supports of ", where);
  *support = stiffness;
  set.tissue_beyond = set.tissue_beyond || beyond;
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

}  // namespace breast
