// SPDX-License-Identifier: GPL-3.0-or-later
// The table of pairs: for every row, the tool refuses a pair that does not belong together, in one
// line that names both files, and takes one that does.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>

#include "fixtures/dicom_export.hpp"
#include "fixtures/patient_files.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "fixtures/synthetic_scan.hpp"
#include "lineage/pair_rules.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;

/// The commands of one row; `b` is the folder of another patient.
struct Trial {
  std::string matching;
  std::vector<std::string> mismatched;
  /// Whether the tool succeeds with the matching pair; otherwise it only gets past the check, since a
  /// solution would take too long here.
  bool to_the_end = true;
};

const std::map<std::string, Trial>& trials() {
  static const std::map<std::string, Trial> list = {
      {"segment MR --fat",
       {"segment dicom o.vtkhdf --side left --fat dicom",
        {"segment dicom o.vtkhdf --side left --fat dicom-other"},
        false}},
      {"segment MR --also",
       {"segment dicom o.vtkhdf --side left --also dicom",
        {"segment dicom o.vtkhdf --side left --also dicom-other"}}},
      {"segment MR --chest-wall",
       {"segment body.nrrd o.vtkhdf --side left --chest-wall body-labels.vtkhdf",
        {"segment body.nrrd o.vtkhdf --side left --chest-wall other-labels.vtkhdf",
         "segment body.nrrd o.vtkhdf --side left --chest-wall other-points.vtp",
         "segment body.nrrd o.vtkhdf --side right --chest-wall body-labels.vtkhdf",
         "segment body.nrrd o.vtkhdf --side left --chest-wall far.tsv"}}},
      {"fit-hermite LABELS --native",
       {"fit-hermite body.seg.nrrd o.vtkhdf --native body-labels.vtkhdf",
        {"fit-hermite body.seg.nrrd o.vtkhdf --native other-labels.vtkhdf"}}},
      {"hexmesh GEOMETRY LABELS",
       {"hexmesh a/geometry.vtkhdf a/labels.vtkhdf o.vtkhdf --elements 6 --accept-mismatch --skin 0",
        {"hexmesh a/geometry.vtkhdf b/labels.vtkhdf o.vtkhdf --elements 6 --accept-mismatch",
         "hexmesh a/geometry.vtkhdf a/right-labels.vtkhdf o.vtkhdf --elements 6 --accept-mismatch"}}},
      {"hexmesh LABELS --native",
       {"hexmesh a/geometry.vtkhdf a/labels.seg.nrrd o.vtkhdf --native a/labels.vtkhdf --elements 6 "
        "--accept-mismatch --skin 0",
        {"hexmesh a/geometry.vtkhdf a/labels.seg.nrrd o.vtkhdf --native b/labels.vtkhdf",
         "hexmesh a/geometry.vtkhdf a/labels.seg.nrrd o.vtkhdf --native a/right-labels.vtkhdf"}}},
      {"hexmesh LABELS --tumour",
       {"hexmesh a/geometry.vtkhdf a/labels.vtkhdf o.vtkhdf --tumour a/labels.vtkhdf --elements 6 "
        "--accept-mismatch --skin 0",
        {"hexmesh a/geometry.vtkhdf a/labels.vtkhdf o.vtkhdf --tumour b/labels.vtkhdf",
         "hexmesh a/geometry.vtkhdf a/labels.vtkhdf o.vtkhdf --tumour b/labels.seg.nrrd"}}},
      {"sensitivity REFERENCE STATE",
       {"sensitivity solved.vtkhdf solved-supine.vtkhdf o.vtkhdf --parameters fat --materials seed2008",
        {"sensitivity solved.vtkhdf stiff-supine.vtkhdf o.vtkhdf --parameters fat --materials seed2008",
         "sensitivity solved.vtkhdf a/fine-supine.vtkhdf o.vtkhdf --parameters fat --materials seed2008",
         "sensitivity solved.vtkhdf a/right-supine.vtkhdf o.vtkhdf --parameters fat --materials seed2008"}}},
      {"compress REFERENCE --like",
       {"compress solved.vtkhdf o.vtkhdf --view CC --reduction 2 --like a/cc.dcm --materials seed2008",
        {"compress solved.vtkhdf o.vtkhdf --view CC --reduction 2 --like right.dcm --materials seed2008"},
        false}},
      {"project-mammogram COMPRESSED --labels",
       {"project-mammogram a/cc.vtkhdf o.vti --pixel 2 --labels a/labels.vtkhdf",
        {"project-mammogram a/cc.vtkhdf o.vti --pixel 2 --labels b/labels.vtkhdf",
         "project-mammogram a/cc.vtkhdf o.vti --pixel 2 --labels a/right-labels.vtkhdf"}}},
      {"project-mammogram LABELS --native",
       {"project-mammogram a/cc.vtkhdf o.vti --pixel 2 --labels a/labels.seg.nrrd --native a/labels.vtkhdf",
        {"project-mammogram a/cc.vtkhdf o.vti --pixel 2 --labels a/labels.seg.nrrd --native b/labels.vtkhdf"}}},
      {"cc2mlo CC MLO",
       {"cc2mlo a/cc.vtkhdf a/mlo.vtkhdf o.vtp --landmark tumour",
        {"cc2mlo a/cc.vtkhdf a/stiff-mlo.vtkhdf o.vtp --landmark tumour",
         "cc2mlo a/cc.vtkhdf a/fine-mlo.vtkhdf o.vtp --landmark tumour"}}},
      {"cc2mlo CC --supine",
       {"cc2mlo a/cc.vtkhdf a/mlo.vtkhdf o.vtp --pair 31,52,35,48 --supine a/supine.vtkhdf",
        {"cc2mlo a/cc.vtkhdf a/mlo.vtkhdf o.vtp --pair 31,52,35,48 --supine a/stiff-supine.vtkhdf",
         "cc2mlo a/cc.vtkhdf a/mlo.vtkhdf o.vtp --pair 31,52,35,48 --supine a/right-supine.vtkhdf",
         "cc2mlo a/cc.vtkhdf a/mlo.vtkhdf o.vtp --pair 31,52,35,48 --supine a/fine-supine.vtkhdf"}}},
      {"cc2mlo CC --truth",
       {"cc2mlo a/cc.vtkhdf a/mlo.vtkhdf o.vtp --truth a/truth.tsv",
        {"cc2mlo a/cc.vtkhdf a/mlo.vtkhdf o.vtp --truth b/truth.tsv"}}},
      {"cc2mlo CC --cc-image",
       {"cc2mlo a/cc.vtkhdf a/mlo.vtkhdf o.vtp --point 90,90 --cc-image a/cc.dcm --mlo-image a/mlo.dcm",
        {"cc2mlo a/cc.vtkhdf a/mlo.vtkhdf o.vtp --point 90,90 --cc-image right.dcm --mlo-image a/mlo.dcm"}}},
      {"cc2mlo MLO --mlo-image",
       {"cc2mlo a/cc.vtkhdf a/mlo.vtkhdf o.vtp --point 90,90 --cc-image a/cc.dcm --mlo-image a/mlo.dcm",
        {"cc2mlo a/cc.vtkhdf a/mlo.vtkhdf o.vtp --point 90,90 --cc-image a/cc.dcm --mlo-image right-mlo.dcm"}}},
      {"cc2mlo --cc-image --mlo-image",
       {"cc2mlo a/cc.vtkhdf a/mlo.vtkhdf o.vtp --point 90,90 --cc-image a/cc.dcm --mlo-image a/mlo.dcm",
        {"cc2mlo a/cc.vtkhdf a/mlo.vtkhdf o.vtp --point 90,90 --cc-image a/cc.dcm --mlo-image stranger.dcm"}}},
      {"match-lookup CC MLO",
       {"match-lookup a/cc.vtkhdf a/mlo.vtkhdf o.h5 --pitch 25",
        {"match-lookup a/cc.vtkhdf a/stiff-mlo.vtkhdf o.h5 --pitch 25",
         "match-lookup a/cc.vtkhdf a/fine-mlo.vtkhdf o.h5 --pitch 25"}}},
      {"identify MESH --labels",
       {"identify a/mesh.vtkhdf o.tsv --materials seed2008 --nipple 0,20,0 --labels a/labels.vtkhdf --second-labels b/labels.vtkhdf",
        {"identify a/mesh.vtkhdf o.tsv --materials seed2008 --nipple 0,20,0 --labels b/labels.vtkhdf --second-labels b/labels.vtkhdf"},
        false}},
      {"identify MESH --second-labels",
       {"identify a/mesh.vtkhdf o.tsv --materials seed2008 --nipple 0,20,0 --labels a/labels.vtkhdf --second-labels b/labels.vtkhdf",
        {"identify a/mesh.vtkhdf o.tsv --materials seed2008 --nipple 0,20,0 --labels a/labels.vtkhdf --second-labels b/right-labels.vtkhdf"},
        false}},
      {"identify --second-labels --surface",
       {"identify a/mesh.vtkhdf o.tsv --materials seed2008 --surface other-points.vtp --labels a/labels.vtkhdf --second-labels other-labels.vtkhdf",
        {"identify a/mesh.vtkhdf o.tsv --materials seed2008 --surface body-points.vtp --labels a/labels.vtkhdf --second-labels "
         "other-labels.vtkhdf"},
        false}},
      {"difference STATE PLUS",
       {"difference a/cc.vtkhdf a/fine-cc.vtkhdf a/cc.vtkhdf o.vtkhdf",
        {"difference a/cc.vtkhdf b/cc.vtkhdf a/cc.vtkhdf o.vtkhdf"}}},
      {"difference STATE MINUS",
       {"difference a/cc.vtkhdf a/cc.vtkhdf a/fine-cc.vtkhdf o.vtkhdf",
        {"difference a/cc.vtkhdf a/cc.vtkhdf b/cc.vtkhdf o.vtkhdf"}}},
      {"probe --base FILE",
       {"probe a/cc.vtkhdf a/supine.vtkhdf --base a/stiff-supine.vtkhdf",
        {"probe a/cc.vtkhdf b/supine.vtkhdf --base a/supine.vtkhdf",
         "probe a/right-supine.vtkhdf --base a/supine.vtkhdf"}}},
      {"probe FILE --truth",
       {"probe a/reference.vtkhdf a/supine.vtkhdf --truth a/truth.tsv",
        {"probe a/reference.vtkhdf a/supine.vtkhdf --truth b/truth.tsv"}}},
      {"probe first FILE FILE with --truth",
       {"probe a/reference.vtkhdf a/supine.vtkhdf --truth a/truth.tsv",
        {"probe a/reference.vtkhdf a/fine-supine.vtkhdf --truth a/truth.tsv",
         "probe a/reference.vtkhdf a/right-supine.vtkhdf --truth a/truth.tsv"}}},
      {"truth-table LANDMARKS MESH",
       {"truth-table a/truth.tsv o.tsv a/reference.vtkhdf a/fine-reference.vtkhdf",
        {"truth-table a/truth-elsewhere.tsv o.tsv a/reference.vtkhdf a/fine-reference.vtkhdf"}}},
      {"truth-table first MESH MESH",
       {"truth-table a/truth.tsv o.tsv a/reference.vtkhdf a/fine-reference.vtkhdf",
        {"truth-table a/truth.tsv o.tsv a/fine-reference.vtkhdf a/elsewhere.vtkhdf",
         "truth-table a/truth.tsv o.tsv a/reference.vtkhdf a/right-supine.vtkhdf"}}},
      {"evaluate GIVEN TRUTH",
       {"evaluate a/labels.vtkhdf a/labels.vtkhdf",
        {"evaluate a/labels.vtkhdf b/labels.vtkhdf",
         "evaluate a/labels.vtkhdf a/right-labels.vtkhdf",
         "evaluate a/curve.vtp b/curve.vtp --curves"}}},
      {"evaluate TRUTH --region",
       {"evaluate a/labels.vtkhdf a/labels.vtkhdf --region a/scan.nrrd",
        {"evaluate a/labels.vtkhdf a/labels.vtkhdf --region far.nrrd"}}},
      {"evaluate TRUTH --fraction",
       {"evaluate a/labels.vtkhdf a/labels.vtkhdf --fraction fraction.nrrd",
        {"evaluate a/labels.vtkhdf a/labels.vtkhdf --fraction far.nrrd"}}},
      {"export-deck REFERENCE --base",
       {"export-deck a/reference.vtkhdf o.vtkhdf --materials seed2008 --read-back rest.log --base a/supine.vtkhdf",
        {"export-deck a/reference.vtkhdf o.vtkhdf --materials seed2008 --read-back rest.log --base a/fine-supine.vtkhdf",
         "export-deck a/reference.vtkhdf o.vtkhdf --materials seed2008 --read-back rest.log --base a/right-supine.vtkhdf"}}},
      {"export-slicer labels.vtkhdf mesh.vtkhdf",
       {"export-slicer run o.slicer --no-fields",
        {"export-slicer run-labels o.slicer --no-fields",
         "export-slicer run-right o.slicer --no-fields"}}},
      {"export-slicer labels.vtkhdf --scan",
       {"export-slicer run o.slicer --no-fields --scan a/scan.nrrd",
        {"export-slicer run o.slicer --no-fields --scan b/scan.nrrd"}}},
      {"export-slicer mesh.vtkhdf other shape",
       {"export-slicer run o.slicer --no-fields",
        {"export-slicer run-shape o.slicer --no-fields"}}},
      {"export-slicer mesh.vtkhdf curve.vtp",
       {"export-slicer run o.slicer --no-fields",
        {"export-slicer run-curve o.slicer --no-fields"}}},
      {"render first FILE FILE",
       {"render a/cc.vtkhdf a/mlo.vtkhdf --figure compression -o o.png",
        {"render a/cc.vtkhdf b/mlo.vtkhdf --figure compression -o o.png",
         "render a/cc.vti b/mlo.vti a/curve.vtp --figure mammogram -o o.png"}}},
      {"render FILE.vti FILE.vtp",
       {"render a/cc.vti a/mlo.vti a/curve.vtp --figure mammogram -o o.png",
        {"render a/cc.vti a/mlo.vti b/curve.vtp --figure mammogram -o o.png",
         "render a/cc.vti a/mlo.vti a/stiff-curve.vtp --figure mammogram -o o.png"}}},
      {"render --labels FILE",
       {"render a/mesh.vtkhdf --figure slices --scan a/scan.nrrd --labels a/labels.vtkhdf -o o.png",
        {"render b/mesh.vtkhdf --figure slices --scan a/scan.nrrd --labels a/labels.vtkhdf -o o.png"}}},
      {"render --labels --scan",
       {"render a/mesh.vtkhdf --figure slices --scan a/scan.nrrd --labels a/labels.vtkhdf -o o.png",
        {"render a/mesh.vtkhdf --figure slices --scan b/scan.nrrd --labels a/labels.vtkhdf -o o.png"}}},
      {"tabulate cc.vtkhdf mlo.vtkhdf",
       {"tabulate page page", {"tabulate page page-mlo", "tabulate page page-fine"}}},
      {"tabulate cc.vtkhdf cc.vti",
       {"tabulate page page", {"tabulate page page-image", "tabulate page page-stiff"}}},
      {"tabulate mlo.vtkhdf mlo.vti", {"tabulate page page", {"tabulate page page-mlo-image"}}},
      {"tabulate cc.vtkhdf SCAN",
       {"tabulate page page a/scan.nrrd", {"tabulate page page b/scan.nrrd"}}},
  };
  return list;
}

