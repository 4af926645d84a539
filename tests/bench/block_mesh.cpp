// SPDX-License-Identifier: GPL-3.0-or-later
// The block other programs solved, as a mesh file: a 0.1 m cube of fat without skin, clamped at
// x = 0, with the landmarks A (100, 100, 100) and B (100, 50, 50) mm.
//
//     block_mesh N OUT.vtkhdf           N elements along an edge
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "fixtures/block.hpp"
#include "io/mesh_file.hpp"
#include "mesh/locate.hpp"

namespace {

breast::HexMesh block_with_landmarks(int n) {
  breast::fixtures::BlockSettings settings;
  settings.elements = {n, n, n};
  breast::HexMesh mesh = breast::fixtures::block(settings);
  const breast::Locator locator(mesh, mesh.imaged);
  for (const auto& [name, at] : {std::pair<std::string, breast::Vec3>{"A", {100, 100, 100}},
                                 std::pair<std::string, breast::Vec3>{"B", {100, 50, 50}}}) {
    const breast::Location found = locator.nearest(at);
    mesh.landmarks.push_back({name, at, found.element, found.local, found.moved});
  }
  return mesh;
}

}  // namespace

int main(int argc, char** argv) {
  const long n = argc == 3 ? std::strtol(argv[1], nullptr, 10) : 0;
  if (n < 1 || n > 128) {
    std::fprintf(stderr, "usage: block_mesh N OUT.vtkhdf (N from 1 to 128)\n");
    return 2;
  }
  try {
    breast::write_mesh(argv[2], block_with_landmarks(int(n)));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "block_mesh: %s\n", error.what());
    return 1;
  }
  return 0;
}
