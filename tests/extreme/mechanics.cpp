// SPDX-License-Identifier: GPL-3.0-or-later
// Input that gravity must refuse. (What it must solve: table/cases.cpp.)
#include <gtest/gtest.h>

#include <limits>

#include "core/error.hpp"
#include "core/units.hpp"
#include "fixtures/in_place.hpp"
#include "fixtures/shapes.hpp"
#include "mechanics/mechanics.hpp"

namespace breast {
namespace {

const Vec3 prone(0, -gravity_mm_s2, 0);

MechanicsOptions paper_options() {
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  return options;
}

TEST(Input, IsRefusedInWords) {
  const MechanicsOptions options = paper_options();
  HexMesh folded = fixtures::cap({.elements = 4});
  std::swap(folded.imaged[folded.element(3)[0]], folded.imaged[folded.element(3)[6]]);
  EXPECT_THROW(solve_backward(folded, prone, options), Error);
  HexMesh unheld = fixtures::cap({.elements = 4});
  unheld.pectoral_faces.clear();
  EXPECT_THROW(solve_forward(unheld, prone, options), Error);
  HexMesh unloaded = fixtures::cap({.elements = 4});
  unloaded.reference.clear();
  EXPECT_THROW(solve_forward(unloaded, prone, options), Error);
  HexMesh bare = fixtures::cap({.elements = 4});
  bare.skin_thickness.pop_back();
  EXPECT_THROW(solve_forward(bare, prone, options), Error);
  EXPECT_THROW(mechanics_options({.materials = "seed2008", .solver = "lu"}), Error);
}

// Not-a-number anywhere ends as an error or as "not converged", never as a result.
TEST(Input, NaNNeverConverges) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  HexMesh mesh = fixtures::cap({.elements = 4});
  mesh.reference[20].x() = nan;
  EXPECT_FALSE(fixtures::forward_into(mesh, prone, paper_options()).converged());
  mesh = fixtures::cap({.elements = 4});
  mesh.imaged[20].x() = nan;
  EXPECT_THROW(solve_backward(mesh, prone, paper_options()), Error);
  mesh = fixtures::cap({.elements = 4});
  EXPECT_FALSE(fixtures::forward_into(mesh, Vec3(0, nan, 0), paper_options()).converged());
}

}  // namespace
}  // namespace breast
