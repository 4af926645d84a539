#include "mechanics/field_checks.hpp"

#include <cmath>

#include "core/error.hpp"
#include "mechanics/pressure_filter.hpp"

namespace breast {

namespace {
constexpr double much_oscillation = 0.3;
}

void check_fields(const HexMesh& mesh, const MechanicsOptions& options,
                  const std::vector<Vec3>& reference, const std::vector<Vec3>& deformed,
                  SolveSummary& summary) {
  if (options.element == Element::q1p0) {
    summary.pressure = pressure_quality(mesh, deformed, mesh.pressure,
                                        filter_pressure(mesh, deformed, mesh.pressure));
  }
  for (const auto& [tissue, quality] : summary.pressure) {
    const double share = quality.checkerboard;
    if (share > much_oscillation) {
      summary.doubts.push_back(message("pressures of ", tissue_name(tissue),
                                       " oscillate from element to element (",
                                       std::round(100 * share),
                                       " % of their spread): trust only the filtered range in the "
                                       "report, or use --element q2p1"));
    }
  }
  summary.skin = skin_state(mesh, options.materials, reference, deformed);
  if (summary.skin.wrinkling > 0) {
    summary.doubts.push_back(message(
        "the skin is compressed enough to wrinkle over two elements or more on ",
        std::round(1000 * summary.skin.wrinkling_share) / 10, " % of its area (wrinkles up to ",
        std::round(summary.skin.longest_wrinkle_mm), " mm): its folds there are the mesh's"));
  }
}

}  // namespace breast
