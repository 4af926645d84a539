// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection/xray/tissue_attenuation.hpp"

#include <xraylib.h>

#include <array>

#include "core/error.hpp"
#include "core/units.hpp"

namespace breast {

namespace {

constexpr double tumour_over_gland = 1.052;

// Mass fractions of H, C, N, O and of the ash, counted as equal parts of P, S, K and Ca.
struct Composition {
  double density;  // g/cm³
  std::array<double, 8> fraction;
};
constexpr std::array<int, 8> elements = {1, 6, 7, 8, 15, 16, 19, 20};
constexpr Composition composition(double density, double h, double c, double n, double o,
                                  double ash) {
  return {density, {h, c, n, o, ash / 4, ash / 4, ash / 4, ash / 4}};
}
constexpr Composition adipose = composition(0.93, 0.112, 0.619, 0.017, 0.251, 0.001);
constexpr Composition gland = composition(1.04, 0.102, 0.184, 0.032, 0.677, 0.005);
constexpr Composition skin = composition(1.09, 0.098, 0.178, 0.050, 0.667, 0.007);

double attenuation(const Composition& tissue, double kev) {
  double sum = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    xrl_error* error = nullptr;
    sum += tissue.fraction[i] * CS_Total(elements[i], kev, &error);
    if (error != nullptr) {
      const std::string why = error->message;
      xrl_error_free(error);
      throw failed_error("xraylib has no cross section at ", kev, " keV: ", why);
    }
  }
  return cm_per_mm * tissue.density * sum;
}

}  // namespace

Attenuation attenuation_at(double kev) {
  if (!(kev >= 5 && kev <= 100)) {
    throw input_error("energy ", kev, " keV: outside the range of breast imaging, 5-100 keV");
  }
  Attenuation mu;
  mu.fat = attenuation(adipose, kev);
  mu.fibroglandular = attenuation(gland, kev);
  mu.skin = attenuation(skin, kev);
  mu.tumour = tumour_over_gland * mu.fibroglandular;
  return mu;
}

}  // namespace breast
