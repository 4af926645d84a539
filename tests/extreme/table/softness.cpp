// SPDX-License-Identifier: GPL-3.0-or-later
#include "extreme/table/softness.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/units.hpp"

namespace breast::extreme {

namespace {

constexpr double support = 0.01;  // kPa/mm, at wall and cut of a breast that slides

const char* skin_name(SkinCase skin) {
  switch (skin) {
    case SkinCase::paper:
      return "paper";
    case SkinCase::tension_field:
      return "tension-field";
    case SkinCase::stiff:
      return "x10";
  }
  return "";
}

}  // namespace

std::string Softness::name() const {
  return message(percent, " % ", slides ? "slide" : "held", ", skin ", skin_name(skin));
}

MechanicsOptions Softness::options(std::shared_ptr<const LevelSurface> surface) const {
  MechanicsOptions out;
  out.materials = load_materials("seed2008");
  for (const Tissue tissue : {Tissue::fat, Tissue::fibroglandular}) {
    Law& law = out.materials.laws[std::size_t(tissue)];
    law = law.scaled(percent / 100);
  }
  Law& law = out.materials.laws[std::size_t(Tissue::skin)];
  if (skin == SkinCase::stiff) law = law.scaled(10);
  if (skin == SkinCase::tension_field) {
    out.materials.skin.kept = 0.05;
    out.materials.skin.prestretch = 0.03;
  }
  if (slides) {
    out.wall = wall_support(message("slide:", support));
    out.wall_surface = std::move(surface);
    out.cut = cut_support(message("spring:", support));
  }
  return out;
}

std::vector<Softness> softness_cells() {
  std::vector<Softness> cells;
  for (const double percent : {100.0, 50.0, 20.0, 10.0, 5.0, 3.0, 2.0, 1.0, 0.5}) {
    for (const bool slides : {false, true}) {
      for (const SkinCase skin : {SkinCase::paper, SkinCase::tension_field, SkinCase::stiff}) {
        cells.push_back({percent, slides, skin});
      }
    }
  }
  return cells;
}

SoftnessRow solve(HexMesh mesh, const MechanicsOptions& options) {
  const Vec3 prone(0, -gravity_mm_s2, 0);
  SoftnessRow row;
  row.backward = solve_backward(mesh, prone, options);
  row.has_body = row.backward.converged();
  if (!row.has_body) return row;
  store(row.backward, mesh);
  row.supine = solve_forward(mesh, -prone, options);
  row.prone = solve_forward(mesh, prone, options);
  if (!row.prone.converged()) return row;
  for (int i = 0; i < mesh.nodes(); ++i) {
    const double apart = (row.prone.points[std::size_t(i)] - mesh.imaged[std::size_t(i)]).norm();
    row.closure_mm = std::max(row.closure_mm, apart);
  }
  return row;
}

}  // namespace breast::extreme
