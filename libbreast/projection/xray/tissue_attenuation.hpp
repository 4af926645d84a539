// SPDX-License-Identifier: GPL-3.0-or-later
// Linear attenuation of breast tissues from their elemental composition.
#pragma once

#include "projection/attenuation.hpp"

namespace breast {

/// Compositions and densities of Hammerstein et al., Radiology 130 (1979) 485-491: adipose tissue
/// 0.93, gland 1.04, skin 1.09 g/cm³; cross sections of xraylib (Schoonjans et al., Spectrochim.
/// Acta B 66 (2011) 776). Tumour: gland times 1.052, the ratio of infiltrating carcinoma to
/// fibroglandular tissue measured at 20 keV by Johns and Yaffe, Phys. Med. Biol. 32 (1987) 675.
/// Published values for fat differ by tens of per cent. Throws Error (input) outside 5-100 keV.
Attenuation attenuation_at(double kev);

}  // namespace breast
