// SPDX-License-Identifier: GPL-3.0-or-later
// tetrahedra: the body of a hexahedral mesh in tetrahedra, for other solvers.
#include "tetrahedra/delaunay.hpp"

#include <cmath>

#include "cli/tool.hpp"
#include "core/error.hpp"
#include "io/mesh_file.hpp"
#include "io/tet_mesh_file.hpp"
#include "mesh/quality.hpp"
#include "meshing/boundary_surface.hpp"
#include "tetrahedra/report.hpp"
#include "tetrahedra/tissue.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path mesh, tetrahedra;
  double edge = 0;
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Fills the body of a hexahedral mesh with Delaunay tetrahedra for other solvers. The "
      "surface is the same, and the lines between skin, cut and chest wall are preserved as "
      "edges; each tetrahedron takes the tissue of the hexahedron that contains its centroid. "
      "hexmesh --tetrahedra does the same in one step.");
  tool.describe(
      "The program needs CGAL (Debian's `libcgal-dev`), which no other program does, and is built on "
      "demand: `cmake --preset release`, then `cmake --build build/release --target tetrahedra`.");
  tool.cite("Jamin et al. 2015, CGALmesh, ACM Trans Math Softw 41(4)");
  tool.input(c.mesh, "MESH.vtkhdf", "hexahedral mesh in any shape");
  tool.output(c.tetrahedra, "OUT.vtu",
              "tetrahedra and boundary triangles, with a tissue per tetrahedron and a part per "
              "triangle (0 skin, 1 lateral cut, 2 chest wall)");
  tool.number(c.edge, "--edge", "MM",
              "edge length; 0 takes the edge of a cube that has the mean volume of the hexahedra",
              0, 1000);
  tool.check([&c] {
    if (c.tetrahedra.extension() != ".vtu")
      throw input_error(c.tetrahedra.string(), ": must end in .vtu");
  });
  tool.example("tetrahedra mesh.vtkhdf body.vtu", "edges about as long as the hexahedra's");
  tool.example("tetrahedra cc.vtkhdf compressed.vtu --edge 4",
               "a finer mesh of the compressed body");
}

void run_tetrahedra(const Choices& c, Run& run) {
  const HexMesh hexahedra = read_mesh(c.mesh);
  const double volume = mesh_volume(hexahedra, hexahedra.points);
  const double edge = c.edge > 0 ? c.edge : std::cbrt(volume / hexahedra.elements());
  TetMesh mesh = [&] {
    Timer::Scope phase(run.timer(), "delaunay");
    return delaunay_tetrahedra(boundary_surface(hexahedra), edge);
  }();
  copy_tissue(hexahedra, mesh);
  mesh.history = run.history({{c.mesh, hexahedra.content_sha256, &hexahedra.history}});
  write_report(mesh, volume, run.report());
  write_tet_mesh(c.tetrahedra, mesh);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("tetrahedra", "tetrahedra of a mesh's body, for other solvers");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_tetrahedra(c, run); });
}
