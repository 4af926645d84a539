// SPDX-License-Identifier: GPL-3.0-or-later
// hexmesh from files to file: counts, contract keys of the report, refusals.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "fixtures/analytic_breast.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "image/label_volume.hpp"
#include "io/geometry_file.hpp"
#include "io/label_file.hpp"
#include "io/mesh_file.hpp"
#include "io/segmentation_file.hpp"
#include "io/volume_file.hpp"
#include "mesh/locate.hpp"
#include "mesh/part.hpp"
#include "mesh/quality.hpp"
#include "mesh/surroundings.hpp"

namespace breast {
namespace {

class HexmeshTool : public testing::Test {
 protected:
  // The analytic breast in voxels of 3 mm: a box of fat with a ball of gland behind the nipple.
  void SetUp() override {
    BreastGeometry geometry = analytic_breast();
    geometry.history.push_back({"fit-hermite", "0", "analytic", {}});
    write_geometry(folder_ / "geometry.vtkhdf", geometry);
    write_labels(folder_ / "labels.vtkhdf", labels_with(Tissue::fibroglandular, 22));
  }
  /// A ball about (0, 45, 0) mm in a box of fat.
  static LabelVolume labels_with(Tissue tissue, double radius) {
    LabelVolume labels;
    labels.grid.size = {57, 50, 57};
    labels.grid.spacing = Vec3::Constant(3);
    labels.grid.origin = Vec3(-84, -20, -84);
    labels.tissue.assign(labels.grid.voxels(), std::uint8_t(Tissue::fat));
    labels.fibroglandular_fraction.assign(labels.grid.voxels(), 0);
    labels.chest_wall_confidence.assign(labels.grid.voxels(), 1);
    for (int k = 0; k < 57; ++k) {
      for (int j = 0; j < 50; ++j) {
        for (int i = 0; i < 57; ++i) {
          const Vec3 at = labels.grid.to_patient(Vec3(i, j, k));
          if ((at - Vec3(0, 45, 0)).norm() > radius) continue;
          labels.tissue[labels.grid.offset(i, j, k)] = std::uint8_t(tissue);
          labels.fibroglandular_fraction[labels.grid.offset(i, j, k)] =
              tissue == Tissue::fibroglandular;
        }
      }
    }
    labels.history.push_back({"segment", "0", "analytic", {}});
    return labels;
  }
  /// The labels are a box, not the geometry's body.
  ToolResult hexmesh(std::vector<std::string> options) {
    std::vector<std::string> arguments = {"geometry.vtkhdf", "labels.vtkhdf", "mesh.vtkhdf",
                                          "--quiet",         "--threads",     "1",
                                          "--report",        "r.json",        "--accept-mismatch"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_tool("hexmesh", arguments, folder_.path());
  }
  bool written() const { return std::filesystem::exists(folder_ / "mesh.vtkhdf"); }
  ScratchFolder folder_;
};

TEST_F(HexmeshTool, DefaultIsADomeWithMembraneSkinAndTumour) {
  const ToolResult result = hexmesh({});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const HexMesh mesh = read_mesh(folder_ / "mesh.vtkhdf");
  EXPECT_EQ(mesh.elements(), 4000);
  EXPECT_EQ(mesh.template_name, "dome");
  EXPECT_EQ(mesh.skin_model, SkinModel::membrane);
  EXPECT_EQ(mesh.skin_thickness, std::vector<double>(mesh.skin_faces.size(), 1.45));
  EXPECT_EQ(mesh.imaged, mesh.points);
  EXPECT_TRUE(mesh.geometry);
  EXPECT_EQ(mesh.history.size(), 3u);
  ASSERT_NE(mesh.landmark("nipple"), nullptr);
  ASSERT_NE(mesh.landmark("tumour"), nullptr);
  EXPECT_EQ(mesh.landmark("tumour")->name, "artificial_tumour");
  EXPECT_NE(read_text(folder_ / "r.json").find("the tumour is artificial"), std::string::npos);
  const ToolResult probe =
      run_tool("probe", {"mesh.vtkhdf", "--landmarks", "tumour"}, folder_.path());
  EXPECT_NE(probe.out.find("artificial_tumour_x_mm"), std::string::npos) << probe.out;
  EXPECT_LT(mesh.landmark("nipple")->moved, 0.01);
  const Report report = Report::parse(read_text(folder_ / "r.json"), "r.json");
  EXPECT_EQ(report.number("elements"), 4000);
  EXPECT_GT(report.number("min_scaled_jacobian"), 0.6);
  EXPECT_NEAR(report.number("volumes_ml/fibroglandular"), 44.6, 5);
  EXPECT_NEAR(report.number("sheet_volume_error_percent"), 0, 0.5);
}

TEST_F(HexmeshTool, SurroundingsHoldTheBreastAndAreLeftOutByCompress) {
  ASSERT_EQ(
      hexmesh({"--elements", "5", "--tumour", "none", "--surroundings", "12", "--muscle", "8"})
          .exit_code,
      0);
  const Report report = Report::parse(read_text(folder_ / "r.json"), "r.json");
  EXPECT_GE(report.number("surroundings_mm"), 6);
  EXPECT_GT(report.number("volumes_ml/other"), 20);
  const HexMesh whole = read_mesh(folder_ / "mesh.vtkhdf");
  for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
           {"backward", "mesh.vtkhdf", "free.vtkhdf", "--materials", "invivo"},
           {"forward", "free.vtkhdf", "supine.vtkhdf", "--posture", "supine", "--materials",
            "invivo"},
           {"compress", "free.vtkhdf", "cc.vtkhdf", "--view", "CC", "--reduction", "20",
            "--standoff", "5", "--materials", "invivo"}}) {
    std::vector<std::string> arguments(words.begin() + 1, words.end());
    arguments.insert(arguments.end(), {"--quiet", "--threads", "1"});
    const ToolResult result = run_tool(words[0], arguments, folder_.path());
    ASSERT_EQ(result.exit_code, 0) << words[0] << ": " << result.err;
  }
  EXPECT_EQ(read_mesh(folder_ / "supine.vtkhdf").elements(), whole.elements());
  const HexMesh pressed = read_mesh(folder_ / "cc.vtkhdf"),
                breast = restricted(whole, breast_elements);
  EXPECT_LT(pressed.elements(), whole.elements());
  EXPECT_EQ(pressed.connectivity, breast.connectivity);
  EXPECT_EQ(pressed.imaged, breast.imaged);
  EXPECT_EQ(hexmesh({"--surroundings", "61"}).exit_code, 2);
  EXPECT_EQ(hexmesh({"--surroundings", "8", "--skin-as", "layer"}).exit_code, 2);
}

// Points of 3D Slicer's older format are read, and a file without a point is not silently nothing.
TEST_F(HexmeshTool, LandmarksAreReadOrRefused) {
  const std::string comments =
      "# Markups fiducial file version = 4.10\n# CoordinateSystem = 0\n"
      "# columns = id,x,y,z,ow,ox,oy,oz,vis,sel,lock,label,desc,associatedNodeID\n";
  ASSERT_EQ(hexmesh({"--elements", "5", "--tumour", "none"}).exit_code, 0);
  const HexMesh mesh = read_mesh(folder_ / "mesh.vtkhdf");
  const Vec3 at = mesh.imaged[mesh.connectivity[mesh.connectivity.size() / 2]];
  std::ostringstream row;
  row << "n0," << -at.x() << "," << -at.y() << "," << at.z() << ",0,0,0,1,1,1,0,clip,,\n";
  write_text(folder_ / "points.fcsv", comments + row.str());
  const ToolResult read =
      hexmesh({"--elements", "5", "--tumour", "none", "--landmarks", "points.fcsv"});
  ASSERT_EQ(read.exit_code, 0) << read.err;
  const HexMesh marked = read_mesh(folder_ / "mesh.vtkhdf");
  ASSERT_NE(marked.landmark("clip"), nullptr);
  EXPECT_LT((landmark_position(marked, marked.imaged, *marked.landmark("clip")) - at).norm(), 0.01);
  std::filesystem::remove(folder_ / "mesh.vtkhdf");
  write_text(folder_ / "none.fcsv", comments);
  write_text(folder_ / "none.tsv", "# points to come\n");
  for (const char* file : {"none.fcsv", "none.tsv"}) {
    const ToolResult none = hexmesh({"--elements", "5", "--tumour", "none", "--landmarks", file});
    EXPECT_EQ(none.exit_code, 2) << file;
    EXPECT_EQ(none.error_lines(), 1) << none.err;
    EXPECT_FALSE(written()) << file;
  }
}

TEST_F(HexmeshTool, AGeometryOfAnotherBodyIsRefusedUnlessAccepted) {
  const ToolResult refused = run_tool(
      "hexmesh", {"geometry.vtkhdf", "labels.vtkhdf", "mesh.vtkhdf", "--quiet"}, folder_.path());
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.error_lines(), 1) << refused.err;
  EXPECT_NE(refused.err.find("does not agree with the labels"), std::string::npos) << refused.err;
  EXPECT_NE(refused.err.find("--accept-mismatch"), std::string::npos) << refused.err;
  EXPECT_FALSE(written());
  ASSERT_EQ(hexmesh({"--elements", "8"}).exit_code, 0);
  EXPECT_NE(read_text(folder_ / "r.json").find("does not agree with the labels"),
            std::string::npos);
}

