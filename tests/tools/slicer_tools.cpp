// SPDX-License-Identifier: GPL-3.0-or-later
// export-slicer as a user runs it: ITK and VTK open every file, fields lead where the mesh does, the scene names what
// is there; and what the tools say of Slicer's files.
#include <gtest/gtest.h>
#include <itkDisplacementFieldTransform.h>
#include <itkImageFileReader.h>
#include <itkMetaDataObject.h>
#include <itkNrrdImageIO.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <random>
#include <set>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "fixtures/chain_files.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/label_file.hpp"
#include "io/markups_file.hpp"
#include "io/segmentation_file.hpp"
#include "io/surface_file.hpp"
#include "io/volume_file.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;

using FieldTransform = itk::DisplacementFieldTransform<double, 3>;

// As Slicer reads a grid transform: an image of vectors of double, in LPS.
FieldTransform::Pointer read_field(const fs::path& file) {
  auto reader = itk::ImageFileReader<FieldTransform::DisplacementFieldType>::New();
  reader->SetImageIO(itk::NrrdImageIO::New());
  reader->SetFileName(file.string());
  reader->Update();
  auto transform = FieldTransform::New();
  transform->SetDisplacementField(reader->GetOutput());
  // By this Slicer knows that the field leads from the points of an image to those of the moving one.
  std::string type;
  itk::ExposeMetaData(reader->GetOutput()->GetMetaDataDictionary(), "displacement field type",
                      type);
  EXPECT_EQ(type, "resampling") << file;
  return transform;
}

Vec3 moved(const FieldTransform* transform, const Vec3& point) {
  const double at[3] = {point[0], point[1], point[2]};
  const auto there = transform->TransformPoint(itk::Point<double, 3>(at));
  return {there[0], there[1], there[2]};
}

std::string space_of(vtkDataObject* data) {
  auto* space = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("SPACE"));
  return space == nullptr ? "" : std::string(space->GetValue(0));
}

class SlicerExport : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ScratchFolder;
    fs::create_directory(at() / "run");
    fixtures::write_chain(at() / "run", 6);
    LabelVolume labels = read_labels(at() / "run/labels.vtkhdf");
    labels.history = {{"segment", "test", "segment scan.nrrd", {}}};
    fs::remove(at() / "run/labels.vtkhdf");
    write_labels(at() / "run/labels.vtkhdf", labels);
    said_ = run_line("export-slicer run out --spacing 2 --report report.json --threads 1", at());
  }
  static void TearDownTestSuite() { delete folder_; }
  static const fs::path& at() { return folder_->path(); }

  static ScratchFolder* folder_;
  static ToolResult said_;
};
ScratchFolder* SlicerExport::folder_ = nullptr;
ToolResult SlicerExport::said_;

TEST_F(SlicerExport, SceneNamesFilesThatAreThere) {
  ASSERT_EQ(said_.exit_code, 0) << said_.err;
  vtkNew<vtkXMLDataParser> parser;
  const std::string scene = (at() / "out/scene.mrml").string();
  parser->SetFileName(scene.c_str());
  ASSERT_EQ(parser->Parse(), 1);
  vtkXMLDataElement* root = parser->GetRootElement();
  ASSERT_STREQ(root->GetName(), "MRML");
  std::set<std::string> files, ids;
  for (int n = 0; n < root->GetNumberOfNestedElements(); ++n) {
    vtkXMLDataElement* node = root->GetNestedElement(n);
    EXPECT_TRUE(ids.insert(node->GetAttribute("id")).second);
    if (const char* file = node->GetAttribute("fileName")) files.insert(file);
  }
  for (const std::string& file : files)
    EXPECT_TRUE(fs::is_regular_file(at() / "out" / file)) << file;
  for (const char* file :
       {"labels.seg.nrrd", "prone-skin.vtp", "supine.vtu", "supine-points-to-scan.nrrd",
        "scan-points-to-cc.nrrd", "landmarks-mlo.mrk.json"})
    EXPECT_TRUE(files.count(file)) << file;
  // What is no part of the scene is the parts of the fields alone.
  for (const auto& entry : fs::directory_iterator(at() / "out")) {
    const std::string name = entry.path().filename().string();
    EXPECT_TRUE(files.count(name) || name == "scene.mrml" || name.ends_with("-part.nrrd")) << name;
  }
}

// What the labels alone know must come along: their history was once read from an object that was gone.
TEST_F(SlicerExport, ShapesKeepTheHistoryOfLabelsAndMesh) {
  std::set<std::string> tools;
  for (const HistoryEntry& entry : read_surface(at() / "out/prone-skin.vtp").history) {
    tools.insert(entry.tool);
  }
  EXPECT_EQ(tools, (std::set<std::string>{"segment", "hexmesh", "export-slicer"}));
}

