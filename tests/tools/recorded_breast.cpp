// SPDX-License-Identifier: GPL-3.0-or-later
// A mesh kept in testdata, made by the whole chain: backward and forward give the recorded
// landmark displacements, whatever the number of threads.
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/mesh_file.hpp"

namespace breast {
namespace {

// Supine minus imaged position, mm: the figures of testdata/README.md.
const std::map<std::string, Vec3> recorded{{"nipple", {3.32388290, 5.19994526, 1.08642614}},
                                           {"tumour", {3.10561370, 3.11450486, 1.00741677}}};
constexpr double tolerance_mm = 1e-6;

class RecordedBreast : public testing::TestWithParam<const char*> {};

TEST_P(RecordedBreast, TurnsOverAsRecorded) {
  const ScratchFolder folder;
  const std::string mesh_file =
      (std::filesystem::path(BREAST_SOURCE) / "testdata" / "small-breast-mesh.vtkhdf").string();
  const std::string threads = GetParam();
  const ToolResult back = run_tool("backward",
                                   {mesh_file, "reference.vtkhdf", "--materials", "seed2008",
                                    "--report", "backward.json", "--threads", threads},
                                   folder.path());
  ASSERT_EQ(back.exit_code, 0) << back.err;
  const Report report = Report::parse(read_text(folder / "backward.json"), "backward.json");
  EXPECT_EQ(report.text("status"), "converged");
  EXPECT_LT(report.number("closure_mm"), 1e-8);

  const ToolResult forward = run_tool(
      "forward", {"reference.vtkhdf", "supine.vtkhdf", "--threads", threads}, folder.path());
  ASSERT_EQ(forward.exit_code, 0) << forward.err;
  const HexMesh supine = read_mesh(folder / "supine.vtkhdf", {.reference = true});
  ASSERT_EQ(supine.landmarks.size(), recorded.size());
  for (const Landmark& landmark : supine.landmarks) {
    const Vec3 moved = landmark_position(supine, supine.points, landmark) -
                       landmark_position(supine, supine.imaged, landmark);
    EXPECT_LT((moved - recorded.at(landmark.name)).norm(), tolerance_mm)
        << landmark.name << " moves by " << moved.transpose();
  }
}

INSTANTIATE_TEST_SUITE_P(Threads, RecordedBreast, testing::Values("1", "2"));

}  // namespace
}  // namespace breast
