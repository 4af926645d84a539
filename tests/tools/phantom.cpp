// SPDX-License-Identifier: GPL-3.0-or-later
// The phantom tool as a user runs it, on its coarsest useful setting.
#include <gtest/gtest.h>

#include <algorithm>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "core/table.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/label_file.hpp"
#include "io/mesh_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"

using namespace breast;

TEST(PhantomTool, WritesScanDicomAndAConsistentTruth) {
  ScratchFolder folder;
  const ToolResult run = run_tool("phantom",
                                  {"p.nrrd", "--preset", "small", "--coarse", "3", "--truth",
                                   "truth", "--dicom", "series", "--report", "p.json", "--quiet"},
                                  folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_TRUE(run.out.empty());

  VolumeSource nrrd, dicom;
  const Volume<float> scan = read_volume(folder.path() / "p.nrrd", 0, &nrrd);
  const Volume<float> series = read_volume(folder.path() / "series", 0, &dicom);
  EXPECT_EQ(scan.voxels, series.voxels);
  EXPECT_LT((scan.grid.origin - series.grid.origin).norm(), 1e-3);

  const Table landmarks = read_table(folder.path() / "truth/landmarks.tsv");
  EXPECT_EQ(landmarks.rows.size(), 104u);
  for (const char* side : {"left", "right"}) {
    const std::string name(side);
    const HexMesh mesh =
        read_mesh(folder.path() / ("truth/" + name + ".vtkhdf"), {.reference = true});
    const LabelVolume labels = read_labels(folder.path() / ("truth/labels-" + name + ".vtkhdf"));
    EXPECT_EQ(side_name(labels.side), name);
    EXPECT_FALSE(read_surface(folder.path() / ("truth/skin-" + name + ".vtp")).triangles.empty());
    EXPECT_FALSE(read_surface(folder.path() / ("truth/wall-" + name + ".vtp")).triangles.empty());
    for (const auto& row : landmarks.rows) {
      if (row[landmarks.column("side")] != name) continue;
      const Landmark* landmark = mesh.landmark(row[landmarks.column("landmark")]);
      ASSERT_NE(landmark, nullptr);
      const Vec3 prone = landmark_position(mesh, mesh.points, *landmark);
      EXPECT_NEAR(parse_number(row[landmarks.column("prone_y_mm")], "prone"), prone.y(), 1e-5);
    }
  }
  const Report report = Report::parse(read_text(folder.path() / "p.json"), "p.json");
  EXPECT_GT(report.number("error_estimate_mm"), 0);
  EXPECT_LT(report.number("error_estimate_mm"), 0.3);
  EXPECT_GT(report.number("volumes_ml/left/fat"), 200);
}

// The second posture as a user makes and segments it: its wall and skin are those of the truth; its nipple is a guess,
// and the report says so.
TEST(PhantomTool, ASupineScanIsOfTheSameBodyAndIsSegmented) {
  ScratchFolder folder;
  const auto run = [&](const std::string& line) {
    return run_line(line + " --quiet", folder.path());
  };
  const std::string options = " --preset average --coarse 3";
  ToolResult said =
      run("phantom s.nrrd --posture supine --misalign 4,2 --truth s --report s.json" + options);
  ASSERT_EQ(said.exit_code, 0) << said.err;
  said = run("segment s.nrrd l.vtkhdf --side left --posture supine --points p.vtp --report l.json");
  ASSERT_EQ(said.exit_code, 0) << said.err;
  const HexMesh mesh = read_mesh(folder.path() / "s/left.vtkhdf", {.reference = true});
  EXPECT_GT(mesh.gravity.y(), 0);
  const Report report = Report::parse(read_text(folder.path() / "s.json"), "s.json");
  const Table landmarks = read_table(folder.path() / "s/landmarks.tsv");
  for (std::size_t row = 0; row < landmarks.rows.size(); ++row) {
    if (landmarks.cell(row, "side") != "left") continue;
    const Landmark* landmark = mesh.landmark(landmarks.cell(row, "landmark"));
    ASSERT_NE(landmark, nullptr);
    EXPECT_LT(
        (landmark_position(mesh, mesh.points, *landmark) - landmarks.point(row, "supine_")).norm(),
        1e-4);
    EXPECT_LT(
        (landmark_position(mesh, mesh.imaged, *landmark) - landmarks.point(row, "prone_")).norm(),
        1e-4);
  }
  EXPECT_EQ(Report::parse(read_text(folder.path() / "l.json"), "l.json").text("nipple"), "guessed");
  // Skin of the segmentation lies on the true skin where that has a face near.
  const TriMesh points = read_surface(folder.path() / "p.vtp"),
                skin = read_surface(folder.path() / "s/skin-left.vtp");
  ASSERT_EQ(points.normals.size(), points.points.size());
  const std::vector<double>& kind = points.point_data.at("surface");
  double sum = 0, outwards = 0, wall = 0;
  int count = 0;
  for (std::size_t k = 0; k < skin.points.size(); k += 7) {
    double nearest = 1e9;
    std::size_t at = 0;
    for (std::size_t p = 0; p < points.points.size(); ++p) {
      const double apart = (points.points[p] - skin.points[k]).norm();
      if (kind[p] == 0 && apart < nearest) nearest = apart, at = p;
    }
    if (nearest > 12) continue;  // beyond what segment looks at, at the body's side
    const double off = (points.points[at] - skin.points[k]).dot(points.normals[at]);
    sum += std::abs(off), outwards += points.normals[at].y() < 0.7, ++count;
  }
  for (const double one : kind) wall += one == 1;
  EXPECT_GT(count, 50);
  EXPECT_LT(sum / count, 2);
  EXPECT_GT(outwards, 0.9 * count);
  EXPECT_GT(wall, 100);
  said = run("segment s.nrrd l2.vtkhdf --side left --posture flat");
  EXPECT_EQ(said.exit_code, 2);
  said = run("phantom t.nrrd --misalign 4,2");
  EXPECT_EQ(said.exit_code, 2);
  EXPECT_EQ(said.error_lines(), 1) << said.err;
}

// A Dixon scan as a user makes and segments it.
TEST(PhantomTool, ADixonScanIsSegmentedAndItsHalvesAreNot) {
  ScratchFolder folder;
  const auto run = [&](const std::string& line) {
    return run_line(line + " --quiet", folder.path());
  };
  ToolResult said =
      run("phantom w.nrrd --preset small --coarse 3 --contrast dixon --fat f.nrrd "
          "--failed 10");
  ASSERT_EQ(said.exit_code, 0) << said.err;
  said = run("segment w.nrrd l.vtkhdf --side left --fat f.nrrd --report l.json");
  ASSERT_EQ(said.exit_code, 0) << said.err;
  const Report report = Report::parse(read_text(folder.path() / "l.json"), "l.json");
  EXPECT_EQ(report.text("contrast"), "dixon");
  EXPECT_GT(report.number("exchanged_percent"), 10);
  for (const char* wrong :
       {"segment f.nrrd l2.vtkhdf --side left",
        "segment w.nrrd l2.vtkhdf --side left --contrast dixon",
        "segment w.nrrd l2.vtkhdf --side left --contrast fat-bright --fat f.nrrd"}) {
    said = run(wrong);
    EXPECT_EQ(said.exit_code, 2) << wrong;
    EXPECT_EQ(said.error_lines(), 1) << said.err;
    EXPECT_NE(said.err.find("--fat"), std::string::npos) << said.err;
  }
}

// Skin that no voxel resolves cannot tell suppressed fat from bright fat.
TEST(PhantomTool, SuppressedFatInWideVoxelsIsNotTakenForBright) {
  ScratchFolder folder;
  ToolResult said = run_line(
      "phantom s.nrrd --preset small --coarse 3 --contrast fat-suppressed --muscle-over-fat 1.4 "
      "--quiet",
      folder.path());
  ASSERT_EQ(said.exit_code, 0) << said.err;
  said = run_line("segment s.nrrd l.vtkhdf --side left --quiet", folder.path());
  EXPECT_EQ(said.exit_code, 2);
  EXPECT_EQ(said.error_lines(), 1) << said.err;
  EXPECT_NE(said.err.find("fat is saturated"), std::string::npos) << said.err;
  ASSERT_NE(said.err.find(": give "), std::string::npos) << said.err;
  EXPECT_EQ(said.err.find(": give "), said.err.rfind(": give ")) << said.err;
}

TEST(PhantomTool, RefusesBadUsageBeforeItStarts) {
  ScratchFolder folder;
  const std::vector<std::vector<std::string>> wrong = {
      {"p.xyz"},
      {"p.nrrd", "--preset", "huge"},
      {"p.nrrd", "--bias", "0.5"},
      {"p.nrrd", "--noise", "nan"},
      {"p.nrrd", "--materials", "granite"},
      {"p.nrrd", "--truth", "/proc/nowhere"},
      {"p.nrrd", "--contrast", "dixon"},
      {"p.nrrd", "--fat", "f.nrrd"},
      {"p.nrrd", "--contrast", "fat-suppressed", "--muscle-over-fat", "0.2"},
      {"p.nrrd", "--failed", "10"},
      {"p.nrrd", "--contrast", "dixon", "--fat", "f.nrrd", "--muscle-over-fat", "3"},
      {"p.nrrd", "--contrast", "dixon", "--fat", "f.nrrd", "--dicom", "series"},
  };
  for (const auto& arguments : wrong) {
    const ToolResult run = run_tool("phantom", arguments, folder.path());
    EXPECT_EQ(run.exit_code, 2) << arguments.back() << ": " << run.err;
    EXPECT_EQ(run.error_lines(), 1) << run.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "p.nrrd"));
  }
}