TEST_F(SlicerExport, ItkMovesPointsAsTheMeshDoes) {
  const HexMesh mesh = read_mesh(at() / "run/supine.vtkhdf"),
                cc = read_mesh(at() / "run/cc.vtkhdf");
  const Report report = Report::parse(read_text(at() / "report.json"), "report.json");
  for (const auto& [name, state] : {std::pair{"supine", &mesh}, {"cc", &cc}}) {
    const auto there = read_field(at() / "out" / (std::string("scan-points-to-") + name + ".nrrd"));
    const auto back = read_field(at() / "out" / (std::string(name) + "-points-to-scan.nrrd"));
    std::mt19937 engine(3);
    double worst = 0, worst_back = 0;
    for (int n = 0; n < 300; ++n) {
      const auto uniform = [&] { return 2.0 * double(engine()) / 4294967295.0 - 1; };
      const Vec3 local(uniform(), uniform(), uniform());
      const int element = int(engine() % unsigned(mesh.elements()));
      const Vec3 from = element_position(*state, state->imaged, element, local),
                 to = element_position(*state, state->points, element, local);
      worst = std::max(worst, (moved(there, from) - to).norm());
      worst_back = std::max(worst_back, (moved(back, to) - from).norm());
    }
    const std::string key = std::string("fields/scan-points-to-") + name + "/max_mm";
    EXPECT_LT(worst, 0.05) << name;  // these states bend little: 2 mm suffice
    EXPECT_LT(worst_back, 0.1) << name;
    EXPECT_LT(worst, 3 * report.number(key) + 1e-3) << name;  // what the report says is so
  }
}

TEST_F(SlicerExport, VtkOpensShapesInLps) {
  for (const char* state : {"prone", "stress-free", "supine", "cc", "mlo"}) {
    const std::string mesh_name = std::string(state) == "prone"         ? "mesh"
                                  : std::string(state) == "stress-free" ? "reference"
                                                                        : state;
    const HexMesh mesh = read_mesh(at() / "run" / (mesh_name + ".vtkhdf"));
    vtkNew<vtkXMLUnstructuredGridReader> volume;
    volume->SetFileName((at() / "out" / (std::string(state) + ".vtu")).c_str());
    volume->Update();
    vtkUnstructuredGrid* grid = volume->GetOutput();
    ASSERT_EQ(grid->GetNumberOfCells(), mesh.elements()) << state;
    EXPECT_EQ(grid->GetCellType(0), VTK_HEXAHEDRON);
    EXPECT_EQ(space_of(grid), "LPS");
    double place[3], way[3];
    grid->GetPoint(11, place);
    EXPECT_LT((Vec3(place[0], place[1], place[2]) - mesh.points[11]).norm(), 1e-12);
    vtkDataArray* displacement = grid->GetPointData()->GetArray("displacement_from_scan");
    ASSERT_NE(displacement, nullptr);
    displacement->GetTuple(11, way);
    EXPECT_LT((Vec3(way[0], way[1], way[2]) - (mesh.points[11] - mesh.imaged[11])).norm(), 1e-12);
    ASSERT_NE(grid->GetCellData()->GetArray("tissue"), nullptr);
    vtkNew<vtkXMLPolyDataReader> surface;
    surface->SetFileName((at() / "out" / (std::string(state) + "-skin.vtp")).c_str());
    surface->Update();
    EXPECT_GT(surface->GetOutput()->GetNumberOfPolys(), 100);
    EXPECT_EQ(space_of(surface->GetOutput()), "LPS");
    const auto points =
        read_markups(at() / "out" / (std::string("landmarks-") + state + ".mrk.json"));
    const Landmark* tumour = mesh.landmark("tumour");
    EXPECT_LT(
        (point_named(points, "tumour", state).at - landmark_position(mesh, mesh.points, *tumour))
            .norm(),
        1e-9);
  }
}

TEST_F(SlicerExport, ItkOpensTheSegmentation) {
  auto reader = itk::ImageFileReader<itk::Image<unsigned char, 3>>::New();
  reader->SetImageIO(itk::NrrdImageIO::New());
  reader->SetFileName((at() / "out/labels.seg.nrrd").string());
  reader->Update();
  const LabelVolume labels = read_labels(at() / "run/labels.vtkhdf");
  const auto* image = reader->GetOutput();
  ASSERT_EQ(image->GetLargestPossibleRegion().GetNumberOfPixels(), labels.tissue.size());
  EXPECT_TRUE(std::equal(labels.tissue.begin(), labels.tissue.end(), image->GetBufferPointer()));
  std::string name;
  EXPECT_TRUE(
      itk::ExposeMetaData(image->GetMetaDataDictionary(), std::string("Segment0_Name"), name));
  EXPECT_EQ(name, "Fat");
}

