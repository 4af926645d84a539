// SPDX-License-Identifier: GPL-3.0-or-later
// sensitivity as a program: table, arrays, refusals.
#include <gtest/gtest.h>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "core/table.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "fixtures/shapes.hpp"
#include "io/derivative_file.hpp"

using namespace breast;

namespace {

class SensitivityTool : public testing::Test {
 protected:
  void SetUp() override {
    HexMesh mesh = fixtures::cap({.elements = 4});
    mesh.reference.clear();
    write_mesh(folder_ / "mesh.vtkhdf", mesh);
    ASSERT_EQ(
        run("backward", {"mesh.vtkhdf", "reference.vtkhdf", "--materials", "seed2008"}).exit_code,
        0);
    ASSERT_EQ(run("forward", {"reference.vtkhdf", "supine.vtkhdf"}).exit_code, 0);
  }
  ToolResult run(const std::string& tool, const std::vector<std::string>& arguments) const {
    return run_tool(tool, arguments, folder_.path());
  }
  ScratchFolder folder_;
};

TEST_F(SensitivityTool, WritesArraysAndATable) {
  const ToolResult result = run(
      "sensitivity", {"reference.vtkhdf", "supine.vtkhdf", "out.vtkhdf", "--report", "out.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const HexMesh mesh = read_mesh(folder_ / "out.vtkhdf");
  const Derivatives arrays = read_derivatives(folder_ / "out.vtkhdf", mesh);
  const Table table = parse_table(result.out, "stdout");
  // 3 tissues, density, thickness, 4 tilts, at two landmarks.
  EXPECT_EQ(arrays.position.size(), 9u);
  EXPECT_EQ(table.rows.size(), 18u);
  const double fat = Report::parse(read_text(folder_ / "out.json"), "out.json")
                         .number("sensitivity/nipple/fat/dlnu");
  EXPECT_LT(fat, -0.1);  // stiffer fat, smaller displacement
  EXPECT_GT(fat, -1.5);
  // Other tools are not disturbed by the arrays.
  EXPECT_EQ(run("probe", {"out.vtkhdf"}).exit_code, 0);
}

TEST_F(SensitivityTool, AdjointGivesTheSameTableAndInfluences) {
  ASSERT_EQ(run("sensitivity", {"reference.vtkhdf", "supine.vtkhdf", "a.vtkhdf", "--parameters",
                                "main,fat.a10", "--table", "a.tsv"})
                .exit_code,
            0);
  ASSERT_EQ(run("sensitivity", {"reference.vtkhdf", "supine.vtkhdf", "b.vtkhdf", "--parameters",
                                "main,fat.a10", "--adjoint", "--table", "b.tsv"})
                .exit_code,
            0);
  const Table tangent = read_table(folder_ / "a.tsv"), adjoint = read_table(folder_ / "b.tsv");
  ASSERT_EQ(tangent.rows.size(), adjoint.rows.size());
  const auto value = [](const Table& table, const std::vector<std::string>& row) {
    return parse_number(row[std::size_t(table.column("dlnu"))], "dlnu");
  };
  for (const auto& a : tangent.rows) {
    bool found = false;
    for (const auto& b : adjoint.rows) {
      if (a[0] != b[0] || a[1] != b[1]) continue;
      found = true;
      EXPECT_NEAR(value(tangent, a), value(adjoint, b), 1e-7) << a[0] << " " << a[1];
    }
    EXPECT_TRUE(found) << a[1];
  }
  const HexMesh mesh = read_mesh(folder_ / "b.vtkhdf");
  const Derivatives arrays = read_derivatives(folder_ / "b.vtkhdf", mesh);
  EXPECT_TRUE(arrays.position.empty());
  EXPECT_EQ(arrays.influence.size(), mesh.landmarks.size());
}

TEST_F(SensitivityTool, RefusesWhatDoesNotBelongTogether) {
  const auto refused = [&](const std::vector<std::string>& more, const std::string& reference,
                           const std::string& about) {
    std::vector<std::string> arguments{reference, "supine.vtkhdf", "out.vtkhdf"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ToolResult result = run("sensitivity", arguments);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    const bool warned = result.err.find("was solved with the latter") != std::string::npos;
    EXPECT_EQ(result.error_lines(), warned ? 2 : 1) << result.err;
    EXPECT_NE(result.err.find(about), std::string::npos) << result.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.vtkhdf"));
  };
  refused({"--scale", "fat=150"}, "reference.vtkhdf", "not an equilibrium");
  refused({"--posture", "upright"}, "reference.vtkhdf", "the imaged shape is not an equilibrium");
  refused({"--parameters", "fat,lead"}, "reference.vtkhdf", "'lead'");
  refused({"--parameters", "thickness"}, "reference.vtkhdf", "'thickness'");
  ASSERT_EQ(run("backward",
                {"mesh.vtkhdf", "other.vtkhdf", "--materials", "seed2008", "--scale", "fat=90"})
                .exit_code,
            0);
  refused({}, "other.vtkhdf", "different models");
}

}  // namespace
