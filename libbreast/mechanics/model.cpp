// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/model.hpp"

#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

ModelText model_text(const MechanicsOptions& options) {
  return {options.materials.name,
          material_table(options.materials).text(),
          element_name(options.element),
          invariants_name(options.invariants),
          bulk_ratio_text(options.bulk_ratio),
          options.wall->text(),
          options.cut->text()};
}

MechanicsOptions stated_model(const ModelText& text, const std::string& file) {
  try {
    MechanicsOptions model;
    model.materials = read_materials(parse_table(text.materials, text.name), text.name);
    MechanicsTexts rest;
    rest.element = text.element, rest.invariants = text.invariants;
    rest.bulk_ratio = text.bulk_ratio;
    rest.wall = text.wall, rest.cut = text.cut;
    return mechanics_options(rest, std::move(model));
  } catch (const Error& error) {
    throw input_error(file, ": group /breast/model cannot be read: ", error.what(),
                      "; make it again");
  }
}

namespace {

class Differences {
 public:
  void add(const std::string& what, const std::string& used, const std::string& other,
           const std::string& unit = "") {
    if (used == other) return;
    text_ += (text_.empty() ? "" : ", ") + what + " " + used + " instead of " + other + unit;
  }
  void add(const std::string& what, double used, double other, const std::string& unit = "") {
    if (used != other) add(what, format_number(used), format_number(other), unit);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// The factor between the stiffness of two laws that are otherwise alike; 0 if they are not.
double factor_between(const Law& used, const Law& other) {
  double factor = 0;
  for (std::size_t k = 0; k < used.constants.size() && factor == 0; ++k)
    if (used.kind->constants[k].is_stiffness() && other.constants[k] != 0)
      factor = used.constants[k] / other.constants[k];
  if (!(factor > 0)) return 0;
  const Law scaled = other.scaled(factor);
  constexpr double rounding = 1e-12;
  for (std::size_t k = 0; k < used.constants.size(); ++k)
    if (std::abs(used.constants[k] - scaled.constants[k]) > rounding * std::abs(used.constants[k]))
      return 0;
  return factor;
}

void compare_laws(const std::string& tissue, const Law& used, const Law& other,
                  Differences& differences) {
  if (used.kind != other.kind) {
    differences.add(tissue, used.describe(), other.describe());
    return;
  }
  if (used == other) return;
  if (const double factor = factor_between(used, other); factor > 0) {
    differences.add("stiffness of " + tissue, format_number(100 * factor), "100", " %");
    return;
  }
  for (std::size_t k = 0; k < used.constants.size(); ++k) {
    const ConstantKind& constant = used.kind->constants[k];
    differences.add(tissue + "." + std::string(constant.name), used.constants[k],
                    other.constants[k],
                    (constant.unit.empty() ? "" : " ") + std::string(constant.unit));
  }
}

void compare_tissue(const MaterialSet& used, const MaterialSet& other, Tissue tissue,
                    Differences& differences) {
  const std::string name(tissue_name(tissue));
  compare_laws(name, used.law(tissue), other.law(tissue), differences);
  differences.add(name + ".density", used.density[std::size_t(tissue)],
                  other.density[std::size_t(tissue)], " g/mm3");
  differences.add(name + ".corner_bulk", used.corner_bulk[std::size_t(tissue)],
                  other.corner_bulk[std::size_t(tissue)], " Pa");
}

}  // namespace

std::string model_differences(const MechanicsOptions& used, const MechanicsOptions& other) {
  const MaterialSet &mine = used.materials, &theirs = other.materials;
  Differences differences;
  for (const Tissue tissue :
       {Tissue::fat, Tissue::fibroglandular, Tissue::tumour, Tissue::muscle, Tissue::skin})
    compare_tissue(mine, theirs, tissue, differences);
  // The tissue around the breast has the law of fat, unless that was scaled by itself.
  if (!mine.alike(Tissue::other, Tissue::fat) || !theirs.alike(Tissue::other, Tissue::fat))
    compare_tissue(mine, theirs, Tissue::other, differences);
  differences.add("--skin-compression", percent_text(mine.skin.kept),
                  percent_text(theirs.skin.kept), " %");
  differences.add("--skin-smoothing", mine.skin.smoothing, theirs.skin.smoothing);
  differences.add("--skin-prestretch", percent_text(mine.skin.prestretch),
                  percent_text(theirs.skin.prestretch), " %");
  differences.add("--element", element_name(used.element), element_name(other.element));
  differences.add("--invariants", invariants_name(used.invariants),
                  invariants_name(other.invariants));
  differences.add("--bulk-ratio", bulk_ratio_text(used.bulk_ratio),
                  bulk_ratio_text(other.bulk_ratio));
  differences.add("--wall", used.wall->text(), other.wall->text());
  differences.add("--cut", used.cut->text(), other.cut->text());
  return differences.text();
}

}  // namespace breast