TEST_F(SlicerExport, AgainReplacesItsOwnAndKeepsOthers) {
  write_text(at() / "out/notes.txt", "mine");
  const auto again = [&] { return run_line("export-slicer run out --no-fields --quiet", at()); };
  EXPECT_EQ(again().exit_code, 0);
  EXPECT_EQ(read_text(at() / "out/notes.txt"), "mine");
  const std::string edited =
      "{\"@schema\":\"s\",\"markups\":[]}";  // as Slicer saves it: no "tool" first
  write_text(at() / "out/landmarks-cc.mrk.json", edited);
  const ToolResult refused = again();
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.error_lines(), 1) << refused.err;
  EXPECT_EQ(read_text(at() / "out/landmarks-cc.mrk.json"), edited);
  fs::remove(at() / "out/landmarks-cc.mrk.json");
}

TEST_F(SlicerExport, BadInputIsOneLine) {
  Volume<float> other;
  other.grid.size = {8, 8, 8};
  other.voxels.assign(512, 1);
  write_volume(at() / "other.nrrd", other);
  fs::create_directory(at() / "empty");
  fs::copy(at() / "run", at() / "mixed");
  HexMesh alien = fixtures::landmarked_breast(5);
  alien.reference = alien.imaged;
  write_mesh(at() / "mixed/supine.vtkhdf", alien);
  const auto refuse = [&](const std::string& line, const std::string& what) {
    const ToolResult result = run_line(line, at());
    EXPECT_EQ(result.exit_code, 2) << line;
    EXPECT_EQ(result.error_lines(), 1) << result.err;
    EXPECT_NE(result.err.find(what), std::string::npos) << result.err;
  };
  refuse("export-slicer empty o", "labels.vtkhdf");
  refuse("export-slicer run run", "run itself");
  refuse("export-slicer run no/such/o", "make it first");
  refuse("export-slicer mixed o", "different elements");
  refuse("export-slicer other.nrrd o", "not the folder of a run");
  refuse("hexmesh run/geometry.vtkhdf out/labels.seg.nrrd m.vtkhdf --code wal=3",
         "'wal' is not a tissue");
  refuse("hexmesh run/geometry.vtkhdf out/labels.seg.nrrd m.vtkhdf --code 9=fat", "value 9");
  refuse("hexmesh run/geometry.vtkhdf other.nrrd m.vtkhdf", "--side");
  refuse("hexmesh run/geometry.vtkhdf run/labels.vtkhdf m.vtkhdf --side left", "takes no --code");
  refuse("segment other.nrrd l.vtkhdf --side left --chest-wall other.nrrd", "--code wall=NUMBER");
  refuse("segment other.nrrd l.vtkhdf --side left --code wall=3", "--chest-wall");
  EXPECT_FALSE(fs::exists(at() / "o"));
}

// Unedited, labels and points of Slicer give the mesh of the native files, whatever of it is looked at.
TEST_F(SlicerExport, WayBackGivesTheSameMesh) {
  const auto mesh = [&](const std::string& line) {
    const ToolResult result = run_line(
        "hexmesh run/geometry.vtkhdf " + line + " --elements 6 --accept-mismatch --quiet", at());
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return read_mesh(at() / "m.vtkhdf");
  };
  const Landmark tumour = *read_mesh(at() / "run/mesh.vtkhdf").landmark("tumour");
  write_markups(at() / "t.mrk.json", {"t", false, {1, 0, 0}, {{"tumour", tumour.imaged}}});
  const std::string ras =
      "{\"markups\":[{\"coordinateSystem\":\"RAS\",\"controlPoints\":[{\"label\":\"clip\","
      "\"position\":[-14,-30,12]}]}]}";
  write_text(at() / "clip.mrk.json", ras);
  const HexMesh native = mesh("run/labels.vtkhdf m.vtkhdf --tumour 14,30,12"),
                back = mesh(
                    "out/labels.seg.nrrd m.vtkhdf --native run/labels.vtkhdf --tumour t.mrk.json "
                    "--landmarks clip.mrk.json");
  EXPECT_EQ(back.imaged, native.imaged);
  EXPECT_EQ(back.tissue, native.tissue);
  EXPECT_EQ(back.fibroglandular_fraction, native.fibroglandular_fraction);
  ASSERT_EQ(native.landmarks.size(), 2u);
  ASSERT_EQ(back.landmarks.size(), 3u);
  for (std::size_t n = 0; n < 2; ++n) {
    EXPECT_EQ(back.landmarks[n].imaged, native.landmarks[n].imaged);
    EXPECT_EQ(back.landmarks[n].local, native.landmarks[n].local);
  }
  EXPECT_EQ(back.landmarks[2].name, "clip");
  EXPECT_EQ(back.landmarks[2].imaged, Vec3(14, 30, 12));
}

}  // namespace
}  // namespace breast
