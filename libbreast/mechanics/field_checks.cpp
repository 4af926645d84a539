// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/field_checks.hpp"

#include <cmath>

#include "core/error.hpp"
#include "mechanics/pressure_filter.hpp"

namespace breast {

namespace {
/// Oscillation relative to the spread of the pressures: 8-node elements have 0.3 to 0.42 on every
/// breast, which the filter removes from the reported values.
constexpr double much_oscillation = 0.5;
/// Fraction of the skin's area; below it there are only one or two folds at a rim or at the edge of
/// a plate.
constexpr double much_wrinkling = 0.02;
/// Wrinkles as long as the breast is deep: the formula holds for skin on an infinitely deep body.
constexpr double longest_meaningful_mm = 100;

std::string length_of_wrinkles(double mm) {
  if (mm > longest_meaningful_mm) return message("longer than ", longest_meaningful_mm, " mm");
  return message("up to ", std::round(mm), " mm");
}
}  // namespace

void check_fields(const Scene& scene, Equilibrium& equilibrium) {
  const HexMesh& mesh = scene.mesh();
  if (scene.options().element == Element::q1p0) {
    equilibrium.pressure_quality =
        pressure_quality(mesh, equilibrium.points, equilibrium.pressure,
                         filter_pressure(mesh, equilibrium.points, equilibrium.pressure));
  }
  for (const auto& [tissue, quality] : equilibrium.pressure_quality) {
    const double share = quality.checkerboard;
    if (share > much_oscillation) {
      equilibrium.doubts.push_back(
          message("pressures of ", tissue_name(tissue), " oscillate from element to element (",
                  std::round(100 * share),
                  " % of their spread): trust only the filtered range in the "
                  "report, or use --element q2p1"));
    }
  }
  equilibrium.skin =
      skin_state(mesh, scene.options().materials, equilibrium.reference, equilibrium.points);
  if (equilibrium.skin.wrinkling > 0 && equilibrium.skin.wrinkling_share > much_wrinkling) {
    equilibrium.doubts.push_back(message(
        "the skin is compressed enough to wrinkle over two elements or more on ",
        std::round(1000 * equilibrium.skin.wrinkling_share) / 10, " % of its area (wrinkles ",
        length_of_wrinkles(equilibrium.skin.longest_wrinkle_mm),
        "): the folds there depend on the mesh"));
  }
}

}  // namespace breast
