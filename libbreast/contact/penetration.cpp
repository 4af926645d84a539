// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/penetration.hpp"

#include <algorithm>

#include "mesh/shape.hpp"

namespace breast {

namespace {

constexpr int samples_an_edge = 5;

std::vector<QuadShape> sample_shapes(int order) {
  std::vector<QuadShape> shapes;
  for (int j = 0; j < samples_an_edge; ++j) {
    for (int i = 0; i < samples_an_edge; ++i) {
      shapes.push_back(quad_shape(
          order, {2.0 * i / (samples_an_edge - 1) - 1, 2.0 * j / (samples_an_edge - 1) - 1}));
    }
  }
  return shapes;
}

bool held_fast(const Constraints& held, int node) {
  return held.held(node, 0) && held.held(node, 1) && held.held(node, 2);
}

}  // namespace

std::vector<Face> free_boundary_faces(const HexMesh& mesh, const Constraints& held) {
  std::vector<Face> free;
  for (const auto* faces : {&mesh.skin_faces, &mesh.cut_faces, &mesh.pectoral_faces}) {
    for (const Face& face : *faces) {
      const std::vector<int> nodes = face_nodes(mesh, face);
      const bool moves =
          std::any_of(nodes.begin(), nodes.end(), [&](int n) { return !held_fast(held, n); });
      if (moves) free.push_back(face);
    }
  }
  return free;
}

std::vector<Face> touchable_faces(const HexMesh& mesh) {
  std::vector<Face> faces = mesh.skin_faces;
  faces.insert(faces.end(), mesh.cut_faces.begin(), mesh.cut_faces.end());
  return faces;
}

double deepest_penetration(const HexMesh& mesh, const std::vector<Face>& faces,
                           const Eigen::VectorXd& x, const Plate& plate) {
  const std::vector<QuadShape> shapes = sample_shapes(mesh.order);
  double deepest = 0;
  for (const Face& face : faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (const QuadShape& shape : shapes) {
      Vec3 point = Vec3::Zero();
      for (std::size_t a = 0; a < nodes.size(); ++a) {
        point += shape.values[Eigen::Index(a)] * x.segment<3>(3L * nodes[a]);
      }
      deepest = std::max(deepest, -plate.gap(point).value);
    }
  }
  return deepest;
}

}  // namespace breast
