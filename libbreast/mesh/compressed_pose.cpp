// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/compressed_pose.hpp"

namespace breast {

ViewPose compressed_pose(const HexMesh& mesh) {
  const ContactRecord& contact = *mesh.contact;
  return view_pose(mesh.side, contact.angle_deg, contact.turn_deg, contact.lean_deg,
                   contact.bend_deg);
}

}  // namespace breast
