// SPDX-License-Identifier: GPL-3.0-or-later
// Simulation of quantum noise and scattered radiation in a noise-free image.
#pragma once

#include <cstdint>

#include "projection/mammogram.hpp"

namespace breast {

struct Exposure {
  /// Scattered fraction of the radiation that leaves the breast: about 0.1 with a grid, 0.3-0.5
  /// without.
  double scatter_fraction = 0;
  double photons_per_mm2 = 0;  ///< detected without a breast; 0: no noise
  std::uint64_t seed = 1;
};

/// Adds scatter and noise. Scatter is the primary radiation that passed tissue, spread by
/// exp(−|x|/8 mm) along each image axis. Noise is Poisson noise with a stream fixed by seed and
/// row, so that it does not depend on the number of threads. `path` becomes −ln of the detected
/// signal, at least 0. Throws Error (input) for a tissue fraction image (it has no photons) and for
/// a scatter fraction outside [0, 0.9].
void expose(Mammogram& image, const Exposure& exposure);

}  // namespace breast
