// SPDX-License-Identifier: GPL-3.0-or-later
// A scan that shows one breast alone: from half of the small phantom's field of view to a mesh as
// good as any.
#include <gtest/gtest.h>

#include <cmath>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "fixtures/perturbed_scan.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/volume_file.hpp"

namespace breast {
namespace {

class OneBreast : public ::testing::Test {
 protected:
  void SetUp() override {
    const ToolResult phantom =
        run_line("phantom both.nrrd --preset small --coarse 3 --quiet --threads 1", at());
    ASSERT_EQ(phantom.exit_code, 0) << phantom.err;
    write_volume(folder_ / "alone.nrrd",
                 testing::one_breast(read_volume(folder_ / "both.nrrd"), true));
  }
  const std::filesystem::path& at() const { return folder_.path(); }
  /// Runs a tool, which must succeed, with its report.
  Report report_of(const std::string& line) {
    const ToolResult result = run_line(line + " --threads 1 --report report.json", at());
    EXPECT_EQ(result.exit_code, 0) << line << ": " << result.err;
    said_ = result.err;
    return Report::parse(read_text(folder_ / "report.json"), "report.json");
  }
  ScratchFolder folder_;
  std::string said_;  ///< stderr of the last tool
};

TEST_F(OneBreast, ReachesAMeshOfTheUsualQuality) {
  const Report whole = report_of("segment both.nrrd whole.vtkhdf --side left --quiet");
  const Report alone = report_of("segment alone.nrrd labels.vtkhdf --side left");
  EXPECT_NE(said_.find("only one breast is in"), std::string::npos) << said_;
  EXPECT_NEAR(alone.number("breast_ml") / whole.number("breast_ml"), 1, 0.05);

  const Report fit = report_of("fit-hermite labels.vtkhdf geometry.vtkhdf --quiet");
  EXPECT_LE(fit.number("fit/mean_mm"), 0.2);
  EXPECT_LE(fit.number("fit/p95_mm"), 0.6);
  EXPECT_LE(fit.number("fit/max_mm"), 2);

  const Report mesh =
      report_of("hexmesh geometry.vtkhdf labels.vtkhdf mesh.vtkhdf --elements 10 --quiet");
  EXPECT_GT(mesh.number("min_scaled_jacobian"), 0.5);
  EXPECT_GT(mesh.number("min_det_bound_mm3"), 0);
  // The rim is the labels' border as seen on the skin; it is not moved until the volumes agree.
  EXPECT_NEAR(mesh.number("volume_error_percent"), 0, 3);
}

}  // namespace
}  // namespace breast