class Pair : public ::testing::TestWithParam<PairRule> {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ScratchFolder;
    const fixtures::PatientFiles a(*folder_ / "a", 100), b(*folder_ / "b", 130);
    for (const std::string who : {"a/", "b/"}) {
      for (const std::string name : {"cc", "mlo", "stiff-cc", "stiff-mlo"})
        must("project-mammogram " + who + name + ".vtkhdf " + who + name +
             ".vti --pixel 1 --energy W/Rh:28 --dicom " + who + name + ".dcm");
      must("cc2mlo " + who + "cc.vtkhdf " + who + "mlo.vtkhdf " + who +
           "curve.vtp --landmark tumour");
      must("cc2mlo " + who + "stiff-cc.vtkhdf " + who + "stiff-mlo.vtkhdf " + who +
           "stiff-curve.vtp --landmark tumour");
    }
    for (const auto& [from, to] :
         {std::pair("a/cc.dcm", "right.dcm"), {"a/mlo.dcm", "right-mlo.dcm"}})
      alter(from, to,
            std::string("\x20\x00\x62\x00"
                        "CS\x02\x00L",
                        9),
            std::string("\x20\x00\x62\x00"
                        "CS\x02\x00R",
                        9));
    alter("a/mlo.dcm", "stranger.dcm",
          std::string("LO\x0a\x00"
                      "SIMULATED",
                      13),
          std::string("LO\x0a\x00"
                      "SIMULATOR",
                      13));
    write_volumes();
    write_runs();
    must("backward a/mesh.vtkhdf solved.vtkhdf --materials seed2008");
    must("forward solved.vtkhdf solved-supine.vtkhdf --materials seed2008");
    must("backward a/mesh.vtkhdf stiff.vtkhdf --materials seed2008 --scale fat=150");
    must("forward stiff.vtkhdf stiff-supine.vtkhdf --materials seed2008 --scale fat=150");
    std::ofstream log(*folder_ / "rest.log");
    for (int i = 0; i < read_mesh(a.at("mesh.vtkhdf")).nodes(); ++i) log << i + 1 << ",0,0,0\n";
  }
  static void TearDownTestSuite() { delete folder_; }

  /// Runs a line that must succeed.
  static void must(const std::string& line) {
    const ToolResult result = run_line(line + " --quiet", folder_->path());
    ASSERT_EQ(result.exit_code, 0) << line << ": " << result.err;
  }
  /// Copies a file with one text replaced.
  static void alter(const std::string& from, const std::string& to, const std::string& old,
                    const std::string& now) {
    std::string bytes = read_text(*folder_ / from);
    const std::size_t at = bytes.find(old);
    ASSERT_NE(at, std::string::npos) << from;
    bytes.replace(at, old.size(), now);
    std::ofstream(*folder_ / to, std::ios::binary) << bytes;
  }
  // One scan as series of two patients.
  static void write_series(const Volume<float>& body) {
    Volume<std::int16_t> volume(body.grid);
    for (std::size_t n = 0; n < body.voxels.size(); ++n)
      volume.voxels[n] = std::int16_t(std::lround(body.voxels[n]));
    fixtures::ExportImages images;
    fixtures::write_slices(*folder_ / "dicom", "s", ".dcm", volume, images, {});
    images.patient = "43";
    fixtures::write_slices(*folder_ / "dicom-other", "s", ".dcm", volume, images, {});
  }
  // Two scans that can be segmented, their labels, and volumes and points at another place.
  static void write_volumes() {
    Volume<float> body = testing::SyntheticScan::coarse().image();
    write_series(body);
    for (const std::string name : {"body", "other"}) {
      write_volume(*folder_ / (name + ".nrrd"), body);
      must("segment " + name + ".nrrd " + name + "-labels.vtkhdf --side left --points " + name +
           "-points.vtp");
      for (float& voxel : body.voxels) voxel *= 1.01F;
    }
    LabelVolume labels = read_labels(*folder_ / "body-labels.vtkhdf");
    labels.scan_sha256 = labels.history.front().inputs.front().sha256;
    write_segmentation(*folder_ / "body.seg.nrrd", labels);
    std::ofstream(*folder_ / "far.tsv") << "x_mm\ty_mm\tz_mm\n900\t0\t0\n950\t50\t0\n900\t50\t50\n";
    Volume<float> volume(fixtures::analytic_labels().grid, 0.5F);
    write_volume(*folder_ / "fraction.nrrd", volume);
    volume.grid.origin += Vec3(600, 0, 0);
    write_volume(*folder_ / "far.nrrd", volume);
  }
  // Folders of runs with one file of another patient, side, mesh.
  static void write_runs() {
    const std::map<std::string, std::pair<std::string, std::string>> replaced = {
        {"run", {"labels.vtkhdf", "a/labels.vtkhdf"}},
        {"run-labels", {"labels.vtkhdf", "b/labels.vtkhdf"}},
        {"run-right", {"labels.vtkhdf", "a/right-labels.vtkhdf"}},
        {"run-shape", {"supine.vtkhdf", "a/fine-supine.vtkhdf"}},
        {"run-curve", {"curve.vtp", "b/curve.vtp"}}};
    for (const auto& [name, change] : replaced) {
      fs::create_directory(*folder_ / name);
      for (const char* file : {"labels.vtkhdf", "mesh.vtkhdf", "supine.vtkhdf", "curve.vtp"})
        fs::copy_file(*folder_ / "a" / file, *folder_ / name / file);
      fs::copy_file(*folder_ / change.second, *folder_ / name / change.first,
                    fs::copy_options::overwrite_existing);
    }
    write_pages();
  }
  static void write_pages() {
    const std::map<std::string, std::pair<std::string, std::string>> replaced = {
        {"page", {"cc.vti", "a/cc.vti"}},
        {"page-mlo", {"mlo.vtkhdf", "b/mlo.vtkhdf"}},
        {"page-fine", {"mlo.vtkhdf", "a/fine-mlo.vtkhdf"}},
        {"page-image", {"cc.vti", "b/cc.vti"}},
        {"page-stiff", {"cc.vti", "a/stiff-cc.vti"}},
        {"page-mlo-image", {"mlo.vti", "b/mlo.vti"}}};
    must("match-lookup a/cc.vtkhdf a/mlo.vtkhdf a/lookup.h5 --pitch 25 --both-ways");
    for (const auto& [name, change] : replaced) {
      fs::create_directory(*folder_ / name);
      for (const char* file : {"cc.vtkhdf", "mlo.vtkhdf", "cc.vti", "mlo.vti", "lookup.h5"})
        fs::copy_file(*folder_ / "a" / file, *folder_ / name / file);
      fs::copy_file(*folder_ / change.second, *folder_ / name / change.first,
                    fs::copy_options::overwrite_existing);
    }
  }

  static inline ScratchFolder* folder_ = nullptr;
};

