// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection/xray/spectrum.hpp"

#include <xraylib.h>

#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"

namespace breast {

namespace {

constexpr int beryllium = 4, aluminium = 13, molybdenum = 42, rhodium = 45;

double checked(double value, const xrl_error* error, double kev) {
  if (error != nullptr || !(value > 0)) {
    throw failed_error("xraylib has no cross section at ", kev,
                       " keV: ", error != nullptr ? error->message : "zero");
  }
  return value;
}

double linear_attenuation(int z, double kev) {  // 1/mm
  xrl_error* error = nullptr;
  const double mass = checked(CS_Total(z, kev, &error), error, kev);
  return cm_per_mm * mass * checked(ElementDensity(z, &error), error, kev);
}

// Dry air, mass fractions of nitrogen, oxygen, argon.
struct Part {
  int z;
  double fraction;
};
constexpr Part air[] = {{7, 0.7553}, {8, 0.2318}, {18, 0.0128}};
constexpr double air_density = 1.205e-3;  // g/cm³

double of_air(double (*cross_section)(int, double, xrl_error**), double kev) {  // cm²/g
  double sum = 0;
  for (const Part& part : air) {
    xrl_error* error = nullptr;
    sum += part.fraction * checked(cross_section(part.z, kev, &error), error, kev);
  }
  return sum;
}

double kerma(const Spectrum& spectrum) {
  double sum = 0;
  for (std::size_t i = 0; i < spectrum.kev.size(); ++i) {
    sum += spectrum.fluence[i] * spectrum.kev[i] * of_air(CS_Energy, spectrum.kev[i]);
  }
  return sum;
}

}  // namespace

double Spectrum::mean_kev() const {
  return std::inner_product(kev.begin(), kev.end(), fluence.begin(), 0.0) /
         std::accumulate(fluence.begin(), fluence.end(), 0.0);
}

double Spectrum::half_value_layer() const {
  const double half = 0.5 * kerma(*this);
  double low = 0, high = 20;
  for (int k = 0; k < 50; ++k) {
    const double middle = 0.5 * (low + high);
    (kerma(filtered(*this, aluminium, middle)) > half ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Spectrum anode_spectrum(Anode anode, double kv) {
  if (!(kv >= 22 && kv <= 35)) {
    throw input_error("tube voltage ", kv, " kV: the spectrum model is given for 22-35 kV");
  }
  Spectrum spectrum;
  const AnodeTable& table = anode_table(anode);
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double kev = anode_first_kev + anode_step_kev * double(i);
    if (kev > kv) break;
    const auto& a = table[i];
    const double fluence = a[0] + kv * (a[1] + kv * (a[2] + kv * a[3]));
    if (!(fluence > 0)) continue;  // the fit crosses zero near the end of the spectrum
    spectrum.kev.push_back(kev);
    spectrum.fluence.push_back(fluence);
  }
  return spectrum;
}

Spectrum filtered(const Spectrum& spectrum, int z, double mm) {
  Spectrum behind = spectrum;
  for (std::size_t i = 0; i < behind.kev.size(); ++i) {
    behind.fluence[i] *= std::exp(-mm * linear_attenuation(z, behind.kev[i]));
  }
  return behind;
}

Spectrum behind_air(const Spectrum& spectrum, double mm) {
  Spectrum behind = spectrum;
  for (std::size_t i = 0; i < behind.kev.size(); ++i) {
    behind.fluence[i] *= std::exp(-mm * cm_per_mm * air_density * of_air(CS_Total, behind.kev[i]));
  }
  return behind;
}

bool names_spectrum(const std::string& text) {
  return text.rfind("W/", 0) == 0 || text.rfind("Mo/", 0) == 0;
}

Spectrum named_spectrum(const std::string& name) {
  const auto colon = name.find(':');
  const std::string beam = name.substr(0, colon);
  if ((beam != "W/Rh" && beam != "Mo/Mo") || colon == std::string::npos) {
    throw input_error("spectrum \"", name,
                      "\": give anode/filter and kV as W/Rh:28 or Mo/Mo:28, or a spectrum file");
  }
  const double kv = parse_number(name.substr(colon + 1), "spectrum " + beam);
  constexpr double window_mm = 1.0, air_mm = 600;
  const bool tungsten = beam == "W/Rh";
  const Spectrum anode = anode_spectrum(tungsten ? Anode::tungsten : Anode::molybdenum, kv);
  const Spectrum window = behind_air(filtered(anode, beryllium, window_mm), air_mm);
  return tungsten ? filtered(window, rhodium, 0.05) : filtered(window, molybdenum, 0.03);
}

}  // namespace breast
