// SPDX-License-Identifier: GPL-3.0-or-later
// Contrasts of breast MR that phantoms can be imaged with, from a signal equation of water and fat.
#pragma once

#include <cstdint>

#include "image/volume.hpp"
#include "phantom/matter.hpp"

namespace breast {

/// Transverse magnetisation of the water and of the fat in a voxel; 1000 is that of fat in fat.
struct WaterFat {
  double water = 0, fat = 0;
  double in_phase() const { return water + fat; }
};

/// Of a spoiled gradient echo in its steady state, TR 5 ms and 10 degrees:
///     M = M0 sin(a) (1 - E1) / (1 - cos(a) E1),   E1 = exp(-TR / T1),
/// with proton densities and T1 at 3 T of the matter's water (Rakow-Penner et al., J. Magn. Reson.
/// Imaging 23:87 (2006); Stanisz et al., Magn. Reson. Med. 54:507 (2005)) and its share of fat.
WaterFat matter_water_fat(Matter matter);

/// Share of fat's signal that saturation has to leave for muscle to be `muscle_over_fat` times as
/// bright as fat. Throws Error (input) outside 0.9 to what water in fat allows (about 10).
double fat_left(double muscle_over_fat);

/// Weight from 0 to 1 of a region at the side of the body and its lower end, where saturation fails
/// or water and fat are exchanged: it holds `share` of the voxels in which `body` is positive, ends
/// over about 8 mm, and lies on the left for odd seeds.
Volume<float> failing_region(const Volume<float>& body, double share, std::uint64_t seed);

/// Signals of the whole image. `failing` may be empty.
struct SignalImages {
  Volume<float> water, fat;
};
/// Where `failing` is above one half, water and fat are exchanged.
SignalImages exchanged(SignalImages images, const Volume<float>& failing);
/// Water, and of fat the share `left`, or all of it as far as saturation is `failing`.
Volume<float> saturated(const SignalImages& images, double left, const Volume<float>& failing);

}  // namespace breast
