// SPDX-License-Identifier: GPL-3.0-or-later
// laws: a material set's laws, moduli, stable ranges and curves.
#include "cli/tool.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"
#include "material/curves.hpp"
#include "material/material_set.hpp"
#include "material/stability.hpp"

using namespace breast;

namespace {

// Reference length in ρgL/μ: a breast of 0.1 m.
constexpr double typical_size_mm = 100;

struct Choices {
  std::string set;
  std::vector<std::string> scale;
  bool curves = false;
  double low = 0.5, high = 2;
};

std::string fixed(double value, int decimals) {
  return format_fixed(value, decimals);
}

Table summary(const MaterialSet& set, Run& run) {
  Table table{{"tissue", "law", "shear_modulus_Pa", "gravity_number", "stable_from_stretch",
               "stable_to_stretch", "weakest_relative_shear", "ellipticity_margin"},
              {}};
  for (const Tissue tissue :
       {Tissue::fat, Tissue::fibroglandular, Tissue::skin, Tissue::muscle, Tissue::tumour}) {
    const Law& law = set.law(tissue);
    const double modulus = law.shear_modulus();
    const double number =
        set.density[std::size_t(tissue)] * gravity_mm_s2 * typical_size_mm / modulus;
    const StableRange range = stable_range(law);
    const std::string name(tissue_name(tissue));
    table.rows.push_back({name, law.describe(), fixed(modulus, 1), fixed(number, 3),
                          fixed(range.compression, 3), fixed(range.tension, 3),
                          fixed(range.weakest, 3), fixed(ellipticity_margin(law).value, 3)});
    run.report().set("materials/" + name + "/ellipticity_margin", ellipticity_margin(law).value);
    run.report().set("materials/" + name + "/law", law.describe());
    run.report().set("materials/" + name + "/shear_modulus_Pa", modulus);
    run.report().set("materials/" + name + "/gravity_number", number);
    run.report().set("materials/" + name + "/stable_from_stretch", range.compression);
    run.report().set("materials/" + name + "/stable_to_stretch", range.tension);
  }
  return table;
}

Table curves(const MaterialSet& set, double low, double high) {
  constexpr int steps = 30;
  Table table{{"tissue", "stretch", "uniaxial_stress_Pa", "equibiaxial_stress_Pa",
               "pure_shear_stress_Pa", "shear", "shear_stress_Pa"},
              {}};
  for (const Tissue tissue :
       {Tissue::fat, Tissue::fibroglandular, Tissue::skin, Tissue::muscle, Tissue::tumour}) {
    for (int i = 0; i <= steps; ++i) {
      const double stretch = low + (high - low) * i / steps, gamma = (high - 1) * i / steps;
      const Law& law = set.law(tissue);
      table.rows.push_back({std::string(tissue_name(tissue)), fixed(stretch, 4),
                            format_number(uniaxial_stress(law, stretch)),
                            format_number(equibiaxial_stress(law, stretch)),
                            format_number(pure_shear_stress(law, stretch)), fixed(gamma, 4),
                            format_number(simple_shear_stress(law, gamma))});
    }
  }
  return table;
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("laws", "a material set: laws, moduli, stable ranges and curves");
  tool.describe(
      "Prints for each tissue the law, its shear modulus at zero strain, the gravity number "
      "(density x gravity x 0.1 m / shear modulus, a measure of sagging), the range of uniaxial "
      "stretch in which every shear has positive stiffness, and the margin of strong "
      "ellipticity (1 if no constant acts against it, 0 where the law is refused). With "
      "--curves the tool prints the nominal uniaxial, equibiaxial and pure-shear stress against "
      "stretch, and the simple-shear stress against shear, in Pa.");
  tool.word(
      c.set, "NAME|FILE",
      "material set: invivo, invivo-borders, invivo-sternum, seed2008, wellman, victre, mira2018, phantom2026, or a TSV file of the "
      "same columns");
  tool.texts(c.scale, "--scale", "TISSUE=PERCENT",
             "stiffness of one tissue in percent of its stiffness in the set, such as fat=150");
  tool.flag(c.curves, "--curves", "print stress curves instead of the summary");
  tool.number(c.low, "--from", "STRETCH", "smallest stretch of the curves", 0.05, 1);
  tool.number(c.high, "--to", "STRETCH", "largest stretch of the curves", 1, 10);
  tool.example("laws mira2018", "summary of a material set");
  tool.example("laws my-tissues.tsv --curves > curves.tsv",
               "stress curves of one's own material set");
  return tool.main(argc, argv, [&c](Run& run) {
    MaterialSet set = load_materials(c.set);
    scale_materials(set, c.scale);
    run.report().set("materials/name", set.name);
    run.print((c.curves ? curves(set, c.low, c.high) : summary(set, run)).text());
  });
}
