// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/terms/cut_springs.hpp"

#include <algorithm>

namespace breast {

CutSprings springs_at_cut(const HexMesh& mesh, const CutOption& cut) {
  if (!cut.has_springs() || mesh.cut_faces.empty()) return {};
  CutSprings springs;
  springs.around = std::make_shared<ElasticSupport>(mesh, mesh.cut_faces,
                                                    SupportStiffness{cut.stiffness, cut.stiffness});
  if (!cut.sternal) return springs;
  const Vec3 medial(-lateral_sign(mesh.side), 0, 0);
  springs.sternal = std::make_shared<Attachment>(
      mesh, mesh.cut_faces, *cut.sternal, medial, [&medial](const Vec3& normal) {
        const double t = std::max(0.0, medial.dot(normal));
        return t * t;
      });
  return springs;
}

}  // namespace breast
