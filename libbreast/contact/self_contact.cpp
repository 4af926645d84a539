// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/self_contact.hpp"

#include <algorithm>

#include "contact/face_point.hpp"
#include "contact/penetration.hpp"
#include "core/units.hpp"
#include "mesh/gauss.hpp"
#include "mesh/locate.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

/// Parts of the body closer than this in front of a face count as touching it, mm: ten times the
/// accuracy of the plates.
constexpr double self_touching_mm = 0.5;

double depth_in_thorax(const HexMesh& mesh, const Vec3& at) {
  if (!mesh.geometry || !mesh.geometry->thorax) return 0;
  const std::optional<Level> level = mesh.geometry->thorax->at(at);
  return level ? std::max(0.0, -level->value / level->gradient.norm()) : 0;
}

}  // namespace

SelfContact self_contact(const HexMesh& mesh, const std::vector<Vec3>& x) {
  const Locator body(mesh, x);
  SelfContact found;
  for (const Face& face : touchable_faces(mesh)) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (const auto& [local, weight] : gauss_square(2)) {
      const FacePoint point = face_point(nodes, x, quad_shape(mesh.order, local));
      if (body.find(point.at + self_touching_mm * point.area.normalized())) {
        found.itself_cm2 += weight * point.area.norm() / mm2_per_cm2;
      }
      found.into_thorax_mm = std::max(found.into_thorax_mm, depth_in_thorax(mesh, point.at));
    }
  }
  return found;
}

}  // namespace breast
