// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <set>

#include "core/table.hpp"
#include "page/parts.hpp"
#include "page/script_text.hpp"

namespace breast {

namespace {

std::string edges_json(const HexMesh& mesh, const std::vector<Face>& faces) {
  std::set<std::pair<int, int>> edges;
  for (const Face& face : faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    for (int k = 0; k < 4; ++k) {
      const int a = nodes[std::size_t(k)], b = nodes[std::size_t((k + 1) % 4)];
      edges.insert({std::min(a, b), std::max(a, b)});
    }
  }
  std::vector<float> ends;
  for (const auto& [a, b] : edges) {
    for (const int node : {a, b}) {
      for (int k = 0; k < 3; ++k) ends.push_back(float(mesh.imaged[std::size_t(node)][k]));
    }
  }
  return script_array(ends);
}

}  // namespace

std::string numbers_json(const std::vector<double>& values) {
  std::string list;
  for (const double value : values) list += (list.empty() ? "" : ",") + format_number(value);
  return "[" + list + "]";
}

Box imaged_box(const HexMesh& mesh) {
  Box box{mesh.imaged.front(), mesh.imaged.front()};
  for (const Vec3& x : mesh.imaged) {
    box.low = box.low.cwiseMin(x);
    box.high = box.high.cwiseMax(x);
  }
  return box;
}

std::string body_json(const HexMesh& mesh) {
  const Vec3 middle = imaged_box(mesh).middle();
  std::string landmarks;
  for (const char* name : {"nipple", "tumour"}) {
    const Landmark* landmark = mesh.landmark(name);
    if (landmark == nullptr) continue;
    const Vec3 at = landmark_position(mesh, mesh.imaged, *landmark);
    landmarks += (landmarks.empty() ? "" : ",") + ("{\"name\":" + script_text(landmark->name)) +
                 ",\"at\":" + numbers_json({at.x(), at.y(), at.z()}) + "}";
  }
  return "{\"middle\":" + numbers_json({middle.x(), middle.y(), middle.z()}) +
         ",\"skin\":" + edges_json(mesh, mesh.skin_faces) +
         ",\"wall\":" + edges_json(mesh, mesh.pectoral_faces) +
         ",\"cut\":" + edges_json(mesh, mesh.cut_faces) + ",\"landmarks\":[" + landmarks + "]}";
}

}  // namespace breast
