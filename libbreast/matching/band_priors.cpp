// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "core/error.hpp"
#include "matching/band.hpp"

namespace breast {

// Relative deviations of stiffness are of the natural logarithm: 0.7 is a factor of 2 either way.
std::vector<Prior> default_priors() {
  const char* moduli = "spread of published in-vivo and ex-vivo moduli: laws seed2008 to mira2018";
  return {
      {"fat", 0.7, "relative", moduli},
      {"fibroglandular", 0.7, "relative", moduli},
      {"tumour", 0.7, "relative", moduli},
      {"skin", 0.7, "relative", moduli},
      {"wall", 0.7, "relative", "assumed, as of stiffness: resistance to sliding on the chest wall"},
      {"cut", 0.7, "relative", "the same, of the tissue beside the breast"},
      {"skin_thickness", 0.2, "relative",
       "0.5-2.0 mm, mean 1.45: Huang et al., Med Phys 35:1199, 2008"},
      {"density", 0.03, "relative", "fat 0.93 to gland 1.04 g/cm3: Hammerstein 1979"},
      {"thickness", 2.5, "mm",
       "displayed thickness within 5 mm: EUREF protocol, 4th edition; up to 14 % off: Med Phys "
       "39:263, 2012"},
      {"angle", 3.0, "degree", "assumed: the patient's turn against the C-arm"},
      {"standoff", 5.0, "mm", "assumed: plate edge to chest wall, not recorded by any machine"},
      {"detector", 10.0, "mm", "assumed: height of the detector against the inframammary fold"},
      {"repositioning", 3.0, "mm",
       "outlines of the same view on another date, after a similarity fit, 2-7 mm rms apart: four "
       "pairs of public mammograms; a part of it each image"},
      {"chain", 2.0, "mm",
       "errors of segmentation, mesh and tissue: what the phantom's true places showed beyond the "
       "band without it (docs/validation.md)"},
      {"chest_wall", 1.0, "sigma",
       "of the wall's own deviation (segment), everywhere to one side: the worst it allows"},
      {"picking", 1.0, "mm", "assumed: marking the centre of a lesion"},
  };
}

std::string default_priors_text() {
  const std::vector<Prior> priors = default_priors();
  std::string text = "Default priors, one standard deviation: ";
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
    priors.push_back(
        {row[std::size_t(parameter)], value, optional(row, "unit"), optional(row, "source")});
  }
  return priors;
}

}  // namespace breast
