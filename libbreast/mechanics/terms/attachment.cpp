// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/terms/attachment.hpp"

#include "core/error.hpp"
#include "core/units.hpp"
#include "mesh/nodal.hpp"
#include "mesh/nodal_faces.hpp"

namespace breast {

namespace {

/// ψ and its first two derivatives.
struct Stretch {
  double energy = 0, force = 0, stiffness = 0;
};

Stretch stretch(double away) {
  constexpr double w = Attachment::toe_mm;
  if (away <= 0) return {};
  if (away < w) return {away * away * away / (6 * w), away * away / (2 * w), away / w};
  const double beyond = away - w;
  return {w * w / 6 + w * beyond / 2 + beyond * beyond / 2, w / 2 + beyond, 1};
}

}  // namespace

Attachment::Attachment(const HexMesh& mesh, const std::vector<Face>& faces, double stiffness,
                       const Vec3& towards, const std::function<double(const Vec3& normal)>& factor)
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
  const Stretch now =
      stretch((state.reference.segment<3>(at) - state.x.segment<3>(at)).dot(towards_));
  const double k = stiffness_[std::size_t(i)];
  Spring out;
  out.energy = k * now.energy;
  out.force = -k * now.force * towards_;
  out.tangent = k * now.stiffness * towards_ * towards_.transpose();
  out.by_reference = -out.tangent;
  return out;
}

}  // namespace breast
