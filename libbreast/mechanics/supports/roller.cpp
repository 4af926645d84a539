// SPDX-License-Identifier: GPL-3.0-or-later
// A cut whose nodes move only across its mean normal in the imaged shape.
#include <Eigen/Geometry>

#include "mechanics/supports/supports.hpp"
#include "mesh/nodal.hpp"
#include "solve/constraints.hpp"

namespace breast {

namespace {

class Roller final : public BodySupport {
 public:
  Roller() : BodySupport(SupportPlace::cut, "roller") {}

  std::string clause() const override { return "its cut slides on its mean plane"; }
  void constrain(const HexMesh& mesh, Constraints& constraints) const override;
};

// Area-weighted normals of the faces at their nodes.
void Roller::constrain(const HexMesh& mesh, Constraints& constraints) const {
  std::vector<Vec3> sum(mesh.imaged.size(), Vec3::Zero());
  for (const Face& face : mesh.cut_faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    const Vec3 normal = (mesh.imaged[nodes[2]] - mesh.imaged[nodes[0]])
                            .cross(mesh.imaged[nodes[3]] - mesh.imaged[nodes[1]]);
    for (const int node : nodes) sum[node] += normal;
  }
  for (const int node : nodes_of(mesh, mesh.cut_faces)) {
    constraints.hold_normal(node, sum[node].normalized());
  }
}

}  // namespace

const SupportKind& supports::roller() {
  static const SupportKind kind{{SupportPlace::cut},
                                "roller",
                                "roller",
                                "roller",
                                false,
                                [](const SupportText& text) -> SupportPtr {
                                  text.expect(0, 0);
                                  return std::make_shared<Roller>();
                                }};
  return kind;
}

}  // namespace breast
