// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/matter.hpp"

namespace breast {

double matter_signal(Matter matter) {
  static constexpr std::array<double, n_matters> signal = {0,   430, 360, 1000, 640, 330, 215, 45,
                                                           620, 300, 30,  190,  110, 290, 230};
  return signal[std::size_t(matter)];
}

Tissue breast_tissue(Matter matter) {
  switch (matter) {
    case Matter::air:
      return Tissue::air;
    case Matter::skin:
    case Matter::nipple:
      return Tissue::skin;
    case Matter::gland:
      return Tissue::fibroglandular;
    default:
      return Tissue::fat;
  }
}

}  // namespace breast
