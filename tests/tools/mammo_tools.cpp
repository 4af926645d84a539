// SPDX-License-Identifier: GPL-3.0-or-later
// project-mammogram and cc2mlo as a user runs them.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "core/table.hpp"
#include "fixtures/chain_files.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/mammogram_file.hpp"
#include "io/surface_file.hpp"

using namespace breast;
namespace fs = std::filesystem;

namespace {

class MammoTools : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ScratchFolder;
    fixtures::write_chain(folder_->path());
  }
  static void TearDownTestSuite() { delete folder_; }
  static ToolResult run(const std::string& tool, const std::vector<std::string>& arguments) {
    return run_tool(tool, arguments, folder_->path());
  }
  static fs::path file(const std::string& name) { return *folder_ / name; }
  // "u,v" of the tumour of a compressed mesh in its image, mm.
  static std::string tumour_mark(const std::string& mesh_name, const std::string& image) {
    const HexMesh mesh = read_mesh(file(mesh_name));
    const Vec2 uv =
        read_mammogram(file(image))
            .pose.project(landmark_position(mesh, mesh.points, *mesh.landmark("tumour")));
    return format_number(uv.x()) + "," + format_number(uv.y());
  }

 private:
  static inline ScratchFolder* folder_ = nullptr;
};

}  // namespace

// The table fits below the limit, the curve, which is written last, does not.
TEST_F(MammoTools, AFileThatCannotBeWrittenTakesTheOthersWithIt) {
  const ToolResult result = run_tool(
      "cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "no.vtp", "--landmark", "tumour", "--table", "no.tsv"},
      file(""), [] {
        const rlimit small{4096, 4096};
        setrlimit(RLIMIT_FSIZE, &small);
      });
  EXPECT_EQ(result.exit_code, 1) << result.err;
  EXPECT_EQ(result.error_lines(), 1) << result.err;
  EXPECT_FALSE(fs::exists(file("no.vtp")) || fs::exists(file("no.tsv")));
}

TEST_F(MammoTools, WhatCannotBePrintedIsNotDone) {
  const ToolResult result =
      run_tool("probe", {"cc.vtkhdf"}, file(""), [] { close(STDOUT_FILENO); });
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_NE(result.err.find("stdout cannot be written"), std::string::npos) << result.err;
}

