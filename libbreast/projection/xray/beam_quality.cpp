// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection/xray/beam_quality.hpp"

#include <filesystem>

#include "core/error.hpp"
#include "core/table.hpp"
#include "projection/xray/spectrum.hpp"
#include "projection/xray/tissue_attenuation.hpp"

namespace breast {

namespace {

Energy from_spectrum(const std::string& name) {
  const Spectrum spectrum = named_spectrum(name);
  std::vector<double> weights;
  std::vector<Attenuation> attenuation;
  for (std::size_t i = 0; i < spectrum.kev.size(); ++i) {
    weights.push_back(spectrum.fluence[i] * spectrum.kev[i]);
    attenuation.push_back(attenuation_at(spectrum.kev[i]));
  }
  return {name, weights, attenuation};
}

Energy from_file(const std::string& file) {
  const Table table = read_table(file);
  std::vector<double> weights;
  std::vector<Attenuation> attenuation;
  double sum = 0;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const double w = table.number(r, "weight");
    if (!(w >= 0)) throw input_error(file, ", row ", r + 1, ": weight ", w, " is negative");
    attenuation.push_back(attenuation_at(table.number(r, "energy_keV")));
    weights.push_back(w);
    sum += w;
  }
  if (!(sum > 0)) throw input_error(file, ": no weight above 0");
  return {std::filesystem::path(file).filename().string(), weights, attenuation};
}

}  // namespace

Energy parse_energy(const std::string& text) {
  if (text == "fraction") return {};
  if (text.find_first_not_of("0123456789.eE+-") == std::string::npos) {
    const double kev = parse_number(text, "--energy");
    return {format_number(kev) + " keV", {1}, {attenuation_at(kev)}};
  }
  if (names_spectrum(text)) return from_spectrum(text);
  if (!std::filesystem::is_regular_file(text)) {
    throw input_error("--energy ", text,
                      ": must be \"fraction\", a number of keV, a spectrum such as W/Rh:28, or "
                      "a file");
  }
  return from_file(text);
}

}  // namespace breast
