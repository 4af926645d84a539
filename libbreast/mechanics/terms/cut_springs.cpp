// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/terms/cut_springs.hpp"

#include <algorithm>
#include <functional>

namespace breast {

CutSprings springs_at_cut(const HexMesh& mesh, const CutOption& cut) {
  if (cut.kind != Cut::spring || mesh.cut_faces.empty()) return {};
  const auto springs = [&](double stiffness, const std::function<double(const Vec3&)>& factor) {
    return std::make_shared<ElasticSupport>(mesh, mesh.cut_faces,
                                            SupportStiffness{stiffness, stiffness}, nullptr, factor);
  };
  if (!cut.sternal) return {springs(cut.stiffness, {}), nullptr};
  const double medial = -lateral_sign(mesh.side);
  const auto towards_sternum = [medial](const Vec3& normal) {
    const double t = std::max(0.0, medial * normal.x());
    return t * t;
  };
  return {springs(cut.stiffness, [&](const Vec3& n) { return 1 - towards_sternum(n); }),
          springs(*cut.sternal, towards_sternum)};
}

}  // namespace breast
