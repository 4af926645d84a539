// SPDX-License-Identifier: GPL-3.0-or-later
// compress from file to file: contract keys of the report, early stops, refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "core/report.hpp"
#include "core/table.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/mesh_file.hpp"
#include "mesh/compressed_pose.hpp"

namespace breast {
namespace {

class CompressTool : public testing::Test {
 protected:
  void SetUp() override {
    HexMesh mesh = analytic_breast_mesh(5);
    mesh.reference = mesh.points;
    mesh.history.push_back({"backward", "0", "analytic", {}});
    write_mesh(folder_ / "reference.vtkhdf", mesh);
  }
  ToolResult compress(std::vector<std::string> options) {
    std::vector<std::string> arguments = {
        "reference.vtkhdf", "out.vtkhdf", "--quiet",     "--threads", "1",
        "--report",         "r.json",     "--materials", "seed2008",  "--view"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_tool("compress", arguments, folder_.path());
  }
  Report report() {
    std::ifstream in(folder_ / "r.json");
    return Report::parse(std::string(std::istreambuf_iterator<char>(in), {}), "r.json");
  }
  bool wrote() const { return std::filesystem::exists(folder_ / "out.vtkhdf"); }
  ScratchFolder folder_;
};

TEST_F(CompressTool, WritesTheContactRecordAndTheContractKeys) {
  const ToolResult result = compress({"CC", "--reduction", "40"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(result.out.empty());
  const Report r = report();
  EXPECT_EQ(r.text("status"), "converged");
  for (const char* key : {"newton_iterations",
                          "factorisations",
                          "steps",
                          "residual",
                          "min_det_F",
                          "max_volume_error",
                          "elements",
                          "unknowns",
                          "thickness_mm",
                          "reduction_percent",
                          "force_N",
                          "detector_force_N",
                          "pressure_kPa",
                          "area_cm2",
                          "worst_gap_mm",
                          "worst_nodal_gap_mm",
                          "stable",
                          "standoff_mm",
                          "initial_thickness_mm",
                          "force_balance",
                          "plates/paddle/force_N",
                          "plates/detector/peak_pressure_kPa",
                          "seconds/total",
                          "peak_mb"}) {
    EXPECT_TRUE(r.contains(key)) << key;
  }
  for (const char* id : {"pressure_against_sensors", "penetration_above", "volume_kept",
                         "plates_balanced", "thickness_within"}) {
    EXPECT_TRUE(r.contains(std::string("judgement/") + id)) << id;
  }
  EXPECT_NEAR(r.number("reduction_percent"), 40, 1e-6);
  EXPECT_LT(r.number("worst_nodal_gap_mm"), 0.01);
  EXPECT_GT(r.number("worst_gap_mm"), r.number("worst_nodal_gap_mm"));  // between the nodes
  const HexMesh mesh = read_mesh(folder_ / "out.vtkhdf", {.contact = true});
  EXPECT_EQ(mesh.contact->view, View::cc);
  EXPECT_NEAR(mesh.contact->plates[0].force_N, r.number("force_N"), 1e-9);
  EXPECT_EQ(mesh.history.back().tool, "compress");
  EXPECT_EQ(mesh.contact_pressure.size(), mesh.points.size());
}

// The estimate against what 27-node elements on the same mesh really differ by.
TEST_F(CompressTool, PlacesThePlatesByTheEdgeOfTheImage) {
  // This wall is held, and with it the tissue at the edge, on which almost all of the force stays.
  const ToolResult refused = compress(
      {"CC", "--reduction", "25", "--image-edge", "8", "--turn", "5", "--friction", "0.15"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_EQ(refused.error_lines(), 1) << refused.err;
  EXPECT_FALSE(wrote());
  const ToolResult kept = compress({"CC", "--reduction", "25", "--image-edge", "8", "--turn", "5",
                                    "--friction", "0.15", "--keep-unconverged"});
  ASSERT_EQ(kept.exit_code, 3) << kept.err;
  const Report r = report();
  EXPECT_EQ(r.text("status"), "not_gripped");
  EXPECT_EQ(r.text("contact_points"), "surface");
  EXPECT_EQ(r.number("edge_radius_mm"), 3);
  EXPECT_EQ(r.number("turn_deg"), 5);
  EXPECT_LE(r.number("worst_gap_mm"), 0.05);
  EXPECT_LT(r.number("force_balance"), 1e-6);
  EXPECT_NEAR(r.number("plates/paddle/force_behind_edge_N") +
                  r.number("plates/paddle/force_first_20mm_N") +
                  r.number("plates/paddle/force_beyond_20mm_N"),
              r.number("force_N"), 1e-9 * r.number("force_N"));
  const HexMesh mesh = read_mesh(folder_ / "out.vtkhdf");
  ASSERT_TRUE(mesh.contact);
  EXPECT_EQ(mesh.contact->turn_deg, 5);
  EXPECT_TRUE(mesh.contact->ends_image);
  EXPECT_GT(mesh.contact->surface_stiffness, 0);
  EXPECT_FALSE(mesh.contact->friction.empty());
}

// All three placements press on the wall that is held. The cost is that of all, and their iterations are in one list.
TEST_F(CompressTool, PlacesPlatesAnewThatPressOnTheWallOfAPatientWhoBendsForwards) {
  const ToolResult kept =
      compress({"CC", "--reduction", "25", "--image-edge", "auto", "--turn", "5", "--bend", "7",
                "--friction", "0.15", "--keep-unconverged"});
  ASSERT_EQ(kept.exit_code, 3) << kept.err;
  const Report r = report();
  EXPECT_EQ(r.text("status"), "not_gripped");
  EXPECT_EQ(r.number("placements"), 3);
  EXPECT_EQ(r.number("bend_deg"), 7);
  const HexMesh mesh = read_mesh(folder_ / "out.vtkhdf");
  ASSERT_TRUE(mesh.contact && mesh.solve);
  const std::vector<IterationRecord>& rows = mesh.solve->iterations;
  EXPECT_EQ(double(rows.size()), r.number("newton_iterations"));
  EXPECT_TRUE(std::ranges::is_sorted(rows, {}, &IterationRecord::step));
  EXPECT_LE(rows.back().step, r.number("steps"));
  const Vec3 beam = compressed_pose(mesh).n;
  EXPECT_NEAR(beam.y(),
              -std::sin(7 * std::numbers::pi / 180) * std::cos(5 * std::numbers::pi / 180), 1e-9);
  EXPECT_LT((mesh.gravity - mesh.gravity.norm() * beam).norm(), 1e-6) << "of CC, along the beam";
}

// Its last equilibrium is kept if that is asked for, and the placements that would follow are not begun.
TEST_F(CompressTool, EndsAfterTheIterationsThatAreAllowedAndSaysHowToAllowMore) {
  const std::vector<std::string> limited{
      "CC", "--reduction", "25",   "--image-edge",      "auto", "--turn",
      "5",  "--friction",  "0.15", "--most-iterations", "20"};
  const ToolResult refused = compress(limited);
  EXPECT_EQ(refused.exit_code, 3) << refused.err;
  EXPECT_NE(refused.err.find("--most-iterations"), std::string::npos) << refused.err;
  EXPECT_EQ(report().number("placements"), 1);
  EXPECT_LT(report().number("newton_iterations"), 120);
}

// On the way, faces lie deeper in the plates and the force is smaller.
TEST_F(CompressTool, EndsAtTheForceThatWasAskedFor) {
  const ToolResult good =
      compress({"CC", "--reduction", "25", "--force", "2000", "--image-edge", "8", "--turn", "5",
                "--friction", "0.15", "--keep-unconverged"});
  ASSERT_EQ(report().text("status"), "not_gripped") << good.err;
  EXPECT_NEAR(report().number("force_N"), 2000, 0.005 * 2000);
  EXPECT_LT(report().number("reduction_percent"), 25);
}

// A stiff breast reaches the force long before the smallest thickness.
TEST_F(CompressTool, EndsAsInScreeningIfNoTargetIsGiven) {
  const ToolResult good = compress({"CC"});
  ASSERT_EQ(good.exit_code, 0) << good.err;
  EXPECT_GE(report().number("force_N"), 50 * 0.995);
  EXPECT_LE(report().number("force_N"), 110 * 1.005);
  EXPECT_GT(report().number("thickness_mm"), 35);
}

TEST_F(CompressTool, RefusesTwoPlacesForTheEdge) {
  const ToolResult result =
      compress({"CC", "--reduction", "25", "--image-edge", "auto", "--standoff", "5"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("--image-edge"), std::string::npos) << result.err;
  EXPECT_FALSE(wrote());
}

TEST_F(CompressTool, EstimatesItsDiscretisationError) {
  ASSERT_EQ(compress({"CC", "--reduction", "25"}).exit_code, 0);
  const double estimate = report().number("error_estimate_mm");
  const HexMesh coarse = read_mesh(folder_ / "out.vtkhdf");
  ASSERT_EQ(compress({"CC", "--reduction", "25", "--element", "q2p1"}).exit_code, 0);
  EXPECT_EQ(report().text("error_estimate_mm"), "null");
  const HexMesh rich = read_mesh(folder_ / "out.vtkhdf");
  double worst = 0;
  ASSERT_FALSE(coarse.landmarks.empty());
  for (const Landmark& landmark : coarse.landmarks) {
    const Vec3 there = landmark_position(rich, rich.points, *rich.landmark(landmark.name));
    worst = std::max(worst, (there - landmark_position(coarse, coarse.points, landmark)).norm());
  }
  EXPECT_GT(estimate, worst / 3);
  EXPECT_LT(estimate, worst * 3);
}

TEST_F(CompressTool, AnEarlyStopIsWrittenOnlyWhenEnoughWasReached) {
  // Sharp plates beside the held wall fold elements: no path gets to 95 %.
  const ToolResult refused = compress(
      {"CC", "--reduction", "95", "--at-least", "94", "--edge-radius", "0", "--standoff", "0"});
  EXPECT_EQ(refused.exit_code, 3);
  EXPECT_FALSE(wrote());
  EXPECT_NE(refused.err.find("stopped at thickness"), std::string::npos) << refused.err;
  const ToolResult accepted = compress(
      {"CC", "--reduction", "95", "--at-least", "5", "--edge-radius", "0", "--standoff", "0"});
  EXPECT_EQ(accepted.exit_code, 0) << accepted.err;
  ASSERT_TRUE(wrote());
  EXPECT_EQ(report().text("status"), "stopped_early");
  const std::string id = report().text("reason");
  EXPECT_FALSE(id.empty());
  EXPECT_EQ(id.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string::npos) << id;
  EXPECT_NE(report().text("explanation").find("mm"), std::string::npos);
  EXPECT_LT(report().number("load_reached"), 1);
  EXPECT_EQ(read_mesh(folder_ / "out.vtkhdf").solve->status, SolveStatus::stopped_early);
}

TEST_F(CompressTool, RefusesWhatItCannotDo) {
  for (const std::vector<std::string>& options : std::vector<std::vector<std::string>>{
           {"CC", "--reduction", "40", "--area", "0"},
           {"CC", "--force", "1e-6"},
           {"XX", "--reduction", "40"},
           {"CC", "--reduction", "40", "--friction", "-0.3"},
           {"CC", "--reduction", "40", "--wall", "spring:0"},
           {"CC", "--reduction", "40", "--detector", "up"},
           {"CC", "--reduction", "40", "--friction", "0.2", "--contact", "al"},
           {"CC", "--reduction", "40", "--gravity", "sideways"},
           {"CC", "--reduction", "40", "--gravity", "1,2"},
           {"CC", "--reduction", "-4"},
           {"CC", "--reduction", "0"},
           {"CC", "--reduction", "40", "--solver", "multigrid"},
           {"CC", "--thickness", "900"},
           {"CC", "--reduction", "40", "--standoff", "400"}}) {
    const ToolResult result = compress(options);
    EXPECT_EQ(result.exit_code, 2) << options.back();
    EXPECT_EQ(result.error_lines(), 1) << result.err;
    EXPECT_FALSE(wrote());
  }
}

TEST_F(CompressTool, StatesOfTheClosing) {
  ASSERT_EQ(compress({"CC", "--reduction", "30"}).exit_code, 0);
  const std::string alone = read_mesh(folder_ / "out.vtkhdf").content_sha256;
  const ToolResult result = compress({"CC", "--reduction", "30", "--states", "3"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(report().number("states/found"), 3);
  EXPECT_EQ(read_mesh(folder_ / "out.vtkhdf").content_sha256, alone);
  EXPECT_EQ(read_mesh(folder_ / "out-states/state_003.vtkhdf").content_sha256, alone);
  const Table table = read_table(folder_ / "out-states/states.tsv");
  ASSERT_EQ(table.rows.size(), 3u);
  EXPECT_EQ(table.number(0, "closed_mm"), 0);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_LT(table.number(k, "residual"), 1e-9);
    const HexMesh state = read_mesh(folder_ / "out-states" / table.cell(k, "file"));
    EXPECT_NEAR(state.contact->thickness_mm, table.number(k, "thickness_mm"), 1e-9);
  }
  // A compression that is not accepted leaves both as they are.
  EXPECT_EQ(compress({"CC", "--reduction", "95", "--states", "4"}).exit_code, 3);
  EXPECT_EQ(read_mesh(folder_ / "out-states/state_003.vtkhdf").content_sha256, alone);
}

}  // namespace
}  // namespace breast
