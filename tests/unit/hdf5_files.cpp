// SPDX-License-Identifier: GPL-3.0-or-later
// Damaged and foreign mesh, label and geometry files are refused in one line that names file and dataset.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "fixtures/complaint.hpp"
#include "fixtures/samples.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/geometry_file.hpp"
#include "io/hdf5/document.hpp"
#include "io/label_file.hpp"
#include "io/mesh_file.hpp"

namespace breast {
namespace {

// One edit of a good document and what the refusal must name.
struct Damage {
  const char* name;
  std::function<void(Document&)> edit;
  std::vector<std::string> must_name;
};

template <class T>
T& value(Document& document, const std::string& path, std::size_t index) {
  return std::get<std::vector<T>>(document.datasets.at(path).values).at(index);
}

class MeshDamage : public testing::TestWithParam<Damage> {};

TEST_P(MeshDamage, IsRefusedInOneLine) {
  const ScratchFolder folder;
  write_mesh(folder / "good.vtkhdf", samples::full_mesh());
  Document document = load_document(folder / "good.vtkhdf", "mesh/1", "hexmesh");
  GetParam().edit(document);
  save_document(folder / "bad.vtkhdf", document);
  try {
    read_mesh(folder / "bad.vtkhdf");
    FAIL() << "accepted";
  } catch (const Error& error) {
    const std::string text = error.what();
    EXPECT_EQ(error.exit_code(), 2);
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_NE(text.find("bad.vtkhdf"), std::string::npos) << text;
    for (const std::string& part : GetParam().must_name) {
      EXPECT_NE(text.find(part), std::string::npos) << text << " lacks " << part;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, MeshDamage,
    testing::Values(
        Damage{"schema",
               [](Document& d) { d.attributes["/breast@schema"].values = Texts{"mesh/9"}; },
               {"mesh/9", "mesh/1"}},
        Damage{"no_schema", [](Document& d) { d.attributes.erase("/breast@schema"); }, {"schema"}},
        Damage{"units",
               [](Document& d) { d.attributes["/breast@units"].values = Texts{"m-kg-s"}; },
               {"m-kg-s"}},
        Damage{"side",
               [](Document& d) { d.attributes["/breast@side"].values = Texts{"both"}; },
               {"both"}},
        Damage{"no_imaged",
               [](Document& d) { d.datasets.erase("/VTKHDF/PointData/imaged"); },
               {"/VTKHDF/PointData/imaged"}},
        Damage{"shape",
               [](Document& d) {
                 d.datasets["/VTKHDF/Points"].shape = {3, 64};
               },
               {"/VTKHDF/Points", "(3,64)"}},
        Damage{"type",
               [](Document& d) {
                 auto& a = d.datasets["/VTKHDF/Points"];
                 a.values = Integers(a.size(), 1);
               },
               {"/VTKHDF/Points"}},
        Damage{"node_range",
               [](Document& d) { value<std::int64_t>(d, "/VTKHDF/Connectivity", 9) = 64; },
               {"/VTKHDF/Connectivity[9]", "64", "63"}},
        Damage{"node_negative",
               [](Document& d) { value<std::int64_t>(d, "/VTKHDF/Connectivity", 9) = -1; },
               {"/VTKHDF/Connectivity[9]", "-1"}},
        Damage{"node_twice",
               [](Document& d) {
                 value<std::int64_t>(d, "/VTKHDF/Connectivity", 9) =
                     value<std::int64_t>(d, "/VTKHDF/Connectivity", 8);
               },
               {"element 1", "twice"}},
        Damage{"offsets",
               [](Document& d) { value<std::int64_t>(d, "/VTKHDF/Offsets", 4) = 30; },
               {"/VTKHDF/Offsets"}},
        Damage{"types",
               [](Document& d) { value<std::uint8_t>(d, "/VTKHDF/Types", 4) = 29; },
               {"/VTKHDF/Types[4]", "29"}},
        Damage{"foreign_type",
               [](Document& d) { value<std::uint8_t>(d, "/VTKHDF/Types", 0) = 10; },
               {"/VTKHDF/Types[0]", "10"}},
        Damage{"tissue",
               [](Document& d) { value<std::uint8_t>(d, "/VTKHDF/CellData/tissue", 2) = 7; },
               {"/VTKHDF/CellData/tissue[2]", "7", "0 to 6"}},
        Damage{"fraction",
               [](Document& d) {
                 value<float>(d, "/VTKHDF/CellData/fibroglandular_fraction", 2) = 1.5f;
               },
               {"fibroglandular_fraction[2]", "1.5"}},
        Damage{"displacement_from_stress_free",
               [](Document& d) {
                 value<double>(d, "/VTKHDF/PointData/displacement_from_stress_free", 4) += 1e-3;
               },
               {"displacement_from_stress_free[1]", "Points - reference"}},
        Damage{"displacement_from_scan",
               [](Document& d) {
                 value<double>(d, "/VTKHDF/PointData/displacement_from_scan", 4) += 1e-3;
               },
               {"displacement_from_scan[1]", "Points - imaged"}},
        Damage{"faces_twice",
               [](Document& d) {
                 for (const std::size_t c : {0, 1}) {
                   value<std::int64_t>(d, "/breast/sets/cut_faces", c) =
                       value<std::int64_t>(d, "/breast/sets/skin_faces", c);
                 }
               },
               {"/breast/sets/cut_faces[0]", "disjoint"}},
        Damage{"faces_inside",
               [](Document& d) {
                 value<std::int64_t>(d, "/breast/sets/cut_faces", 0) = 13;  // the middle element
               },
               {"cover"}},
        Damage{"face_local",
               [](Document& d) { value<std::int64_t>(d, "/breast/sets/cut_faces", 1) = 6; },
               {"/breast/sets/cut_faces[0]"}},
        Damage{"face_element",
               [](Document& d) { value<std::int64_t>(d, "/breast/sets/cut_faces", 0) = 27; },
               {"/breast/sets/cut_faces[0,0]", "27"}},
        Damage{"node_set",
               [](Document& d) { value<std::int64_t>(d, "/breast/sets/skin_nodes", 0) += 1; },
               {"skin_nodes"}},
        Damage{"landmark_element",
               [](Document& d) { value<std::int64_t>(d, "/breast/landmarks/element", 1) = 27; },
               {"/breast/landmarks/element[1]", "27"}},
        Damage{"landmark_local",
               [](Document& d) { value<double>(d, "/breast/landmarks/local", 0) = 1.5; },
               {"/breast/landmarks/local[0]"}},
        Damage{"landmark_name",
               [](Document& d) { value<std::string>(d, "/breast/landmarks/name", 1) = "nipple"; },
               {"nipple"}},
        Damage{"thickness",
               [](Document& d) { value<double>(d, "/breast/skin/thickness", 2) = -1; },
               {"/breast/skin/thickness[2]", "-1"}},
        Damage{"view",
               [](Document& d) { d.attributes["/breast/contact@view"].values = Texts{"LM"}; },
               {"/breast/contact@view", "LM", "MLO"}},
        Damage{"skin_model",
               [](Document& d) { d.attributes["/breast/skin@model"].values = Texts{"fur"}; },
               {"fur"}},
        Damage{"rim",
               [](Document& d) { value<double>(d, "/breast/hermite/rim/skin", 3) = 1.25; },
               {"/breast/hermite/rim/skin[1,1]", "1.25"}},
        Damage{"rim_end",
               [](Document& d) { value<std::uint8_t>(d, "/breast/hermite/rim/end", 3) = 3; },
               {"/breast/hermite/rim/end[3]", "3"}},
        Damage{
            "patches",
            [](Document& d) {
              d.attributes["/breast/hermite/skin@patches"].values = Integers{4, 1'000'000'000'000};
            },
            {"patches", "1000000000000"}},
        Damage{"history",
               [](Document& d) { value<std::int64_t>(d, "/breast/history/input_entry", 0) = 9; },
               {"/breast/history/input_entry[0]", "9"}},
        Damage{"gravity", [](Document& d) { d.attributes.erase("/breast@gravity"); }, {"gravity"}},
        Damage{"template",
               [](Document& d) {
                 d.attributes["/breast/template@size"].values = Integers{1, 2, -3, 4};
               },
               {"size[2]", "-3"}}),
    [](const auto& damage) { return damage.param.name; });

// Version 0.1 wrote one displacement, from the stress-free shape, without saying from where.
TEST(MeshFile, TheOldNameOfTheDisplacementIsStillRead) {
  const ScratchFolder folder;
  const HexMesh mesh = samples::full_mesh();
  write_mesh(folder / "new.vtkhdf", mesh);
  Document document = load_document(folder / "new.vtkhdf", "mesh/1", "hexmesh");
  const std::string at = "/VTKHDF/PointData/displacement";
  EXPECT_FALSE(document.datasets.contains(at));
  document.datasets.erase(at + "_from_scan");
  auto old = document.datasets.extract(at + "_from_stress_free");
  ASSERT_FALSE(old.empty());
  old.key() = at;
  document.datasets.insert(std::move(old));
  save_document(folder / "old.vtkhdf", document);
  EXPECT_EQ(read_mesh(folder / "old.vtkhdf").reference, mesh.reference);
  value<double>(document, at, 4) += 1e-3;  // still checked
  save_document(folder / "old.vtkhdf", document);
  EXPECT_THROW(read_mesh(folder / "old.vtkhdf"), Error);
}

TEST(HdfFile, ForeignAndTruncatedFilesAreRefused) {
  const ScratchFolder folder;
  const auto complaint = [&](const std::string& content) {
    std::ofstream(folder / "file.vtkhdf", std::ios::binary) << content;
    return fixtures::complaint([&] { read_mesh(folder / "file.vtkhdf"); });
  };
  EXPECT_NE(complaint("").find("not an HDF5 file"), std::string::npos);
  EXPECT_NE(complaint("hello, world").find("not an HDF5 file"), std::string::npos);
  write_mesh(folder / "good.vtkhdf", samples::full_mesh());
  const std::string good = read_text(folder / "good.vtkhdf");
  EXPECT_EQ(complaint(good), "accepted");
  for (const std::size_t size :
       {good.size() - 1, good.size() - 79, good.size() / 2, std::size_t(100), std::size_t(9)}) {
    const std::string text = complaint(good.substr(0, size));
    EXPECT_TRUE(text.find("truncated") != std::string::npos ||
                text.find("damaged") != std::string::npos)
        << text;
  }
  std::string flipped = good;
  flipped[good.size() / 3] = char(flipped[good.size() / 3] ^ 4);
  EXPECT_NE(complaint(flipped).find("damaged"), std::string::npos);
  EXPECT_THROW(read_mesh(folder / "absent.vtkhdf"), Error);
  EXPECT_THROW(read_mesh(folder.path()), Error);
}

TEST(HdfFile, AnotherKindOfFileIsRefusedBySchema) {
  const ScratchFolder folder;
  write_geometry(folder / "geometry.vtkhdf", samples::geometry());
  write_labels(folder / "labels.vtkhdf", samples::labels());
  for (const char* name : {"geometry.vtkhdf", "labels.vtkhdf"}) {
    try {
      read_mesh(folder / name);
      FAIL() << name;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("must be 'mesh/1'"), std::string::npos)
          << error.what();
    }
  }
}

TEST(LabelFile, RefusesBadVoxelsAndGrids) {
  const ScratchFolder folder;
  LabelVolume labels = samples::labels();
  labels.tissue[13] = 9;
  EXPECT_THROW(write_labels(folder / "l.vtkhdf", labels), Error);
  labels = samples::labels();
  write_labels(folder / "good.vtkhdf", labels);
  const auto refused = [&](const std::function<void(Document&)>& edit, const std::string& part) {
    Document document = load_document(folder / "good.vtkhdf", "labels/1", "segment");
    edit(document);
    save_document(folder / "bad.vtkhdf", document);
    try {
      read_labels(folder / "bad.vtkhdf");
      ADD_FAILURE() << "accepted, expected " << part;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  refused([](Document& d) { value<std::uint8_t>(d, "/VTKHDF/PointData/tissue", 13) = 9; },
          "tissue[0,1,1] is 9");
  refused([](Document& d) { value<float>(d, "/VTKHDF/PointData/chest_wall_confidence", 1) = -1; },
          "chest_wall_confidence[0,0,1] is -1");
  refused(
      [](Document& d) {
        d.attributes["/VTKHDF@Spacing"].values = Doubles{1, 0, 1};
      },
      "Spacing[1]");
  refused([](Document& d) { d.attributes["/VTKHDF@Direction"].values = Doubles(9, 0.5); },
          "Direction");
  refused(
      [](Document& d) {
        d.attributes["/VTKHDF@WholeExtent"].values = Integers{0, 1LL << 62, 0, 1LL << 62, 0, 3};
      },
      "WholeExtent");
  refused(
      [](Document& d) { d.attributes["/VTKHDF@WholeExtent"].values = Integers{0, 12, 0, 9, 0, 7}; },
      "/VTKHDF/PointData/tissue");
}

}  // namespace
}  // namespace breast
