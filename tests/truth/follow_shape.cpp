// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh of the chain deformed as the phantom's true body is, for the error budget: every node is a
// place of the scan (imaged), found in the true body's imaged shape and followed to its stress-free
// shape and to its points.
//
//     follow_shape MESH TRUE OUT
//
// MESH lends elements, tissue, imaged shape and landmarks; TRUE the rest: a compressed body its
// points and plates, any other (phantom-mesh) its stress-free shape alone, as backward would write
// it. A node outside the true body keeps its offset from the nearest place in it. Prints how far
// outside the farthest lies, mm.
#include <algorithm>
#include <cstdio>

#include "core/error.hpp"
#include "io/mesh_file.hpp"
#include "mesh/locate.hpp"
#include "mesh/part.hpp"
#include "mesh/shape.hpp"
#include "mesh/surroundings.hpp"

namespace {

using namespace breast;

void run(const std::string& file, const std::string& true_file, const std::string& out) {
  HexMesh mesh = restricted(read_mesh(file), breast_elements);  // the truth ends elsewhere
  const HexMesh truth = read_mesh(true_file, {.reference = true});
  if (mesh.side != truth.side) throw input_error(file, " and ", true_file, " differ in side");
  const Locator locator(truth, truth.imaged);
  mesh.points.resize(mesh.imaged.size());
  mesh.reference.resize(mesh.imaged.size());
  std::vector<Vec3> pressure;  // as vectors, so that places inside elements have them as positions
  for (const double nodal : truth.contact_pressure) pressure.emplace_back(nodal, 0, 0);
  if (truth.contact) mesh.contact_pressure.resize(mesh.imaged.size());
  double outside = 0;
  for (std::size_t i = 0; i < mesh.imaged.size(); ++i) {
    const Location found = locator.nearest(mesh.imaged[i]);
    const auto in = [&](const std::vector<Vec3>& nodal) {
      return element_position(truth, nodal, found.element, found.local);
    };
    const Vec3 offset = mesh.imaged[i] - in(truth.imaged);
    outside = std::max(outside, offset.norm());
    mesh.reference[i] = in(truth.reference) + offset;
    if (truth.contact) mesh.contact_pressure[i] = in(pressure).x();
    mesh.points[i] = truth.contact ? Vec3(in(truth.points) + offset) : mesh.reference[i];
  }
  mesh.contact = truth.contact;
  mesh.gravity = truth.contact ? truth.gravity : Vec3(Vec3::Zero());
  mesh.pressure.clear();
  write_mesh(out, mesh);
  std::printf("outside_mm\t%.3f\n", outside);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 4) {
    std::fprintf(stderr, "follow_shape MESH TRUE OUT\n");
    return 2;
  }
  run(argv[1], argv[2], argv[3]);
} catch (const breast::Error& error) {
  std::fprintf(stderr, "follow_shape: %s\n", error.what());
  return error.exit_code();
}
