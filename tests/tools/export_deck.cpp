// SPDX-License-Identifier: GPL-3.0-or-later
// export-deck as a program: what it writes, what it refuses, a foreign result as a mesh of ours.
#include <gtest/gtest.h>

#include <fstream>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "export/deck/results.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "fixtures/shapes.hpp"
#include "io/mesh_file.hpp"

namespace breast {
namespace {

class ExportDeck : public testing::Test {
 protected:
  void SetUp() override {
    write_mesh(folder_ / "bare.vtkhdf", fixtures::cap({.elements = 4, .skin_mm = 0}));
    write_mesh(folder_ / "skin.vtkhdf", fixtures::cap({.elements = 4}));
  }
  ToolResult run(const std::vector<std::string>& arguments) {
    std::vector<std::string> all = arguments;
    all.insert(all.end(), {"--materials", "seed2008"});
    return run_tool("export-deck", all, folder_.path());
  }
  ScratchFolder folder_;
};

TEST_F(ExportDeck, WritesBothPrograms) {
  const ToolResult calculix =
      run({"bare.vtkhdf", "a.inp", "--bulk-ratio", "500", "--report", "a.json"});
  ASSERT_EQ(calculix.exit_code, 0) << calculix.err;
  const std::string deck = read_text(folder_ / "a.inp");
  EXPECT_NE(deck.find("TYPE=C3D8I, ELSET=FAT"), std::string::npos);
  EXPECT_NE(deck.find("310,300,2250,4720,3800,3.27868852459e-06,1e+20"), std::string::npos);
  EXPECT_EQ(Report::parse(read_text(folder_ / "a.json"), "a").number("elements"), 32);
  const ToolResult febio = run({"skin.vtkhdf", "b.feb", "--without-skin", "--posture", "upright"});
  ASSERT_EQ(febio.exit_code, 0) << febio.err;
  EXPECT_NE(febio.err.find("membrane skin is omitted"), std::string::npos);
  EXPECT_NE(febio.err.find("1000 instead"), std::string::npos);
  EXPECT_NE(read_text(folder_ / "b.feb").find("<z lc=\"1\">9810</z>"), std::string::npos);
  ASSERT_EQ(run({"bare.vtkhdf", "c.inp", "--element", "q2p1"}).exit_code, 0);
  EXPECT_NE(read_text(folder_ / "c.inp").find("TYPE=C3D20R"), std::string::npos);
}

TEST_F(ExportDeck, RefusesInOneLine) {
  for (const std::vector<std::string>& wrong : std::vector<std::vector<std::string>>{
           {"skin.vtkhdf", "x.inp"},
           {"bare.vtkhdf", "x.txt"},
           {"bare.vtkhdf", "x.vtkhdf"},
           {"bare.vtkhdf", "x.inp", "--invariants", "plain"},
           {"bare.vtkhdf", "x.inp", "--calculix-element", "C3D20R"},
           {"bare.vtkhdf", "x.inp", "--read-back", "bare.vtkhdf"},
           {"bare.vtkhdf", "x.inp", "--base", "bare.vtkhdf"}}) {
    const ToolResult result = run(wrong);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_LE(result.error_lines(), 2) << result.err;  // a warning may stand before it
    EXPECT_FALSE(std::filesystem::exists(folder_ / wrong[1])) << wrong[1];
  }
}

TEST_F(ExportDeck, ForeignResultBecomesAMesh) {
  const HexMesh mesh = read_mesh(folder_ / "bare.vtkhdf", {.reference = true});
  std::ofstream log(folder_ / "displacement.log");
  for (int i = 0; i < mesh.nodes(); ++i) log << i + 1 << ",0.5,-0.25," << 0.001 * i << "\n";
  log.close();
  const ToolResult result = run({"bare.vtkhdf", "moved.vtkhdf", "--read-back", "displacement.log",
                                 "--base", "bare.vtkhdf", "--report", "r.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const HexMesh moved = read_mesh(folder_ / "moved.vtkhdf", {.reference = true});
  for (int i = 0; i < mesh.nodes(); ++i) {
    EXPECT_LT((moved.points[i] - mesh.reference[i] - Vec3(0.5, -0.25, 0.001 * i)).norm(), 1e-12);
  }
  EXPECT_EQ(moved.history.size(), mesh.history.size() + 1);
  const NodeDifference d = node_difference(moved, mesh);
  const Report report = Report::parse(read_text(folder_ / "r.json"), "r");
  EXPECT_NEAR(report.number("difference/max_mm"), d.max_mm, 1e-9);
  EXPECT_NEAR(d.max_mm, Vec3(0.5, -0.25, 0.001 * (mesh.nodes() - 1)).norm(), 1e-12);
  EXPECT_EQ(run_tool("probe", {"moved.vtkhdf"}, folder_.path()).exit_code, 0);
  std::ofstream(folder_ / "short.log") << "1,0,0,0\n";
  EXPECT_EQ(run({"bare.vtkhdf", "y.vtkhdf", "--read-back", "short.log"}).exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "y.vtkhdf"));
}

}  // namespace
}  // namespace breast
