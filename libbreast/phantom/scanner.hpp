// SPDX-License-Identifier: GPL-3.0-or-later
// Simulation of the magnitude image from the sampled matter: coil sensitivity, tissue texture,
// Rician noise.
#pragma once

#include "phantom/imaging.hpp"

namespace breast {

/// Smooth receive sensitivity of a breast coil with elements around both breasts. Within the
/// breasts its median is 1, and the ratio of the brightest to the darkest voxel (99th to 1st
/// percentile) is `bias`.
Volume<float> coil_sensitivity(const PhantomImage& image, double bias, std::uint64_t seed);

/// The image: signal × sensitivity × texture with Rician noise of standard deviation noise_percent
/// of the median fat signal in each quadrature channel; 16 bit, fat about 1000.
Volume<std::int16_t> scan(const PhantomImage& image, const MriParameters& parameters,
                          std::uint64_t seed);

}  // namespace breast
