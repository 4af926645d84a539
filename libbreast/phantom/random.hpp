// SPDX-License-Identifier: GPL-3.0-or-later
// Counter-based random numbers: every number is a pure function of seed and index, so that results
// do not depend on threads or on the order of evaluation.
#pragma once

#include <cstdint>

#include "core/types.hpp"

namespace breast {

/// Well-mixed 64 bits of (seed, index) (the finaliser of SplitMix64, Steele et al. 2014, twice).
std::uint64_t mix(std::uint64_t seed, std::uint64_t index);
/// Uniform in [0,1).
double uniform(std::uint64_t seed, std::uint64_t index);
/// Two independent standard normal numbers (Box-Muller).
Vec2 normal_pair(std::uint64_t seed, std::uint64_t index);

/// Smooth gradient noise on the unit lattice (Perlin 2002), within [-1,1], C2.
double lattice_noise(std::uint64_t seed, const Vec3& point);

/// A small sequential stream for building trees and parameters (serial code only).
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : seed_(seed) {}
  double uniform(double low = 0, double high = 1);
  double normal(double mean = 0, double deviation = 1);

 private:
  std::uint64_t seed_;
  std::uint64_t count_ = 0;
};

}  // namespace breast
