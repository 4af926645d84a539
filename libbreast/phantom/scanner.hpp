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

/// Magnitude of a signal: signal × sensitivity × texture with Rician noise of standard deviation
/// noise_percent of 1000, the signal of fat in T1, in each quadrature channel; 16 bit. Images of one
/// scan have other noise, drawn from `image_number`, and the rest in common.
Volume<std::int16_t> magnitude(const Volume<float>& signal, const Volume<float>& sensitivity,
                               double noise_percent, std::uint64_t seed, int image_number = 0);

/// The image in the contrast of T1, fat about 1000.
Volume<std::int16_t> scan(const PhantomImage& image, const MriParameters& parameters,
                          std::uint64_t seed);

/// How the parts of an image are shown in other contrasts.
struct ContrastParameters {
  double muscle_over_fat = 4;  ///< where fat is suppressed
  double failed_percent =
      0;  ///< of the body, where suppression fails, or water and fat are exchanged
};
/// The image with suppressed fat. It needs `image.parts`.
Volume<std::int16_t> suppressed_scan(const PhantomImage& image, const MriParameters& parameters,
                                     const ContrastParameters& contrast, std::uint64_t seed);
/// Water and fat of a Dixon scan. It needs `image.parts`.
struct DixonScan {
  Volume<std::int16_t> water, fat;
};
DixonScan dixon_scan(const PhantomImage& image, const MriParameters& parameters,
                     const ContrastParameters& contrast, std::uint64_t seed);

}  // namespace breast
