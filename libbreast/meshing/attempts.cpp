// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/attempts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace breast {

namespace {

constexpr double most_change = 0.15;  // of the number of elements, for other proportions

/// Domes beside `size` with about as many elements: rows of the cut first, which decide how much of the
/// steep part of the breast is cut; then the height of the core, then its width.
std::vector<DomeSize> other_proportions(const DomeSize& size) {
  constexpr std::array<std::array<int, 4>, 8> changes = {{{0, 0, 0, 1},
                                                          {0, 0, 0, -1},
                                                          {0, 2, -1, 0},
                                                          {0, -2, 1, 0},
                                                          {2, -2, -1, -1},
                                                          {-2, 2, 1, 1},
                                                          {0, 1, 0, 1},
                                                          {0, -1, 0, -1}}};
  std::vector<DomeSize> sizes;
  for (const auto& [dn, dl, dm, dk] : changes) {
    const DomeSize other{size.n + dn, size.l + dl, size.m + dm, size.k + dk};
    const bool possible =
        other.n >= 2 && other.l >= 2 && other.m >= 1 && other.k >= 1 && other.k < other.l;
    if (possible && std::abs(double(other.elements()) / size.elements() - 1) <= most_change)
      sizes.push_back(other);
  }
  return sizes;
}

}  // namespace

std::vector<MeshAttempt> mesh_attempts(const DomeSize& size, const SmoothOptions& smoothing) {
  std::vector<MeshAttempt> attempts{{"", size, smoothing}};
  const int edge = std::max(4, int(std::lround(std::cbrt(double(size.elements())))));
  const DomeSize dome = size.m > 0 ? size : dome_near(edge);
  if (size.m == 0) attempts.push_back({"template", dome, smoothing});
  for (const DomeSize& other : other_proportions(dome))
    attempts.push_back({"layers", other, smoothing});
  SmoothOptions longer = smoothing, looser = smoothing;
  longer.evaluations *= 4;
  attempts.push_back({"smoothing", dome, longer});
  looser = longer;
  looser.tether *= 0.01;
  looser.untangling_rounds *= 4;
  attempts.push_back({"untangling", dome, looser});
  for (const int other : {edge - 1, edge + 1, edge + 2, edge + 4})
    if (other >= 4) attempts.push_back({"elements", dome_near(other), longer});
  return attempts;
}

}  // namespace breast
