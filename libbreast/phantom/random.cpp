// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/random.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/elementary.hpp"

namespace breast {

namespace {
std::uint64_t finalise(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

// Dot product of `d` with the pseudo-random gradient (one of 12, Perlin 2002) of the lattice point.
double lattice_slope(std::uint64_t seed, std::int64_t i, std::int64_t j, std::int64_t k, double x,
                     double y, double z) {
  const auto key = std::uint64_t(i) * 0x9e3779b97f4a7c15ULL +
                   std::uint64_t(j) * 0xc2b2ae3d27d4eb4fULL +
                   std::uint64_t(k) * 0x165667b19e3779f9ULL;
  const std::uint64_t hash = finalise(seed ^ key) >> 33;
  const double u = hash & 1 ? 1.0 : -1.0, v = hash & 2 ? 1.0 : -1.0;
  switch ((hash >> 2) % 3) {
    case 0:
      return u * x + v * y;
    case 1:
      return u * y + v * z;
    default:
      return u * z + v * x;
  }
}
}  // namespace

std::uint64_t mix(std::uint64_t seed, std::uint64_t index) {
  return finalise(finalise(seed + 0x9e3779b97f4a7c15ULL) + index * 0x9e3779b97f4a7c15ULL);
}

double uniform(std::uint64_t seed, std::uint64_t index) {
  return double(mix(seed, index) >> 11) * 0x1.0p-53;
}

Vec2 normal_pair(std::uint64_t seed, std::uint64_t index) {
  const double u = 1.0 - uniform(seed, 2 * index);
  const double angle = 2 * std::numbers::pi * uniform(seed, 2 * index + 1);
  const double radius = std::sqrt(-2 * elementary::log(u));
  return {radius * elementary::cos(angle), radius * elementary::sin(angle)};
}

double lattice_noise(std::uint64_t seed, const Vec3& point) {
  std::int64_t cell[3];
  double t[3], weight[3];
  for (int a = 0; a < 3; ++a) {
    const double floor = std::floor(point[a]);
    cell[a] = std::int64_t(floor);
    t[a] = point[a] - floor;
    weight[a] = t[a] * t[a] * t[a] * (t[a] * (6 * t[a] - 15) + 10);
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int di = corner & 1, dj = corner >> 1 & 1, dk = corner >> 2;
    sum += (di ? weight[0] : 1 - weight[0]) * (dj ? weight[1] : 1 - weight[1]) *
           (dk ? weight[2] : 1 - weight[2]) *
           lattice_slope(seed, cell[0] + di, cell[1] + dj, cell[2] + dk, t[0] - di, t[1] - dj,
                         t[2] - dk);
  }
  return sum;
}

double RandomStream::uniform(double low, double high) {
  return low + (high - low) * breast::uniform(seed_, count_++);
}

double RandomStream::normal(double mean, double deviation) {
  return mean + deviation * normal_pair(seed_, count_++)[0];
}

}  // namespace breast