TEST_F(MammoTools, ProjectionWritesImagePictureAndReport) {
  const ToolResult result =
      run("project-mammogram", {"cc.vtkhdf", "cc.vti", "--labels", "labels.vtkhdf", "--png",
                                "cc.png", "--pixel", "0.5", "--report", "cc.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(result.out.empty());
  EXPECT_EQ(result.err.find("history"), std::string::npos) << result.err;  // the right labels
  const Mammogram image = read_mammogram(file("cc.vti"));
  EXPECT_EQ(image.view, View::cc);
  EXPECT_EQ(image.history.back().tool, "project-mammogram");
  EXPECT_TRUE(fs::exists(file("cc.png")));
  const Report report = Report::parse(read_text(file("cc.json")), "cc.json");
  EXPECT_EQ(report.text("status"), "ok");
  EXPECT_NEAR(report.number("volumes_ml/fibroglandular"), 33.5, 1.0);  // 4/3 π 20³ mm³
  EXPECT_EQ(report.number("columns_through_back"), 0);
}

TEST_F(MammoTools, ForeignLabelsAreRemarkedOn) {
  LabelVolume other = fixtures::analytic_labels();
  other.tissue[0] = std::uint8_t(Tissue::air);
  write_labels(file("other.vtkhdf"), other);
  const ToolResult result = run(
      "project-mammogram", {"cc.vtkhdf", "other.vti", "--labels", "other.vtkhdf", "--pixel", "2"});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("does not say from which scan"), std::string::npos) << result.err;
}

TEST_F(MammoTools, EnergiesAndBeams) {
  ASSERT_EQ(run("project-mammogram",
                {"cc.vtkhdf", "mono.vti", "--energy", "20", "--pixel", "2", "--geometry", "cone"})
                .exit_code,
            0);
  const Mammogram mono = read_mammogram(file("mono.vti"));
  EXPECT_EQ(mono.energy, "20 keV");
  EXPECT_EQ(mono.pose.source_distance, 650);
  write_text(file("spectrum.tsv"), "energy_keV\tweight\n19\t0.5\n21\t0.5\n");
  ASSERT_EQ(run("project-mammogram",
                {"cc.vtkhdf", "poly.vti", "--energy", "spectrum.tsv", "--pixel", "2"})
                .exit_code,
            0);
  const ToolResult outside = run("project-mammogram", {"cc.vtkhdf", "no.vti", "--energy", "200"});
  EXPECT_EQ(outside.exit_code, 2);
  EXPECT_EQ(outside.error_lines(), 1) << outside.err;
  EXPECT_FALSE(fs::exists(file("no.vti")));
}

TEST_F(MammoTools, AnUncompressedMeshIsRefused) {
  const ToolResult result = run("project-mammogram", {"reference.vtkhdf", "no.vti"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.error_lines(), 1) << result.err;
  EXPECT_NE(result.err.find("compress"), std::string::npos);
  EXPECT_FALSE(fs::exists(file("no.vti")));
}

TEST_F(MammoTools, TheTumourLiesOnItsCurve) {
  const ToolResult result =
      run("cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "curve.vtp", "--landmark", "tumour", "--table",
                     "curve.tsv", "--report", "curve.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(result.out.empty());
  const Table table = read_table(file("curve.tsv"));
  ASSERT_EQ(table.rows.size(), 1u);
  EXPECT_EQ(table.rows[0][std::size_t(table.column("status"))], "matched");
  const Report report = Report::parse(read_text(file("curve.json")), "curve.json");
  // The model's own place is no truth: nothing is called so.
  EXPECT_LT(report.number("model_to_curve_mm"), 1e-4);
  EXPECT_FALSE(report.contains("true_to_curve_mm"));
  EXPECT_FALSE(report.contains("truth/points"));
  EXPECT_GE(table.column("model_to_curve_mm"), 0);
  EXPECT_FALSE(table.has("true_to_curve_mm"));
  EXPECT_NEAR(report.number("inside_image_percent"), 100, 1e-9);
  EXPECT_EQ(report.number("statuses/matched"), 1);
  EXPECT_LT(report.number("max_bend_mm"), 1e-5);  // both squashes are affine
  const PolyLines lines = read_polylines(file("curve.vtp"));
  for (const char* name : {"curve", "arc", "chord", "column in CC", "column in reference",
                           "column in MLO", "model's tumour in MLO", "nipple in CC"}) {
    EXPECT_NE(std::find(lines.line_names.begin(), lines.line_names.end(), name),
              lines.line_names.end())
        << name;
  }
  EXPECT_EQ(lines.history.back().tool, "cc2mlo");
}

TEST_F(MammoTools, ThePointOfTheImageIsTheLandmarksPoint) {
  // u,v of the projected tumour as project-mammogram reports it, given back to cc2mlo.
  ASSERT_EQ(run("project-mammogram", {"cc.vtkhdf", "uv.vti", "--pixel", "1", "--report", "uv.json"})
                .exit_code,
            0);
  const std::string point = tumour_mark("cc.vtkhdf", "uv.vti");
  const ToolResult given = run("cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "p.vtp", "--point", point});
  const ToolResult named =
      run("cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "q.vtp", "--landmark", "tumour"});
  ASSERT_EQ(given.exit_code, 0) << given.err;
  const Table a = parse_table(given.out, "point"), b = parse_table(named.out, "landmark");
  for (const char* column : {"cc_u_mm", "cc_v_mm", "curve_mm", "nipple_distance_mm"}) {
    EXPECT_EQ(a.rows[0][std::size_t(a.column(column))], b.rows[0][std::size_t(b.column(column))]);
  }
}

TEST_F(MammoTools, AirAndWrongQuestionsAreRefused) {
  for (const std::vector<std::string>& question : {std::vector<std::string>{"--point", "1,1"},
                                                   {"--landmark", "lesion"},
                                                   {},
                                                   {"--point", "7"},
                                                   {"--grid", "3", "--landmark", "tumour"}}) {
    std::vector<std::string> arguments{"cc.vtkhdf", "mlo.vtkhdf", "none.vtp"};
    arguments.insert(arguments.end(), question.begin(), question.end());
    const ToolResult result = run("cc2mlo", arguments);
    EXPECT_EQ(result.exit_code, 2) << result.err;
    EXPECT_FALSE(fs::exists(file("none.vtp")));
  }
  const ToolResult swapped =
      run("cc2mlo", {"cc.vtkhdf", "supine.vtkhdf", "none.vtp", "--grid", "2"});
  EXPECT_EQ(swapped.exit_code, 2);
  EXPECT_EQ(swapped.error_lines(), 1) << swapped.err;
  for (const auto& [first, second] : {std::pair{"cc", "cc"}, {"mlo", "mlo"}}) {
    const ToolResult views =
        run("cc2mlo", {std::string(first) + ".vtkhdf", std::string(second) + ".vtkhdf", "none.vtp",
                       "--grid", "2"});
    EXPECT_EQ(views.exit_code, 2);
    EXPECT_EQ(views.error_lines(), 1) << views.err;
    EXPECT_NE(views.err.find("different views"), std::string::npos) << views.err;
    EXPECT_FALSE(fs::exists(file("none.vtp")));
  }
}

TEST_F(MammoTools, TheOtherWayRoundAndBack) {
  // MLO to CC: the curve of the tumour's MLO projection passes through its CC projection.
  const ToolResult result =
      run("cc2mlo", {"mlo.vtkhdf", "cc.vtkhdf", "back.vtp", "--landmark", "tumour", "--geometry",
                     "cone", "--report", "back.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.out.find("mlo_u_mm"), std::string::npos);
  const Report report = Report::parse(read_text(file("back.json")), "back.json");
  EXPECT_LT(report.number("model_to_curve_mm"), 1e-3);
  EXPECT_LT(report.number("milliseconds_per_curve"), 1000);
}

TEST_F(MammoTools, TwoMarksGiveThePointInTheBody) {
  ASSERT_EQ(run("project-mammogram", {"cc.vtkhdf", "p.vti", "--pixel", "2"}).exit_code, 0);
  ASSERT_EQ(run("project-mammogram", {"mlo.vtkhdf", "q.vti", "--pixel", "2"}).exit_code, 0);
  const ToolResult result =
      run("cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "pair.vtp", "--pair",
                     tumour_mark("cc.vtkhdf", "p.vti") + "," + tumour_mark("mlo.vtkhdf", "q.vti"),
                     "--supine", "supine.vtkhdf", "--report", "pair.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Report report = Report::parse(read_text(file("pair.json")), "pair.json");
  EXPECT_LT(report.number("spot/residual_mm"), 0.02);
  EXPECT_LT(report.number("spot/first_to_second_mm"), 1e-3);
  EXPECT_LT(report.number("marked_to_curve_mm"), 1e-3);  // a mark is neither truth nor model
  EXPECT_FALSE(report.contains("true_to_curve_mm"));
  const std::string json = read_text(file("pair.json"));
  for (const char* frame : {"imaged", "reference", "supine", "CC", "MLO"}) {
    EXPECT_NE(json.find('"' + std::string(frame) + '"'), std::string::npos) << frame;
  }
  const ToolResult air = run("cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "no.vtp", "--pair", "1,1,1,1"});
  EXPECT_EQ(air.exit_code, 2);
  EXPECT_EQ(air.error_lines(), 1) << air.err;
}

TEST_F(MammoTools, TablesOfPointsAndOfTruth) {
  write_text(file("points.tsv"), "name\tu_mm\tv_mm\na\t30\t60\nb\t1\t0.5\n");
  const ToolResult many =
      run("cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "m.vtp", "--points", "points.tsv"});
  ASSERT_EQ(many.exit_code, 0) << many.err;
  const Table table = parse_table(many.out, "points");
  ASSERT_EQ(table.rows.size(), 2u);
  EXPECT_EQ(table.rows[0][1], "a");
  EXPECT_EQ(table.rows[1][2], "air");
  // Truth from the meshes themselves: the curve is exact, arc and line are not.
  const HexMesh cc = read_mesh(file("cc.vtkhdf")), mlo = read_mesh(file("mlo.vtkhdf"));
  std::string truth = "landmark\tside\tcc_x_mm\tcc_y_mm\tcc_z_mm\tmlo_x_mm\tmlo_y_mm\tmlo_z_mm\n";
  for (int e = 0; e < cc.elements(); e += 29) {
    truth += "e" + std::to_string(e) + "\t" + std::string(side_name(cc.side));
    for (const HexMesh* mesh : {&cc, &mlo}) {
      const Vec3 x = element_position(*mesh, mesh->points, e, Vec3::Zero());
      for (int k = 0; k < 3; ++k) truth += "\t" + format_number(x[k]);
    }
    truth += "\n";
  }
  write_text(file("truth.tsv"), truth);
  const ToolResult judged = run(
      "cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "t.vtp", "--truth", "truth.tsv", "--report", "t.json"});
  ASSERT_EQ(judged.exit_code, 0) << judged.err;
  const Report report = Report::parse(read_text(file("t.json")), "t.json");
  EXPECT_GT(report.number("truth/points"), 5);
  EXPECT_LT(report.number("truth/curve/max_mm"), 1e-3);
  EXPECT_GT(report.number("truth/arc/mean_mm"), 0.1);
  EXPECT_LT(report.number("truth/line/max_mm"), 1e-6);  // these squashes keep every depth
  const Table rows = parse_table(judged.out, "truth");
  const auto cell = [&](std::size_t row, const char* column) {
    return rows.rows.at(row).at(std::size_t(rows.column(column)));
  };
  const std::size_t points = std::size_t(report.number("truth/points"));
  ASSERT_GE(rows.rows.size(), points + 3);
  const std::size_t mean = rows.rows.size() - 3;
  EXPECT_EQ(cell(mean, "landmark"), "mean");
  EXPECT_EQ(cell(mean + 2, "landmark"), "largest");
  EXPECT_NEAR(std::stod(cell(mean, "true_to_arc_mm")), report.number("truth/arc/mean_mm"), 1e-4);
  // Arc and line are read from the true nipple when the table has it: 5 mm further back in MLO.
  const Vec3 nipple_cc = landmark_position(cc, cc.points, *cc.landmark("nipple")),
             nipple_mlo = landmark_position(mlo, mlo.points, *mlo.landmark("nipple"));
  truth += "nipple\t" + std::string(side_name(cc.side));
  for (const Vec3& x : {nipple_cc, Vec3(nipple_mlo + Vec3(0, 5, 0))}) {
    for (int k = 0; k < 3; ++k) truth += "\t" + format_number(x[k]);
  }
  truth += "\nbehind\t" + std::string(side_name(cc.side)) + "\t0\t500\t0\t0\t500\t0\n";
  write_text(file("truth.tsv"), truth);
  const ToolResult other = run(
      "cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "t.vtp", "--truth", "truth.tsv", "--report", "o.json"});
  ASSERT_EQ(other.exit_code, 0) << other.err;
  const Report moved = Report::parse(read_text(file("o.json")), "o.json");
  EXPECT_NEAR(moved.number("truth/line/max_mm"), 5, 1e-6);
  EXPECT_GE(moved.number("truth/behind_first_image"), 1);
}

TEST_F(MammoTools, ADifferenceOfTwoModelsIsATermOfTheBand) {
  const HexMesh body = read_mesh(file("reference.vtkhdf"), {.reference = true});
  for (const View view : {View::cc, View::mlo}) {
    const std::string name = view_name(view);
    for (const double step : {1.0, -1.0}) {  // half a millimetre anterior, in MLO only
      HexMesh moved = fixtures::squashed(body, view, 0.6);
      for (Vec3& x : moved.points) x.y() -= view == View::mlo ? 0.5 * step : 0;
      write_mesh(file((step > 0 ? "plus-" : "minus-") + name + ".vtkhdf"), moved);
    }
    const std::string state = view == View::cc ? "cc.vtkhdf" : "mlo.vtkhdf";
    const ToolResult result =
        run("difference", {state, "plus-" + name + ".vtkhdf", "minus-" + name + ".vtkhdf",
                           name + "-band.vtkhdf", "--report", "difference.json"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_LT(Report::parse(read_text(file("difference.json")), "d").number("outside_mm"), 1e-6);
  }
  const ToolResult band = run("cc2mlo", {"CC-band.vtkhdf", "MLO-band.vtkhdf", "b.vtp", "--landmark",
                                         "tumour", "--band", "--report", "band.json"});
  ASSERT_EQ(band.exit_code, 0) << band.err;
  const Report report = Report::parse(read_text(file("band.json")), "band.json");
  EXPECT_NEAR(report.number("band/deviation_mm/chest_wall"), 0.5, 1e-3);  // across the curve
  const ToolResult views =
      run("difference", {"cc.vtkhdf", "plus-MLO.vtkhdf", "minus-CC.vtkhdf", "no.vtkhdf"});
  EXPECT_EQ(views.exit_code, 2);
  EXPECT_EQ(views.error_lines(), 1) << views.err;
}

TEST_F(MammoTools, ABandWithoutDerivativesIsRefused) {
  const ToolResult result = run("cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "none.vtp", "--landmark",
                                           "tumour", "--band", "--table", "none.tsv"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.error_lines(), 1) << result.err;
  EXPECT_NE(result.err.find("sensitivity"), std::string::npos) << result.err;
  EXPECT_FALSE(fs::exists(file("none.vtp")) || fs::exists(file("none.tsv")));
  // Without a model in the file, its set must be named, or the priors.
  HexMesh foreign = read_mesh(file("cc.vtkhdf"));
  foreign.model.reset();
  write_mesh(file("foreign.vtkhdf"), foreign);
  const ToolResult unknown =
      run("cc2mlo", {"foreign.vtkhdf", "mlo.vtkhdf", "none.vtp", "--landmark", "tumour", "--band"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_EQ(unknown.error_lines(), 1) << unknown.err;
  EXPECT_NE(unknown.err.find("does not state the model"), std::string::npos) << unknown.err;
  // The marks alone, asked for by name, are no mistake.
  write_text(file("marks.tsv"), "parameter\tstandard_deviation\npicking\t1\nmarking\t1\n");
  EXPECT_EQ(run("cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "marks.vtp", "--landmark", "tumour", "--band",
                           "--priors", "marks.tsv"})
                .exit_code,
            0);
  // The lookup leaves the band out, and says so.
  const ToolResult lookup = run("match-lookup", {"cc.vtkhdf", "mlo.vtkhdf", "lookup.h5", "--pitch",
                                                 "8", "--report", "lookup.json"});
  ASSERT_EQ(lookup.exit_code, 0) << lookup.err;
  EXPECT_NE(lookup.err.find("no band"), std::string::npos) << lookup.err;
  EXPECT_NE(read_text(file("lookup.json")).find("\"band\": false"), std::string::npos);
}

TEST_F(MammoTools, ACurveThatLeavesTheImageSaysHowMuchOfIt) {
  // The MLO shape sheared so that the upper half of every column goes back behind the image's edge.
  HexMesh mlo = read_mesh(file("mlo.vtkhdf"), {.contact = true});
  HexMesh sheared = fixtures::deformed(
      mlo, View::mlo, [](const Vec3& x) { return Vec3(x.x(), x.y() + 0.9 * x.z(), 0.6 * x.z()); });
  write_mesh(file("sheared.vtkhdf"), sheared);
  const ToolResult result = run("cc2mlo", {"cc.vtkhdf", "sheared.vtkhdf", "s.vtp", "--grid", "6",
                                           "--table", "s.tsv", "--report", "s.json"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Report report = Report::parse(read_text(file("s.json")), "s.json");
  const double inside = report.number("inside_image_percent");
  EXPECT_GT(inside, 5);
  EXPECT_LT(inside, 95);
  EXPECT_NE(result.err.find("outside the MLO image"), std::string::npos) << result.err;
  const Table table = read_table(file("s.tsv"));
  double length = 0, within = 0;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const double curve = table.number(r, "curve_mm");
    length += curve;
    within += curve * table.number(r, "inside_image_percent") / 100;
  }
  EXPECT_NEAR(100 * within / length, inside, 0.01);
}

TEST_F(MammoTools, AGridGivesOneRowAPoint) {
  const ToolResult result = run("cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "g.vtp", "--grid", "4"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const Table table = parse_table(result.out, "grid");
  EXPECT_GE(table.rows.size(), 8u);
  EXPECT_LE(table.rows.size(), 16u);
}
