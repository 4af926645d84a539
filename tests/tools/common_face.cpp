// SPDX-License-Identifier: GPL-3.0-or-later
// Every tool: help, version, man page, usage errors, reports.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/samples.hpp"
#include "fixtures/scratch_folder.hpp"
#include "fixtures/words.hpp"
#include "io/mesh_file.hpp"

namespace breast {
namespace {

std::vector<std::string> all_tools() {
  return words_of(BREAST_TOOLS);
}

TEST(CommonFace, EveryToolIsBuilt) {
  for (const std::string& tool : all_tools()) {
    EXPECT_TRUE(std::filesystem::exists(tool_path(tool))) << tool;
  }
}

class CommonFace : public testing::TestWithParam<std::string> {
 protected:
  ToolResult run(const std::vector<std::string>& arguments) {
    return run_tool(GetParam(), arguments, folder_.path());
  }
  ScratchFolder folder_;
};

TEST_P(CommonFace, Help) {
  const ToolResult result = run({"--help"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_EQ(result.err, "");
  for (const std::string& part :
       {std::string("Usage: "), std::string("Examples:"), std::string("--report FILE.json"),
        std::string("--threads N"), "\n" + GetParam() + " --help-all "}) {
    EXPECT_NE(result.out.find(part), std::string::npos) << part;
  }
  const std::string examples =
      result.out.substr(std::min(result.out.size(), result.out.find("Examples:")));
  EXPECT_NE(examples.find(" " + GetParam() + " "), std::string::npos)
      << "the examples call another name";
}

// Lines "  --name ..." or "  -n, --name ..." before the common options.
int options_in(const std::string& help) {
  std::istringstream lines(help.substr(0, help.find("\nCommon options:")));
  int number = 0;
  for (std::string line; std::getline(lines, line);) number += line.rfind("  -", 0) == 0;
  return number;
}

TEST_P(CommonFace, HelpIsShortAndFullHelpHasEveryOption) {
  const std::string brief = run({"--help"}).out, full = run({"--help-all"}).out;
  EXPECT_LE(options_in(brief), 14);
  EXPECT_LE(std::count(brief.begin(), brief.end(), '\n'), 90);
  const int further = options_in(full) - options_in(brief);
  EXPECT_EQ(brief.find("shows " + std::to_string(further) + " further option") != std::string::npos,
            further > 0)
      << further;
  EXPECT_NE(full.find("Exit codes:"), std::string::npos);
  std::istringstream lines(run({"--help-completion"}).out);
  for (std::string line; std::getline(lines, line);) {
    const std::string name = line.substr(0, line.find('\t'));
    int listed = 0;
    std::istringstream of_full(full);
    for (std::string entry; std::getline(of_full, entry);)
      listed += entry.rfind("  -", 0) == 0 && (entry + " ").find(name + " ") != std::string::npos;
    EXPECT_EQ(listed, 1) << name;
  }
}

TEST_P(CommonFace, Version) {
  EXPECT_EQ(run({"--version"}).out.find(GetParam() + " (libbreast) "), 0u);
}

TEST_P(CommonFace, UsageErrors) {
  const std::vector<std::vector<std::string>> wrong = {
      {"--no-such-option"}, {"--threads", "none"}, {"--threads", "0"}, {"--report"}};
  for (const auto& arguments : wrong) {
    const ToolResult result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_EQ(result.error_lines(), 1) << result.err;
    EXPECT_EQ(result.err.find(GetParam() + ": "), 0u) << result.err;
    EXPECT_EQ(result.out, "");
    EXPECT_NE(result.err.find(arguments.front()), std::string::npos) << result.err;
  }
}

TEST_P(CommonFace, UsageErrorIsReported) {
  EXPECT_EQ(run({"--no-such-option", "--report", "report.json"}).exit_code, 2);
  const Report report = Report::parse(read_text(folder_ / "report.json"), "report.json");
  EXPECT_EQ(report.text("tool"), GetParam());
  EXPECT_FALSE(report.text("version").empty());
  EXPECT_TRUE(report.contains("inputs"));
  EXPECT_TRUE(report.contains("command"));
  const std::string date = report.text("date");
  ASSERT_EQ(date.size(), 20u) << date;
  EXPECT_EQ(date[10], 'T');
  EXPECT_EQ(date.back(), 'Z');
  EXPECT_EQ(report.text("status"), "bad_input");
  EXPECT_NE(report.text("reason").find("--no-such-option"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Tools, CommonFace, testing::ValuesIn(all_tools()), [](const auto& tool) {
  std::string name = tool.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

TEST(Probe, PrintsPositionsAndRelativeDisplacements) {
  const ScratchFolder folder;
  HexMesh mesh = samples::full_mesh();
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    mesh.points[i] = mesh.imaged[i] + Vec3(3, 0, 4);
  write_mesh(folder / "a.vtkhdf", mesh);
  for (Vec3& x : mesh.points) x += Vec3(0, 2, 0);
  write_mesh(folder / "b.vtkhdf", mesh);
  const ToolResult result =
      run_tool("probe", {"a.vtkhdf", "b.vtkhdf", "--landmarks", "nipple", "--base", "a.vtkhdf"},
               folder.path());
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out,
            "file\tnipple_x_mm\tnipple_y_mm\tnipple_z_mm\tnipple_mm\tnipple_relative_mm\n"
            "a.vtkhdf\t-42.0000\t-90.0000\t-41.0000\t5.0000\t0.0000\n"
            "b.vtkhdf\t-42.0000\t-88.0000\t-41.0000\t5.3852\t2.0000\n");
  const ToolResult unknown =
      run_tool("probe", {"a.vtkhdf", "--landmarks", "nippel"}, folder.path());
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("it has: nipple, tumour"), std::string::npos) << unknown.err;

  mesh.side = mesh.geometry->side = mesh.side == Side::left ? Side::right : Side::left;
  write_mesh(folder / "other.vtkhdf", mesh);
  const ToolResult other = run_tool("probe", {"a.vtkhdf", "--base", "other.vtkhdf"}, folder.path());
  EXPECT_EQ(other.exit_code, 2);
  EXPECT_NE(other.err.find("give files that belong together"), std::string::npos) << other.err;
}

}  // namespace
}  // namespace breast
