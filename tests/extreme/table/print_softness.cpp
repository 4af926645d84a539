// SPDX-License-Identifier: GPL-3.0-or-later
// Prints the table of softness of a mesh as TSV, two rows a cell, backward and forward to supine:
//
//     print_softness MESH.vtkhdf [NAME]    cells whose name contains NAME
//
// Without a mesh ("-") the cap of the tests. The nipple's motion is from prone to supine.
#include <cstdio>
#include <exception>

#include "core/blas.hpp"
#include "core/parallel.hpp"
#include "extreme/table/softness.hpp"
#include "fixtures/sliding_cap.hpp"
#include "io/mesh_file.hpp"

namespace breast::extreme {
namespace {

void print(const std::string& cell, const char* direction, const Equilibrium& found,
           double nipple_mm, double closure_mm) {
  std::printf("%s\t%s\t%s\t%s\t%d\t%d\t%d\t%.3f\t", cell.c_str(), direction,
              found.converged() ? "converged" : found.reason_id.c_str(),
              found.stable ? "yes" : "no", found.steps, found.newton_iterations,
              found.factorisations, found.min_det_F);
  if (nipple_mm >= 0) {
    std::printf("%.1f\t%.1e", nipple_mm, closure_mm);
  } else {
    std::printf("-\t-");
  }
  std::printf("\t%s\n", found.record.reason.c_str());
  std::fflush(stdout);
}

void print(const Softness& cell, const HexMesh& mesh,
           const std::shared_ptr<const LevelSurface>& surface) {
  const SoftnessRow row = solve(mesh, cell.options(surface));
  print(cell.name(), "backward", row.backward, -1, 0);
  if (!row.has_body) return;
  double moved = -1;
  if (const Landmark* nipple = mesh.landmark("nipple"); nipple && row.supine.converged()) {
    moved = (landmark_position(mesh, row.supine.points, *nipple) -
             landmark_position(mesh, mesh.imaged, *nipple))
                .norm();
  }
  print(cell.name(), "forward", row.supine, moved, row.closure_mm);
}

}  // namespace
}  // namespace breast::extreme

int main(int argc, char** argv) {
  using namespace breast;
  try {
    set_threads(0);
    prepare_blas();
    const std::string file = argc > 1 ? argv[1] : "-", part = argc > 2 ? argv[2] : "";
    const bool cap = file == "-";
    const HexMesh mesh = cap ? fixtures::cap_on_sphere() : read_mesh(file);
    std::printf(
        "cell\tdirection\toutcome\tstable\tsteps\tnewton\tfactorisations\tmin_det_F\t"
        "nipple_mm\tclosure_mm\treason\n");
    for (const extreme::Softness& cell : extreme::softness_cells()) {
      if (cell.name().find(part) == std::string::npos) continue;
      extreme::print(cell, mesh, cap ? fixtures::sphere() : nullptr);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "print_softness: %s\n", error.what());
    return 1;
  }
  return 0;
}
