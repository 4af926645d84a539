// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/terms/attachment.hpp"

#include "core/error.hpp"
#include "core/units.hpp"
#include "mechanics/terms/toe_spring.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"

namespace breast {

Attachment::Attachment(const HexMesh& mesh, const std::vector<Face>& faces, double stiffness,
                       const Vec3& towards, const FaceWeight& factor)
    : towards_(towards) {
  if (!(stiffness > 0)) {
    throw input_error("an attachment of ", stiffness, " kPa/mm: it must be above 0");
  }
  const NodalFaces spread = nodal_faces(mesh, faces, flatten(mesh.imaged), factor);
  for (const int node : nodes_of(mesh, faces)) {
    const double area = spread.area[std::size_t(node)];
    if (!(area > 0)) continue;
    cells_.nodes.push_back(node);
    stiffness_.push_back(stiffness * area * pascal_per_kilopascal);
  }
}

std::optional<NodeSprings::Spring> Attachment::spring(const State& state, int i) const {
  const long at = 3L * cells_.nodes[std::size_t(i)];
  const ToeSpring now =
      toe_spring((state.reference.segment<3>(at) - state.x.segment<3>(at)).dot(towards_), toe_mm,
                 stiffness_[std::size_t(i)]);
  Spring out;
  out.energy = now.energy;
  out.force = -now.force * towards_;
  out.tangent = now.stiffness * towards_ * towards_.transpose();
  out.by_reference = -out.tangent;
  return out;
}

}  // namespace breast
