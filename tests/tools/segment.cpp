// SPDX-License-Identifier: GPL-3.0-or-later
// segment on a folder as a scanner exports it: several series, files in no order.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "core/table.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "fixtures/synthetic_scan.hpp"
#include "io/dicom/dataset.hpp"
#include "io/label_file.hpp"
#include "io/segmentation_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;

/// A bilateral scan in the 16 bits of a scanner.
Volume<std::int16_t> scan() {
  const Volume<float> image = testing::SyntheticScan::coarse().image();
  Volume<std::int16_t> out(image.grid);
  for (std::size_t n = 0; n < image.voxels.size(); ++n)
    out.voxels[n] = std::int16_t(std::lround(image.voxels[n]));
  return out;
}

class SegmentFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    const Volume<std::int16_t> t1 = scan();
    write_volume(folder_ / "t1.nrrd", t1);
    write_dicom_series(folder_ / "t1", t1, "T1 prone");
    Volume<std::int16_t> localiser(t1.grid);
    localiser.grid.size[2] = 3;
    localiser.voxels.assign(localiser.grid.voxels(), 7);
    write_dicom_series(folder_ / "localiser", localiser, "localiser");
    fs::create_directory(folder_ / "exam");
    gather("t1");
    gather("localiser");
  }
  /// Into one folder, under names whose order is not that of the slices.
  void gather(const std::string& series) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_ / series))
      files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    for (std::size_t n = 0; n < files.size(); ++n) {
      const std::string name = std::to_string(1000 + 37 * n % 101) + series + ".dcm";
      fs::rename(files[n], folder_ / "exam" / name);
    }
  }
  ToolResult segment(const std::string& scan, std::vector<std::string> options) {
    std::vector<std::string> arguments = {scan, "out.vtkhdf", "--side", "left", "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_tool("segment", arguments, folder_.path());
  }
  ScratchFolder folder_;
};

TEST_F(SegmentFolder, SeriesAreListedAndTheTakenOneIsNamed) {
  const ToolResult listed = run_tool("segment", {"exam", "--list"}, folder_.path());
  ASSERT_EQ(listed.exit_code, 0) << listed.err;
  const Table table = parse_table(listed.out, "list");
  ASSERT_EQ(table.rows.size(), 2u) << listed.out;
  for (std::size_t row = 0; row < 2; ++row) {
    EXPECT_EQ(table.cell(row, "use"), table.cell(row, "images") == "30" ? "taken" : "if asked for");
  }
  EXPECT_EQ(listed.out.find("prone"), std::string::npos) << "a description may hold a name";
  EXPECT_FALSE(fs::exists(folder_ / "out.vtkhdf"));
  const ToolResult none = segment("exam", {"--series", "3"});
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_EQ(none.error_lines(), 1) << none.err;
  for (const char* word : {"2 series", "--series", " 30 files of ", " 3 files of "})
    EXPECT_NE(none.err.find(word), std::string::npos) << word << " in " << none.err;
  EXPECT_FALSE(fs::exists(folder_ / "out.vtkhdf"));
}

TEST_F(SegmentFolder, WhatItsHeaderCallsT2IsRefusedByName) {
  write_dicom_series(folder_ / "t2", scan(), "T2 tse");
  const ToolResult refused = segment("t2", {});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.error_lines(), 1) << refused.err;
  for (const char* word : {"'T2'", "--also", "--contrast fat-bright"})
    EXPECT_NE(refused.err.find(word), std::string::npos) << word << " in " << refused.err;
  EXPECT_EQ(segment("t2", {"--contrast", "fat-bright"}).exit_code, 0);
}

// The scanner's record of the posture is the only one that a scan carries.
TEST_F(SegmentFolder, ASupineSeriesIsNotTakenForAProneOneWithoutAWarning) {
  write_dicom_series(folder_ / "supine", scan(), "T1 supine");
  for (const auto& entry : fs::directory_iterator(folder_ / "supine")) {
    std::string bytes = read_text(entry.path());
    const auto at = bytes.find("HFP");
    ASSERT_NE(at, std::string::npos);
    write_text(entry.path(), bytes.replace(at, 3, "HFS"));
  }
  write_dicom_series(folder_ / "prone", scan(), "T1 prone");
  const auto warned = [&](const std::string& series) {
    EXPECT_EQ(segment(series, {"--report", "r.json"}).exit_code, 0);
    return read_text(folder_ / "r.json").find("the patient position HFS, but --posture is prone") !=
           std::string::npos;
  };
  EXPECT_TRUE(warned("supine"));
  EXPECT_FALSE(warned("prone"));
}

