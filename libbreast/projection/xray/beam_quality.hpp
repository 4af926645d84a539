// SPDX-License-Identifier: GPL-3.0-or-later
// Parsing of the option --energy: tissue fraction, photon energy or X-ray spectrum.
#pragma once

#include <string>

#include "projection/attenuation.hpp"

namespace breast {

/// Parses "fraction", a number of keV (monoenergetic), or "W/Rh:28" or "Mo/Mo:28" (tube spectrum at
/// 22-35 kV and an energy-integrating detector: weight = photons times energy). Any other text is
/// the name of a TSV file with columns energy_keV and weight (of the detector's signal). Throws
/// Error (input).
Energy parse_energy(const std::string& text);

}  // namespace breast
