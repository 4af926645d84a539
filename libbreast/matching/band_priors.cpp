// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "core/error.hpp"
#include "matching/band.hpp"

namespace breast {

// Relative standard deviations of stiffness refer to the natural logarithm: 0.7 is a factor of 2
// either way.
std::vector<Prior> default_priors() {
  const char* moduli = "spread of published in-vivo and ex-vivo moduli: laws seed2008 to mira2018";
  return {
      {"fat", 0.7, "relative", moduli},
      {"fibroglandular", 0.7, "relative", moduli},
      {"tumour", 0.7, "relative", moduli},
      {"skin", 0.7, "relative", moduli},
      {"wall", 0.7, "relative",
       "resistance to sliding on the chest wall; assumed, as for the "
       "stiffness"},
      {"cut", 0.7, "relative", "support by the tissue beside the breast; assumed likewise"},
      {"sternum", 0.7, "relative", "attachment to the sternum; assumed likewise"},
      {"skin_thickness", 0.2, "relative",
       "0.5-2.0 mm, mean 1.45: Huang et al., Med Phys 35:1199, 2008"},
      {"density", 0.03, "relative", "fat 0.93 to gland 1.04 g/cm3: Hammerstein 1979"},
      {"thickness", 2.5, "mm",
       "displayed thickness within 5 mm: EUREF protocol, 4th edition; up to 14 % off: Med Phys "
       "39:263, 2012"},
      {"angle", 3.0, "degree", "assumed: rotation of the patient relative to the C-arm"},
      {"standoff", 5.0, "mm",
       "assumed: distance from plate edge to chest wall, which no "
       "machine records"},
      {"detector", 10.0, "mm",
       "assumed: height of the detector relative to the inframammary "
       "fold"},
      {"repositioning", 3.0, "mm",
       "outlines of the same view on different dates differ by 2-7 mm rms after a similarity "
       "fit, in four pairs of public mammograms; each image has a share of it"},
      {"chain", 2.0, "mm",
       "errors of segmentation, mesh and tissue: without this term the band was too narrow by "
       "this much for the errors measured on phantoms (docs/validation.md)"},
      {"chest_wall", 1.0, "sigma",
       "the whole chest wall is shifted in one direction by its own standard deviation (segment), "
       "which is the worst case"},
      {"picking", 1.0, "mm", "assumed: marking the centre of a lesion"},
  };
}

std::string default_priors_text() {
  const std::vector<Prior> priors = default_priors();
  std::string text = "The default priors are, as one standard deviation: ";
  for (std::size_t i = 0; i < priors.size(); ++i) {
    const Prior& prior = priors[i];
    text += prior.parameter;
    const bool last = i + 1 == priors.size();
    if (!last && priors[i + 1].source == prior.source) {  // one source for several
      text += ", ";
      continue;
    }
    text += " " + format_number(prior.deviation) + " " + prior.unit + " (" + prior.source + ")" +
            (last ? "." : "; ");
  }
  return text;
}

std::vector<Prior> priors_from(const Table& table, const std::string& where) {
  const int parameter = table.column("parameter"), deviation = table.column("standard_deviation");
  const auto optional = [&](const std::vector<std::string>& row, const char* name) {
    const auto at = std::find(table.columns.begin(), table.columns.end(), name);
    return at == table.columns.end() ? std::string() : row[std::size_t(at - table.columns.begin())];
  };
  std::vector<Prior> priors;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto& row = table.rows[r];
    const std::string at = where + ", row " + std::to_string(r + 1);
    const double value = parse_number(row[std::size_t(deviation)], at);
    if (!(value >= 0)) throw input_error(at, ": standard deviation ", value, " is negative");
    const std::string& name = row[std::size_t(parameter)];
    for (const Prior& prior : priors) {
      if (prior.parameter == name)
        throw input_error(at, ": parameter '", name,
                          "' is listed twice, which would widen the band");
    }
    priors.push_back(
        {row[std::size_t(parameter)], value, optional(row, "unit"), optional(row, "source")});
  }
  if (priors.empty()) throw input_error(where, ": no priors");
  return priors;
}

}  // namespace breast
