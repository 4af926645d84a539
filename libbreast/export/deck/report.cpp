// SPDX-License-Identifier: GPL-3.0-or-later
#include "export/deck/report.hpp"

#include "core/units.hpp"

namespace breast {

void write_report(const DeckScene& scene, const std::string& element, Report& report) {
  report.set("elements", scene.elements());
  report.set("nodes", scene.nodes.size());
  report.set("held_nodes", scene.held.size());
  report.set("element", element);
}

void write_balance(const DeckScene& scene, const Vec3& reaction, Report& report) {
  if (!scene.rolling.empty()) return;
  Vec3 weight = Vec3::Zero();
  for (const Vec3& force : free_load(scene)) weight += force;
  report.set("weight_on_free_nodes_N", weight / micronewton_per_newton);
  report.set("reaction_N", reaction / micronewton_per_newton);
  report.set("force_balance", (reaction + weight).norm() / weight.norm());
}

Table write_difference(const NodeDifference& d, const HexMesh& mesh, Report& report) {
  const double relative = d.max_mm / d.largest_displacement_mm;
  report.set("difference/mean_mm", d.mean_mm);
  report.set("difference/max_mm", d.max_mm);
  report.set("difference/largest_displacement_mm", d.largest_displacement_mm);
  report.set("difference/relative", relative);
  report.set("difference/worst_at", mesh.imaged[d.worst_node]);
  return {{"mean_mm", "max_mm", "largest_displacement_mm", "relative"},
          {{format_fixed(d.mean_mm, 5), format_fixed(d.max_mm, 5),
            format_fixed(d.largest_displacement_mm, 4), format_fixed(relative, 6)}}};
}

}  // namespace breast
