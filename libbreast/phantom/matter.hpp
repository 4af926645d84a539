// SPDX-License-Identifier: GPL-3.0-or-later
// Materials of the phantom, with finer distinctions than the tissue codes of a label volume.
#pragma once

#include <array>
#include <cstdint>

#include "core/types.hpp"

namespace breast {

enum class Matter : std::uint8_t {
  air,
  skin,
  nipple,
  fat,
  ligament,
  gland,
  muscle,
  cortex,  ///< compact bone
  marrow,
  cartilage,
  lung,
  heart,
  blood,
  liver,
  brawn,  ///< muscle of the back and internal organs
};
inline constexpr int n_matters = 15;

/// Signal of a T1-weighted turbo spin echo without fat suppression, fat = 1000.
double matter_signal(Matter matter);
/// Tissue code of the label volume for matter inside the breast.
Tissue breast_tissue(Matter matter);

}  // namespace breast
