// SPDX-License-Identifier: GPL-3.0-or-later
// Unfiltered mammography spectra as polynomials of the tube voltage: Boone, Fewell and Jennings,
// "Molybdenum, rhodium, and tungsten anode spectral models using interpolating polynomials with
// application to mammography", Med. Phys. 24 (1997) 1863-1874, fitted to measured spectra. The
// coefficients are given for 8-35 keV, the range that passes a mammographic filter.
#pragma once

#include <array>

namespace breast {

enum class Anode { molybdenum, tungsten };

inline constexpr double anode_first_kev = 8.0, anode_step_kev = 0.5;
/// Row i: relative fluence per 0.5 keV at 8 + i/2 keV = a0 + a1 V + a2 V² + a3 V³, V in kV.
using AnodeTable = std::array<std::array<double, 4>, 55>;
const AnodeTable& anode_table(Anode anode);

}  // namespace breast