TEST_F(HexmeshTool, CuboidWithLayerHasThePapersCounts) {
  const ToolResult result =
      hexmesh({"--template", "cuboid", "--skin-as", "layer", "--tumour", "none"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const HexMesh mesh = read_mesh(folder_ / "mesh.vtkhdf");
  EXPECT_EQ(mesh.elements(), 4096);
  EXPECT_EQ(mesh.nodes(), 4913);
  EXPECT_EQ(mesh.skin_model, SkinModel::layer);
  EXPECT_TRUE(mesh.skin_thickness.empty());
  EXPECT_EQ(mesh.landmark("tumour"), nullptr);
  for (const Face& face : mesh.skin_faces) EXPECT_EQ(mesh.tissue[face.element], Tissue::skin);
}

TEST_F(HexmeshTool, TumourFromTextAndTable) {
  ASSERT_EQ(hexmesh({"--elements", "8", "--tumour", "10,45,5:9"}).exit_code, 0);
  EXPECT_EQ(read_mesh(folder_ / "mesh.vtkhdf").landmark("tumour")->imaged, Vec3(10, 45, 5));
  write_text(folder_ / "tumour.tsv", "x_mm\ty_mm\tz_mm\tradius_mm\n-8\t40\t2\t10\n");
  ASSERT_EQ(hexmesh({"--elements", "8", "--tumour", "tumour.tsv"}).exit_code, 0);
  const HexMesh mesh = read_mesh(folder_ / "mesh.vtkhdf");
  EXPECT_EQ(mesh.landmark("tumour")->imaged, Vec3(-8, 40, 2));
  EXPECT_EQ(mesh.tissue[mesh.landmark("tumour")->element], Tissue::tumour);
}

TEST_F(HexmeshTool, TumourAsNode) {
  ASSERT_EQ(hexmesh({"--elements", "8", "--tumour", "10,45,5"}).exit_code, 0);
  const HexMesh mesh = read_mesh(folder_ / "mesh.vtkhdf");
  EXPECT_EQ(std::count(mesh.tissue.begin(), mesh.tissue.end(), Tissue::tumour), 0);
  const Landmark& tumour = *mesh.landmark("tumour");
  const Vec3 at(10, 45, 5);
  EXPECT_LT((element_position(mesh, mesh.points, tumour.element, tumour.local) - at).norm(), 1e-6);
  for (const Vec3& x : mesh.points)
    EXPECT_LE((mesh.points[std::size_t(mesh.tumour_node)] - at).norm(), (x - at).norm());
}

TEST_F(HexmeshTool, TumourAsElement) {
  ASSERT_EQ(hexmesh({"--elements", "8", "--tumour", "10,45,5:0.5"}).exit_code, 0);
  const HexMesh mesh = read_mesh(folder_ / "mesh.vtkhdf");
  ASSERT_EQ(std::count(mesh.tissue.begin(), mesh.tissue.end(), Tissue::tumour), 1);
  EXPECT_EQ(mesh.tissue[mesh.landmark("tumour")->element], Tissue::tumour);
}

TEST_F(HexmeshTool, TumourAsSphereHasItsVolume) {
  const double radius = 16;
  ASSERT_EQ(hexmesh({"--tumour", "4,48,-3:16"}).exit_code, 0);
  const Report report = Report::parse(read_text(folder_ / "r.json"), "r.json");
  const double ball = 4 * std::numbers::pi / 3 * std::pow(radius, 3) / 1000;  // ml
  EXPECT_NEAR(report.number("volumes_ml/tumour") / ball, 1, 0.05);
  const HexMesh mesh = read_mesh(folder_ / "mesh.vtkhdf");
  const std::vector<double> volumes = element_volumes(mesh, mesh.points);
  double sum = 0, farthest = 0;
  for (int e = 0; e < mesh.elements(); ++e) {
    if (mesh.tissue[e] != Tissue::tumour) continue;
    sum += volumes[e] / 1000;
    const Vec3 middle = element_position(mesh, mesh.points, e, Vec3::Zero());
    farthest = std::max(farthest, (middle - Vec3(4, 48, -3)).norm());
  }
  EXPECT_NEAR(report.number("volumes_ml/tumour"), sum, 1e-6 * sum);
  EXPECT_LT(farthest, radius + 1) << "its elements lie together";
}

/// Tumour voxels of the labels themselves, and of labels given beside them.
TEST_F(HexmeshTool, TumourOfLabels) {
  const LabelVolume marked = labels_with(Tissue::tumour, 15);
  write_labels(folder_ / "marked.vtkhdf", marked);
  const double voxels =
      double(std::count(marked.tissue.begin(), marked.tissue.end(), std::uint8_t(Tissue::tumour))) *
      marked.grid.voxel_volume() / 1000;
  ASSERT_EQ(hexmesh({"--tumour", "marked.vtkhdf"}).exit_code, 0);
  const Report beside = Report::parse(read_text(folder_ / "r.json"), "r.json");
  EXPECT_NEAR(beside.number("volumes_ml/tumour") / voxels, 1, 0.05);
  EXPECT_GT(beside.number("volumes_ml/fibroglandular"), 10) << "the gland around it stays";
  EXPECT_LT((read_mesh(folder_ / "mesh.vtkhdf").landmark("tumour")->imaged - Vec3(0, 45, 0)).norm(),
            0.1);

  // As a program writes it that knows nothing of tissues.
  Volume<float> mask;
  mask.grid = marked.grid;
  for (const std::uint8_t value : marked.tissue)
    mask.voxels.push_back(value == std::uint8_t(Tissue::tumour) ? 255 : 0);
  write_volume(folder_ / "mask.nrrd", mask);
  ASSERT_EQ(hexmesh({"--tumour", "mask.nrrd"}).exit_code, 0);
  EXPECT_EQ(Report::parse(read_text(folder_ / "r.json"), "r.json").number("volumes_ml/tumour"),
            beside.number("volumes_ml/tumour"));
  const ToolResult neither = hexmesh({"--tumour", "labels.vtkhdf"});
  EXPECT_EQ(neither.exit_code, 2);
  EXPECT_NE(neither.err.find("no tumour voxels"), std::string::npos) << neither.err;
  // One tissue with a name is no mask.
  write_segmentation(folder_ / "gland.seg.nrrd", labels_with(Tissue::fibroglandular, 15));
  EXPECT_EQ(hexmesh({"--tumour", "gland.seg.nrrd"}).exit_code, 2);

  write_labels(folder_ / "labels.vtkhdf", marked);
  ASSERT_EQ(hexmesh({}).exit_code, 0);
  const Report own = Report::parse(read_text(folder_ / "r.json"), "r.json");
  EXPECT_NEAR(own.number("volumes_ml/tumour") / voxels, 1, 0.1) << "elements at least half tumour";
}

TEST_F(HexmeshTool, CurvedBoundaryAndTetrahedra) {
  const ToolResult result = hexmesh({"--elements", "8", "--order", "2", "--tetrahedra", "t.vtu"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const HexMesh mesh = read_mesh(folder_ / "mesh.vtkhdf");
  EXPECT_EQ(mesh.order, 2);
  EXPECT_EQ(mesh.connectivity.size(), 27u * mesh.elements());
  EXPECT_LT(mesh.landmark("nipple")->moved, 0.01);
  const Report report = Report::parse(read_text(folder_ / "r.json"), "r.json");
  EXPECT_LT(report.number("boundary/skin_mean_mm"), 0.05);
  EXPECT_GT(report.number("boundary/curved_nodes"), 500);
  EXPECT_EQ(report.number("boundary/held_back_nodes"), 0);
  EXPECT_GT(report.number("min_det_bound_mm3"), 0);
  EXPECT_NEAR(report.number("sheet_volume_error_percent"), 0, 0.1);
  EXPECT_NEAR(report.number("tetrahedra/volume_error_percent"), 0, 1);
  EXPECT_GT(report.number("tetrahedra/least_volume_mm3"), 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "t.vtu"));
}

TEST_F(HexmeshTool, TetrahedraInTwoStepsAreTheSame) {
  ASSERT_EQ(hexmesh({"--elements", "8", "--tetrahedra", "one.vtu"}).exit_code, 0);
  const Report one = Report::parse(read_text(folder_ / "r.json"), "r.json");
  const auto tetrahedra = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"mesh.vtkhdf", "two.vtu", "--report", "t.json"});
    const ToolResult result = run_tool("tetrahedra", arguments, folder_.path());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return Report::parse(read_text(folder_ / "t.json"), "t.json");
  };
  const Report two = tetrahedra({});
  for (const char* key : {"count", "nodes", "volume_ml", "least_dihedral_deg"})
    EXPECT_EQ(two.text(std::string("tetrahedra/") + key),
              one.text(std::string("tetrahedra/") + key));
  EXPECT_GT(tetrahedra({"--edge", "6"}).number("tetrahedra/count"),
            2 * two.number("tetrahedra/count"));
}