constexpr const char* complaint = "give files that belong together";

TEST_P(Pair, IsTakenOnlyIfItBelongsTogether) {
  const PairRule& rule = GetParam();
  if (!fs::exists(tool_path(rule.tool))) GTEST_SKIP() << rule.tool << " is not built";
  const auto found = trials().find(rule.tool + " " + rule.first + " " + rule.second);
  ASSERT_NE(found, trials().end()) << "a row of the table without a trial";
  const Trial& trial = found->second;
  const ToolResult taken = run_line(trial.matching, folder_->path());
  if (trial.to_the_end) {
    EXPECT_EQ(taken.exit_code, 0) << trial.matching << ": " << taken.err;
  }
  EXPECT_EQ(taken.err.find(complaint), std::string::npos) << trial.matching << ": " << taken.err;
  for (const std::string& line : trial.mismatched) {
    const ToolResult refused = run_line(line + " --quiet", folder_->path());
    EXPECT_EQ(refused.exit_code, 2) << line << ": " << refused.err;
    EXPECT_EQ(refused.error_lines(), 1) << line << ": " << refused.err;
    EXPECT_NE(refused.err.find(complaint), std::string::npos) << line << ": " << refused.err;
  }
}

std::string name_of(const ::testing::TestParamInfo<PairRule>& info) {
  std::string name;
  for (const char c : info.param.tool + "_" + info.param.first + "_" + info.param.second)
    name += std::isalnum(static_cast<unsigned char>(c)) != 0 ? c : '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Table, Pair, ::testing::ValuesIn(pair_rules()), name_of);

class Matched : public Pair {};

// Two models in one matching are an experiment, and their user says so.
TEST_F(Matched, WithAnotherModelByAnOption) {
  for (const std::string line :
       {"cc2mlo a/cc.vtkhdf a/stiff-mlo.vtkhdf o.vtp --landmark tumour",
        "match-lookup a/cc.vtkhdf a/stiff-mlo.vtkhdf o.h5 --pitch 25",
        "cc2mlo a/cc.vtkhdf a/mlo.vtkhdf o.vtp --point 90,90 --cc-image a/cc.dcm --mlo-image "
        "stranger.dcm"}) {
    const std::string what = line.find("stranger") == std::string::npos ? "model" : "patient";
    const ToolResult taken = run_line(line + " --accept-other " + what, folder_->path());
    EXPECT_EQ(taken.exit_code, 0) << taken.err;
  }
  EXPECT_EQ(
      run_line("cc2mlo a/cc.vtkhdf a/fine-mlo.vtkhdf o.vtp --landmark tumour --accept-other model",
               folder_->path())
          .exit_code,
      2);
}

// A file of another program says nothing of its origin: it is taken, with one line that says so.
TEST_F(Matched, WithoutAHistoryByPlaceAlone) {
  HexMesh foreign = read_mesh(*folder_ / "a/supine.vtkhdf", {.reference = true});
  foreign.history.clear();
  write_mesh(*folder_ / "foreign.vtkhdf", foreign);
  const ToolResult taken =
      run_line("probe foreign.vtkhdf --base a/stiff-supine.vtkhdf", folder_->path());
  EXPECT_EQ(taken.exit_code, 0) << taken.err;
  EXPECT_NE(taken.err.find("foreign.vtkhdf: does not say from which scan it comes"),
            std::string::npos)
      << taken.err;
  EXPECT_EQ(taken.error_lines(), 1) << taken.err;
}

}  // namespace
}  // namespace breast
