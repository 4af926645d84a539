// SPDX-License-Identifier: GPL-3.0-or-later
// CalculiX, really run on our decks through pipelines/compare/ccx-forward.sh,
// finds what forward finds.
#include <gtest/gtest.h>

#include <cstdlib>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "fixtures/shapes.hpp"
#include "io/mesh_file.hpp"

namespace breast {
namespace {

class Calculix : public testing::Test {
 protected:
  // Solves with both; `calculix` are options only its side gets. Leaves ccx.json.
  void solve(const HexMesh& mesh, std::vector<std::string> options, const std::string& calculix) {
    write_mesh(folder_ / "x.vtkhdf", mesh);
    options.insert(options.end(), {"--materials", "seed2008"});
    std::string line = "cd '" + folder_.path().string() +
                       "' && BIN='" BREAST_BIN "' '" BREAST_SOURCE
                       "/pipelines/compare/ccx-forward.sh' x.vtkhdf ccx.vtkhdf --threads 1 "
                       "--base ours.vtkhdf --report ccx.json " +
                       calculix;
    for (const std::string& word : options) line += " " + word;
    options.insert(options.begin(), {"x.vtkhdf", "ours.vtkhdf"});
    ASSERT_EQ(run_tool("forward", options, folder_.path()).exit_code, 0);
    ASSERT_EQ(std::system((line + " > out.txt 2> err.txt").c_str()), 0)
        << read_text(folder_ / "err.txt");
  }
  double number(const std::string& key) const {
    return Report::parse(read_text(folder_ / "ccx.json"), "ccx.json").number(key);
  }
  // Distance of two answers at a landmark over the displacement there.
  double at_landmark(const std::string& name) const {
    const HexMesh ours = read_mesh(folder_ / "ours.vtkhdf"),
                  ccx = read_mesh(folder_ / "ccx.vtkhdf");
    const Landmark& landmark = *ours.landmark(name);
    const Vec3 here = landmark_position(ours, ours.points, landmark);
    const Vec3 there = landmark_position(ccx, ccx.points, landmark);
    return (here - there).norm() /
           (here - landmark_position(ours, ours.reference, landmark)).norm();
  }
  ScratchFolder folder_;
};

HexMesh block(int n) {
  HexMesh mesh = fixtures::block({.elements = {n, n, n}});
  const Locator locator(mesh, mesh.imaged);
  const Vec3 corner(100, 100, 100);
  const Location found = locator.nearest(corner);
  mesh.landmarks.push_back({"corner", corner, found.element, found.local, found.moved});
  return mesh;
}

// Compressible enough that no element locks: the discretisations differ, the answer does not.
TEST_F(Calculix, BlockOfQuadraticElements) {
  solve(block(3), {"--bulk-ratio", "5", "--element", "q2p1", "--gravity", "0,0,-9810"},
        "--calculix-element C3D20");
  EXPECT_LT(at_landmark("corner"), 0.01);
  EXPECT_LT(number("difference/mean_mm"), 0.01 * number("difference/largest_displacement_mm"));
  EXPECT_LT(number("force_balance"), 1e-5);
  EXPECT_GT(number("difference/largest_displacement_mm"), 30);
}

TEST_F(Calculix, CurvedBodyOfTwoTissues) {
  solve(fixtures::cap({.elements = 6, .skin_mm = 0}),
        {"--bulk-ratio", "4", "--element", "q2p1", "--posture", "supine", "--scale",
         "fibroglandular=400"},
        "--calculix-element C3D20");
  EXPECT_LT(at_landmark("nipple"), 0.02);
  EXPECT_LT(number("difference/mean_mm"), 0.02 * number("difference/largest_displacement_mm"));
  EXPECT_LT(number("force_balance"), 1e-5);
}

}  // namespace
}  // namespace breast
