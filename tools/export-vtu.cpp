// SPDX-License-Identifier: GPL-3.0-or-later
// export-vtu: any mesh as .vtu, for programs that do not read VTKHDF.
#include "cli/tool.hpp"
#include "core/error.hpp"
#include "io/mesh_file.hpp"
#include "io/state_file.hpp"

using namespace breast;

namespace {

struct Choices {
  std::filesystem::path mesh, out;
};

void declare(Tool& tool, Choices& c) {
  tool.describe(
      "Writes a mesh in any shape (mesh, reference, supine, cc, mlo) as a VTK XML file, for programs that "
      "do not read VTKHDF, such as meshio, 3D Slicer and ParaView before 5.10. The file has the "
      "hexahedra with their tissue, determinant and pressure, and the nodes with their displacements from the "
      "scan and from the stress-free shape and the contact pressure; what the mesh lacks is left out. "
      "Coordinates are LPS in mm. No tool reads this file back, since it has no landmarks, parts or model.");
  tool.input(c.mesh, "MESH.vtkhdf", "hexahedral mesh in any shape");
  tool.output(c.out, "OUT.vtu", "hexahedra with 8 or 27 nodes");
  tool.check([&c] {
    if (c.out.extension() != ".vtu") throw input_error(c.out.string(), ": must end in .vtu");
  });
  tool.example("export-vtu supine.vtkhdf supine.vtu",
               "then in Python: meshio.read(\"supine.vtu\")");
}

void run_export(const Choices& c, Run& run) {
  HexMesh mesh = read_mesh(c.mesh, {.contact = true});
  mesh.history = run.history({{c.mesh, mesh.content_sha256, &mesh.history}});
  run.report().set("elements", mesh.elements());
  run.report().set("nodes", mesh.nodes());
  write_state(c.out, mesh);
}

}  // namespace

int main(int argc, char** argv) {
  Choices c;
  Tool tool("export-vtu", "a mesh as .vtu, for programs that do not read VTKHDF");
  declare(tool, c);
  return tool.main(argc, argv, [&c](Run& run) { run_export(c, run); });
}
