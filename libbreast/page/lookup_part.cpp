// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/table.hpp"
#include "page/parts.hpp"
#include "page/script_text.hpp"

namespace breast {

namespace {

constexpr double unit = 0.01;  // mm of the packed lengths
constexpr std::size_t most_nodes = 14000;

template <class Integer>
Integer packed(double value, double step) {
  constexpr double low = std::numeric_limits<Integer>::min(),
                   high = std::numeric_limits<Integer>::max();
  return Integer(std::clamp(std::round(value / step), low, high));
}

// The nodes kept from a grid: every `stride`-th along both axes.
struct Thinned {
  int stride = 1, nu = 0, nv = 0;
  std::vector<std::size_t> nodes;  // of the lookup, v outermost
  std::size_t in_tissue = 0;
};

Thinned every(int stride, const MatchLookup& lookup) {
  Thinned grid{stride, 1 + (lookup.nu - 1) / stride, 1 + (lookup.nv - 1) / stride, {}, 0};
  for (int j = 0; j < grid.nv; ++j) {
    for (int i = 0; i < grid.nu; ++i) {
      grid.nodes.push_back(lookup.node(i * stride, j * stride));
      grid.in_tissue += lookup.status[grid.nodes.back()] != 0;
    }
  }
  return grid;
}

Thinned small_enough(const MatchLookup& lookup) {
  Thinned grid = every(1, lookup);
  while (grid.in_tissue > most_nodes) grid = every(grid.stride + 1, lookup);
  return grid;
}

}  // namespace

std::string lookup_json(const MatchLookup& lookup, const Vec3& middle) {
  const Thinned grid = small_enough(lookup);
  std::vector<std::uint8_t> status;
  std::vector<std::uint16_t> depth, deviation;
  std::vector<std::int16_t> curve, imaged;
  std::vector<std::int8_t> across;
  for (const std::size_t node : grid.nodes) {
    status.push_back(lookup.status[node]);
    if (lookup.status[node] == 0) continue;
    depth.push_back(packed<std::uint16_t>(lookup.depth[node], unit));
    const std::size_t first = node * std::size_t(lookup.samples);
    for (std::size_t at = first; at < first + std::size_t(lookup.samples); ++at) {
      deviation.push_back(packed<std::uint16_t>(lookup.deviation[at], unit));
      for (std::size_t c = 0; c < 2; ++c) {
        curve.push_back(packed<std::int16_t>(lookup.curve[2 * at + c], unit));
        across.push_back(packed<std::int8_t>(lookup.across[2 * at + c], 1.0 / 127));
      }
      for (std::size_t c = 0; c < 3; ++c) {
        imaged.push_back(packed<std::int16_t>(lookup.imaged[3 * at + c] - middle[int(c)], unit));
      }
    }
  }
  return "{\"pitch\":" + format_number(lookup.pitch * grid.stride) +
         ",\"nu\":" + std::to_string(grid.nu) + ",\"nv\":" + std::to_string(grid.nv) +
         ",\"samples\":" + std::to_string(lookup.samples) + ",\"status\":" + script_array(status) +
         ",\"depth\":" + script_array(depth) + ",\"curve\":" + script_array(curve) +
         ",\"deviation\":" + script_array(deviation) + ",\"across\":" + script_array(across) +
         ",\"imaged\":" + script_array(imaged) + "}";
}

}  // namespace breast