TEST_F(HexmeshTool, TetrahedraWithoutTheirProgramAreRefusedAtOnce) {
  std::filesystem::copy_file(tool_path("hexmesh"), folder_ / "hexmesh");
  const ToolResult result = run_tool(
      (folder_ / "hexmesh").string(),
      {"geometry.vtkhdf", "labels.vtkhdf", "mesh.vtkhdf", "--tetrahedra", "t.vtu"}, folder_.path());
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.error_lines(), 1) << result.err;
  EXPECT_NE(result.err.find("--target tetrahedra"), std::string::npos) << result.err;
  EXPECT_FALSE(written());
}

TEST_F(HexmeshTool, SameFileFromTwoRuns) {
  ASSERT_EQ(hexmesh({"--elements", "8"}).exit_code, 0);
  const HexMesh first = read_mesh(folder_ / "mesh.vtkhdf");
  ASSERT_EQ(hexmesh({"--elements", "8"}).exit_code, 0);
  EXPECT_EQ(first.content_sha256, read_mesh(folder_ / "mesh.vtkhdf").content_sha256);
}

TEST_F(HexmeshTool, BadUseIsOneLineAndNoFile) {
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--dome", "10,10,6,10"},
                                                  {"--dome", "10,10,0,3"},
                                                  {"--dome", "4,4,2.5,1"},
                                                  {"--skin", "-1"},
                                                  {"--skin", "0.00145"},
                                                  {"--skin", "1450"},
                                                  {"--skin", "measured"},
                                                  {"--tumour", "0,0"},
                                                  {"--tumour", "0,-300,0"},
                                                  {"--elements", "3"},
                                                  {"--order", "3"},
                                                  {"--tetrahedra", "t.vtk"},
                                                  {"--tetrahedra", "t.vtu", "--skin-as", "layer"},
                                                  {"--template", "cuboid", "--dome", "4,4,2,1"}}) {
    const ToolResult result = hexmesh(options);
    EXPECT_EQ(result.exit_code, 2) << options[1] << ": " << result.err;
    EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1) << result.err;
    EXPECT_FALSE(written()) << options[1];
  }
}

}  // namespace
}  // namespace breast