// What compress goes on from: the file has the wall surface and states the model.
TEST(PhantomMeshTool, WritesASlidingBodyThatForwardSolvesAgain) {
  ScratchFolder folder;
  ToolResult run = run_tool("phantom-mesh",
                            {"prone.vtkhdf", "--supine", "supine.vtkhdf", "--preset", "slim",
                             "--level", "0.5", "--quiet"},
                            folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  run = run_tool(
      "forward",
      {"prone.vtkhdf", "again.vtkhdf", "--posture", "supine", "--estimate", "none", "--quiet"},
      folder.path());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const HexMesh prone = read_mesh(folder.path() / "prone.vtkhdf", {.reference = true}),
                supine = read_mesh(folder.path() / "supine.vtkhdf"),
                again = read_mesh(folder.path() / "again.vtkhdf");
  ASSERT_TRUE(prone.geometry && prone.geometry->thorax);
  EXPECT_EQ(int(prone.pressure.size()), prone.elements());
  double apart = 0, moved = 0;
  for (std::size_t n = 0; n < supine.points.size(); ++n) {
    apart = std::max(apart, (supine.points[n] - again.points[n]).norm());
    moved = std::max(moved, (supine.points[n] - prone.points[n]).norm());
  }
  EXPECT_LT(apart, 1e-6);
  EXPECT_GT(moved, 20);
}
