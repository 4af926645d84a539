// SPDX-License-Identifier: GPL-3.0-or-later
// Damaged and foreign mesh, label and geometry files are refused in one line that names file and dataset.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>
#include <set>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "fixtures/complaint.hpp"
#include "fixtures/samples.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/derivative_file.hpp"
#include "io/geometry_file.hpp"
#include "io/hdf5/document.hpp"
#include "io/label_file.hpp"
#include "io/mesh_file.hpp"
#include "mesh/part.hpp"

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

// What readers do without: arrays for viewing and for other programs, and results that the tools which need them ask for.
bool is_optional(const std::string& path) {
  static const std::set<std::string> paths{"/VTKHDF/CellData/pressure",
                                           "/VTKHDF/CellData/det_F",
                                           "/VTKHDF/CellData/scaled_jacobian",
                                           "/VTKHDF/CellData/part",  // of a geometry
                                           "/breast/hermite/rim/border",
                                           "/breast/sets/cut_border",
                                           "/VTKHDF/PointData/displacement_from_scan",
                                           "/VTKHDF/PointData/displacement_from_stress_free",
                                           "/VTKHDF@Version",
                                           "/breast@tool",
                                           "/breast@version"};
  return paths.contains(path);
}

// What only other programs read, and nodes of which there may be none.
bool may_be_empty(const std::string& path) {
  return path == "/VTKHDF/CellData/part" || path == "/breast/hermite/rim/border" ||
         path == "/breast/sets/cut_border" || path == "/breast/sets/tumour" ||
         path == "/breast/sets/nipple" || path == "/VTKHDF@Version";
}

/// Deletes and empties every dataset and attribute of a file in turn: it is refused by its name.
void expect_every_field_checked(const std::filesystem::path& good, const std::string& schema,
                                const std::function<void(const std::filesystem::path&)>& read) {
  const std::filesystem::path bad = good.parent_path() / "bad.vtkhdf";
  const Document whole = load_document(good, schema, "a test");
  for (auto Document::*list : {&Document::datasets, &Document::attributes}) {
    for (const auto& [path, array] : whole.*list) {
      Document document = whole;
      (document.*list).erase(path);
      save_document(bad, document);
      const std::string gone = fixtures::complaint([&] { read(bad); });
      const std::string name = path.substr(path.find_last_of("/@") + 1);
      EXPECT_TRUE(gone.find(name) != std::string::npos || is_optional(path))
          << path << ": " << gone;
      if (list == &Document::attributes || array.size() == 0) continue;
      document = whole;
      Array& emptied = (document.*list).at(path);
      emptied.shape[0] = 0;
      std::visit([](auto& values) { values.clear(); }, emptied.values);
      save_document(bad, document);
      const std::string empty = fixtures::complaint([&] { read(bad); });
      EXPECT_TRUE(empty != "accepted" || may_be_empty(path)) << path << " emptied";
    }
  }
}

TEST(HdfFile, NoFieldIsUsedWithoutACheck) {
  const ScratchFolder folder;
  HexMesh mesh = samples::full_mesh();
  mesh.contact->surface_stiffness = 100;
  mesh.contact->face_rules.assign(9, 1);
  mesh.contact->friction = {{1, 0, mesh.points[1], 2, 3}, {2, 1, mesh.points[2], 2, 3}};
  const HexMesh part = restricted(mesh, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13});
  Derivatives derivatives;
  derivatives.position["fat"].assign(part.points.size(), Vec3(1, 2, 3));
  derivatives.influence["nipple"].assign(std::size_t(part.elements()), 0.5);
  HexMesh whole = part;
  whole.contact->face_rules = mesh.contact->face_rules;
  write_mesh(folder / "mesh.vtkhdf", whole, derivatives);
  expect_every_field_checked(folder / "mesh.vtkhdf", "mesh/1",
                             [](const auto& file) { read_derivatives(file, read_mesh(file)); });
  write_labels(folder / "labels.vtkhdf", samples::labels());
  expect_every_field_checked(folder / "labels.vtkhdf", "labels/1",
                             [](const auto& file) { read_labels(file); });
  write_geometry(folder / "geometry.vtkhdf", samples::geometry());
  expect_every_field_checked(folder / "geometry.vtkhdf", "geometry/1",
                             [](const auto& file) { read_geometry(file); });
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
