// SPDX-License-Identifier: GPL-3.0-or-later
// Mammographic X-ray spectra: anode, tube voltage, filters.
#pragma once

#include <string>
#include <vector>

#include "projection/xray/anode_tables.hpp"

namespace breast {

struct Spectrum {
  std::vector<double> kev;      ///< bin centres
  std::vector<double> fluence;  ///< photons per bin, relative

  double mean_kev() const;  ///< weighted by photon number
  /// Half-value layer: mm of aluminium that halve the air kerma. The kerma per photon is
  /// proportional to E times the mass energy-absorption coefficient of air (xraylib).
  double half_value_layer() const;
};

/// Unfiltered spectrum at 22-35 kV. Throws Error (input) outside this range.
Spectrum anode_spectrum(Anode anode, double kv);
/// The spectrum behind a filter of `mm` of a chemical element (atomic number z, density of the
/// solid).
Spectrum filtered(const Spectrum& spectrum, int z, double mm);

/// The spectrum behind `mm` of dry air of 1.205e-3 g/cm³.
Spectrum behind_air(const Spectrum& spectrum, double mm);

/// Parses "W/Rh:28" or "Mo/Mo:26": peak voltage in kV, 0.05 mm rhodium or 0.03 mm molybdenum, 1 mm
/// beryllium window, 600 mm air.
Spectrum named_spectrum(const std::string& name);
/// Whether the text has the form ANODE/FILTER:KV.
bool names_spectrum(const std::string& text);

}  // namespace breast
