// SPDX-License-Identifier: GPL-3.0-or-later
#include "tetrahedra/welded_surface.hpp"

#include <algorithm>
#include <map>

#include "core/error.hpp"

namespace breast {

namespace {

// Edges between parts, chained into closed lines.
std::vector<std::vector<int>> closed_lines(std::map<int, std::vector<int>> neighbours) {
  std::vector<std::vector<int>> lines;
  for (auto& [start, ways] : neighbours) {
    if (ways.empty()) continue;
    std::vector<int> line = {start};
    do {
      std::vector<int>& onward = neighbours[line.back()];
      if (onward.empty()) throw input_error("surface: the line between two parts is not closed");
      const int next = onward.back();
      onward.pop_back();
      std::erase(neighbours[next], line.back());
      line.push_back(next);
    } while (line.back() != start);
    lines.push_back(line);
  }
  return lines;
}

}  // namespace

WeldedSurface weld(const TriMesh& surface) {
  const auto parts = surface.point_data.find("part");
  if (parts == surface.point_data.end()) throw input_error("surface: has no scalar 'part'");
  WeldedSurface welded;
  std::map<std::array<double, 3>, int> known;
  std::vector<int> node;
  for (const Vec3& p : surface.points) {
    const auto [entry, fresh] = known.try_emplace({p.x(), p.y(), p.z()}, int(known.size()));
    if (fresh) welded.points.push_back(p);
    node.push_back(entry->second);
  }
  std::map<std::array<int, 2>, int> triangle_at;  // directed edge → triangle
  for (const auto& t : surface.triangles) {
    const int number = int(welded.triangles.size());
    welded.triangles.push_back({node[t[0]], node[t[1]], node[t[2]]});
    welded.part.push_back(int(parts->second[t[0]]));
    for (int c = 0; c < 3; ++c) {
      const bool fresh = triangle_at.try_emplace({node[t[c]], node[t[(c + 1) % 3]]}, number).second;
      if (!fresh)
        throw input_error(
            "surface: two triangles have the same orientation along a "
            "common edge");
    }
  }
  std::map<int, std::vector<int>> seam;
  for (const auto& [edge, triangle] : triangle_at) {
    const auto other = triangle_at.find({edge[1], edge[0]});
    if (other == triangle_at.end()) throw input_error("surface: is not closed");
    if (welded.part[triangle] != welded.part[other->second]) seam[edge[0]].push_back(edge[1]);
  }
  welded.seams = closed_lines(std::move(seam));
  return welded;
}

}  // namespace breast
