// SPDX-License-Identifier: GPL-3.0-or-later
// The fit-hermite program: file in, file out, report, refusals.
#include <gtest/gtest.h>

#include <fstream>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "fit/rim.hpp"
#include "fixtures/label_breast.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/geometry_file.hpp"
#include "io/label_file.hpp"

using namespace breast;

namespace {

ToolResult run(const ScratchFolder& folder, const std::string& arguments) {
  return run_line("fit-hermite " + arguments, folder.path());
}

LabelVolume coarse_labels() {
  breast::test::LabelBreast shape;
  shape.spacing = Vec3(2.4, 2.4, 4);
  LabelVolume labels = shape.labels();
  labels.history.push_back({"segment", "test", "segment scan labels", {}});
  return labels;
}

}  // namespace

TEST(FitHermiteTool, WritesAGeometryAndAReport) {
  const ScratchFolder folder;
  const auto labels = folder / "labels.vtkhdf", out = folder / "geometry.vtkhdf";
  write_labels(labels, coarse_labels());
  const auto json = folder / "fit.json";
  const ToolResult outcome = run(folder, labels.string() + " " + out.string() +
                                             " --elements 9x11 --quiet --report " + json.string());
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const BreastGeometry geometry = read_geometry(out);
  EXPECT_EQ(geometry.skin.nu, 9);
  EXPECT_EQ(geometry.skin.nv, 11);
  EXPECT_TRUE(star_shaped(geometry.rim_skin, geometry.centre));
  ASSERT_EQ(geometry.history.size(), 2u);
  EXPECT_EQ(geometry.history.back().tool, "fit-hermite");
  const Report report = Report::parse(read_text(json), "fit.json");
  EXPECT_EQ(report.text("status"), "ok");
  EXPECT_NEAR(report.number("fit/mean_mm"), geometry.fit_mean_mm, 1e-9);
  EXPECT_LT(report.number("fit/mean_mm"), 0.3);
  EXPECT_GT(report.number("volumes_ml/body"), 100);
}

TEST(FitHermiteTool, TheSameGeometryOnAnyNumberOfThreads) {
  const ScratchFolder folder;
  write_labels(folder / "labels.vtkhdf", coarse_labels());
  std::vector<std::string> contents;
  for (const char* threads : {"1", "2", "3"}) {
    const ToolResult outcome =
        run(folder, std::string("labels.vtkhdf geometry.vtkhdf --quiet --threads ") + threads);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    contents.push_back(read_geometry(folder / "geometry.vtkhdf").content_sha256);
  }
  EXPECT_EQ(contents[0], contents[1]);
  EXPECT_EQ(contents[0], contents[2]);
}

TEST(FitHermiteTool, RefusesBadUsageBeforeReading) {
  const ScratchFolder folder;
  const auto labels = folder / "labels.vtkhdf", out = folder / "geometry.vtkhdf";
  std::ofstream(labels) << "not a file that is opened";
  for (const char* bad :
       {"--elements 10", "--elements 2x10", "--elements 10x", "--elements 10x10x10",
        "--smoothing rough", "--smoothing -1", "--smoothing nan", "--max-error 0"}) {
    const ToolResult outcome = run(folder, labels.string() + " " + out.string() + " " + bad);
    EXPECT_EQ(outcome.exit_code, 2) << bad;
    EXPECT_NE(outcome.err.find("--"), std::string::npos) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(out)) << bad;
  }
}

TEST(FitHermiteTool, LabelsWithoutAChestWallGiveOneLineAndNoFile) {
  const ScratchFolder folder;
  LabelVolume labels = coarse_labels();
  for (auto& t : labels.tissue)
    if (t == std::uint8_t(Tissue::muscle)) t = std::uint8_t(Tissue::fat);
  const auto file = folder / "labels.vtkhdf", out = folder / "geometry.vtkhdf";
  write_labels(file, labels);
  const ToolResult outcome = run(folder, file.string() + " " + out.string() + " --quiet");
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(out));
}
