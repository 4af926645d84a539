// SPDX-License-Identifier: GPL-3.0-or-later
#include "projection/framing.hpp"

#include <algorithm>
#include <limits>

#include "core/error.hpp"
#include "mesh/compressed_pose.hpp"

namespace breast {

namespace {

constexpr double air_margin = 4;  // mm of air shown around the breast

double detector_height(const HexMesh& mesh, const Vec3& n) {
  double lowest = -std::numeric_limits<double>::infinity();
  for (const Vec3& x : mesh.points) lowest = std::max(lowest, x.dot(n));
  for (const PlateRecord& plate : mesh.contact->plates) {
    if (plate.name == "detector") return std::max(lowest, plate.origin.dot(n));
  }
  return lowest;
}

double posterior_edge(const HexMesh& mesh, const Vec3& e_u) {
  if (mesh.contact->ends_image) return mesh.contact->plates.back().origin.dot(e_u);
  double edge = std::numeric_limits<double>::infinity();
  for (const Vec3& x : mesh.points) edge = std::min(edge, x.dot(e_u));
  for (const auto* set : {&mesh.pectoral_faces, &mesh.cut_faces}) {
    for (const int node : nodes_of(mesh, *set)) edge = std::max(edge, mesh.points[node].dot(e_u));
  }
  return edge;
}

}  // namespace

ImageFrame image_frame(const HexMesh& mesh, Beam beam) {
  if (!mesh.contact) {
    throw input_error("mesh has no compression record: run compress first");
  }
  ImageFrame frame;
  frame.view = mesh.contact->view;
  frame.pose = compressed_pose(mesh);
  ViewPose& pose = frame.pose;
  const double u0 = posterior_edge(mesh, pose.e_u);
  // Range of v of the visible tissue: elements that extend in front of the edge.
  double lower = std::numeric_limits<double>::infinity(), upper = -lower;
  for (int e = 0; e < mesh.elements(); ++e) {
    const int* nodes = mesh.element(e);
    const int n = mesh.nodes_per_element();
    if (std::none_of(nodes, nodes + n, [&](int i) { return mesh.points[i].dot(pose.e_u) > u0; })) {
      continue;
    }
    for (int a = 0; a < n; ++a) {
      const double v = mesh.points[nodes[a]].dot(pose.e_v);
      lower = std::min(lower, v);
      upper = std::max(upper, v);
    }
  }
  if (!(upper > lower)) {
    throw input_error(
        "mesh: there is no tissue in front of its chest-wall and cut surfaces to be imaged");
  }
  pose.origin =
      u0 * pose.e_u + 0.5 * (lower + upper) * pose.e_v + detector_height(mesh, pose.n) * pose.n;
  if (beam == Beam::cone) pose.source_distance = source_distance_mm;
  Vec2 low(0, std::numeric_limits<double>::infinity()), high = -low;
  for (const Vec3& x : mesh.points) {
    if (!(x.dot(pose.e_u) >= u0)) continue;
    const Vec2 uv = pose.project(x);
    low = low.cwiseMin(uv);
    high = high.cwiseMax(uv);
  }
  low.y() = std::min(low.y(), 0.5 * (lower - upper)) - air_margin;
  high.y() = std::max(high.y(), 0.5 * (upper - lower)) + air_margin;
  pose.origin += low.y() * pose.e_v;
  pose.source_v = beam == Beam::cone ? -low.y() : 0;
  frame.width = high.x() + air_margin;
  for (const PlateRecord& plate : mesh.contact->plates) {
    frame.plate_edge_u = std::max(frame.plate_edge_u, pose.project(plate.origin).x());
  }
  frame.height = high.y() - low.y();
  return frame;
}

}  // namespace breast