TEST_F(SegmentFolder, TheChosenSeriesGivesWhatItsOwnFileGives) {
  const ToolResult chosen = segment("exam", {"--overlay", "look.png", "--points", "p.vtp",
                                             "--measures", "m.tsv", "--report", "r.json"});
  ASSERT_EQ(chosen.exit_code, 0) << chosen.err;
  const std::string said = read_text(folder_ / "r.json");
  const std::size_t name = said.find(" = 30 files of ");
  ASSERT_NE(name, std::string::npos) << said;
  const std::string number(1, said[name - 1]);
  const LabelVolume of_folder = read_labels(folder_ / "out.vtkhdf");
  ASSERT_EQ(segment("t1.nrrd", {}).exit_code, 0);
  const LabelVolume of_file = read_labels(folder_ / "out.vtkhdf");
  EXPECT_EQ(of_folder.tissue, of_file.tissue);
  EXPECT_LT((of_folder.landmarks.at("nipple") - of_file.landmarks.at("nipple")).norm(), 1e-3);

  EXPECT_GT(fs::file_size(folder_ / "look.png"), 10000u);
  EXPECT_GT(read_surface(folder_ / "p.vtp").points.size(), 1000u);
  const Report report = Report::parse(read_text(folder_ / "r.json"), "r.json");
  const Table measures = read_table(folder_ / "m.tsv");
  const auto volume = std::find_if(measures.rows.begin(), measures.rows.end(),
                                   [](const auto& row) { return row[0] == "breast_ml"; });
  ASSERT_NE(volume, measures.rows.end());
  EXPECT_EQ(parse_number((*volume)[1], "breast_ml"), report.number("breast_ml"));
  EXPECT_GT(report.number("breast_ml"), 300);

  const std::string other = number == "1" ? "2" : "1";
  const ToolResult localiser = segment("exam", {"--series", other});
  EXPECT_EQ(localiser.exit_code, 2);
  EXPECT_EQ(localiser.error_lines(), 1) << localiser.err;
}

TEST_F(SegmentFolder, RemarksOnTheSecondScanAreSaid) {
  write_text(folder_ / "exam/ps.dcm", DatasetBuilder()
                                          .text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.11.1")
                                          .text(0x00080018, "UI", "2.25.3")
                                          .file());
  const ToolResult result = segment("t1.nrrd", {"--also", "exam", "--report", "r.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(read_text(folder_ / "r.json").find("presentation state"), std::string::npos);
}

TEST_F(SegmentFolder, ANameOfAnotherFormatGivesThatFormat) {
  ASSERT_EQ(segment("t1.nrrd", {}).exit_code, 0);
  const LabelVolume labels = read_labels(folder_ / "out.vtkhdf");
  for (const char* name : {"labels.nrrd", "labels.nii.gz", "LABELS.MHA"}) {
    const ToolResult result =
        run_tool("segment", {"t1.nrrd", name, "--side", "left", "--quiet"}, folder_.path());
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const Volume<float> codes = read_volume(folder_ / name);
    ASSERT_EQ(codes.grid.size, labels.grid.size);
    EXPECT_LT((codes.grid.origin - labels.grid.origin).norm(), 1e-3) << name;
    EXPECT_TRUE(std::equal(codes.voxels.begin(), codes.voxels.end(), labels.tissue.begin()))
        << name;
  }
  for (const char* name : {"labels.seg.nrrd", "LABELS.DCM"}) {
    const ToolResult result =
        run_tool("segment", {"t1.nrrd", name, "--side", "left", "--quiet"}, folder_.path());
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const LabelVolume back = labels_of(read_segmentation(folder_ / name), {}, Side::left, name);
    std::map<std::uint8_t, int> ours, theirs;
    for (const std::uint8_t tissue : labels.tissue) ++ours[tissue];
    for (const std::uint8_t tissue : back.tissue) ++theirs[tissue];
    ours.erase(0);
    theirs.erase(0);
    EXPECT_EQ(ours, theirs) << name;
  }
}

TEST_F(SegmentFolder, InputsAndForeignFilesStay) {
  const auto refused = [&](const std::string& scan, const std::string& out,
                           const std::string& report) {
    const ToolResult result = run_tool(
        "segment", {scan, out, "--side", "left", "--quiet", "--report", report}, folder_.path());
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_EQ(result.error_lines(), 1) << result.err;
  };
  fs::create_directory(folder_ / "patient");
  const fs::path slice = folder_ / "patient/slice_0001.dcm";
  fs::copy_file(fs::directory_iterator(folder_ / "exam")->path(), slice);
  const std::string slice_bytes = read_text(slice), scan_bytes = read_text(folder_ / "t1.nrrd");
  refused("patient", "patient/slice_0001.dcm", "r.json");
  refused("patient", "patient/out.nrrd", "r.json");
  refused("t1.nrrd", "t1.nrrd", "r.json");
  refused("t1.nrrd", "out.nrrd", "t1.nrrd");
  refused("t1.nrrd", "notes.txt", "r.json");
  write_text(folder_ / "theirs.nrrd", "NRRD0004\n# a patient's\n");
  refused("t1.nrrd", "theirs.nrrd", "r.json");
  EXPECT_EQ(read_text(slice), slice_bytes);
  EXPECT_EQ(read_text(folder_ / "t1.nrrd"), scan_bytes);
  EXPECT_FALSE(fs::exists(folder_ / "notes.txt"));
}

}  // namespace
}  // namespace breast
