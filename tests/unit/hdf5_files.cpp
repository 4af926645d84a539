// Meshes, label volumes and geometries survive their files bit for bit; damaged ones are refused in
// one line that names file and dataset.
#include <gtest/gtest.h>

#include <fstream>
#include <functional>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "fixtures/samples.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/geometry_file.hpp"
#include "io/hdf5/document.hpp"
#include "io/label_file.hpp"
#include "io/mesh_file.hpp"

namespace breast {
namespace {

void expect_same(const History& a, const History& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].tool, b[i].tool);
    EXPECT_EQ(a[i].version, b[i].version);
    EXPECT_EQ(a[i].command, b[i].command);
    ASSERT_EQ(a[i].inputs.size(), b[i].inputs.size());
    for (std::size_t j = 0; j < a[i].inputs.size(); ++j) {
      EXPECT_EQ(a[i].inputs[j].name, b[i].inputs[j].name);
      EXPECT_EQ(a[i].inputs[j].sha256, b[i].inputs[j].sha256);
    }
  }
}

void expect_same(const HermiteSheet& a, const HermiteSheet& b) {
  ASSERT_EQ(a.nu, b.nu);
  ASSERT_EQ(a.nv, b.nv);
  for (std::size_t n = 0; n < a.nodes.size(); ++n) {
    EXPECT_EQ(a.nodes[n].x, b.nodes[n].x);
    EXPECT_EQ(a.nodes[n].x_1, b.nodes[n].x_1);
    EXPECT_EQ(a.nodes[n].x_2, b.nodes[n].x_2);
    EXPECT_EQ(a.nodes[n].x_12, b.nodes[n].x_12);
    EXPECT_EQ(a.nodes[n].scale_1, b.nodes[n].scale_1);
    EXPECT_EQ(a.nodes[n].scale_2, b.nodes[n].scale_2);
  }
}

void expect_same(const BreastGeometry& a, const BreastGeometry& b) {
  EXPECT_EQ(a.side, b.side);
  expect_same(a.skin, b.skin);
  expect_same(a.wall, b.wall);
  EXPECT_EQ(a.rim_skin, b.rim_skin);
  EXPECT_EQ(a.rim_wall, b.rim_wall);
  EXPECT_EQ(a.rim_end, b.rim_end);
  EXPECT_EQ(a.centre, b.centre);
  EXPECT_EQ(a.nipple_st, b.nipple_st);
  EXPECT_EQ(a.nipple, b.nipple);
  EXPECT_EQ(a.skin_thickness, b.skin_thickness);
  EXPECT_EQ(a.fit_mean_mm, b.fit_mean_mm);
  EXPECT_EQ(a.fit_p95_mm, b.fit_p95_mm);
  EXPECT_EQ(a.fit_max_mm, b.fit_max_mm);
}

std::vector<int> flat(const std::vector<Face>& faces) {
  std::vector<int> list;
  for (const Face& face : faces) list.insert(list.end(), {face.element, face.local});
  return list;
}

void expect_same(const ContactRecord& a, const ContactRecord& b) {
  EXPECT_EQ(a.view, b.view);
  EXPECT_EQ(a.angle_deg, b.angle_deg);
  EXPECT_EQ(a.thickness_mm, b.thickness_mm);
  EXPECT_EQ(a.reduction_percent, b.reduction_percent);
  EXPECT_EQ(a.initial_thickness_mm, b.initial_thickness_mm);
  EXPECT_EQ(a.standoff_mm, b.standoff_mm);
  EXPECT_EQ(a.path_thickness_mm, b.path_thickness_mm);
  EXPECT_EQ(a.path_force_N, b.path_force_N);
  EXPECT_EQ(a.path_detector_N, b.path_detector_N);
  ASSERT_EQ(a.plates.size(), b.plates.size());
  for (std::size_t p = 0; p < a.plates.size(); ++p) {
    EXPECT_EQ(a.plates[p].name, b.plates[p].name);
    EXPECT_EQ(a.plates[p].normal, b.plates[p].normal);
    EXPECT_EQ(a.plates[p].anterior, b.plates[p].anterior);
    EXPECT_EQ(a.plates[p].origin, b.plates[p].origin);
    EXPECT_EQ(a.plates[p].edge_radius, b.plates[p].edge_radius);
    EXPECT_EQ(a.plates[p].force_N, b.plates[p].force_N);
    EXPECT_EQ(a.plates[p].area_cm2, b.plates[p].area_cm2);
    EXPECT_EQ(a.plates[p].mean_kPa, b.plates[p].mean_kPa);
    EXPECT_EQ(a.plates[p].peak_kPa, b.plates[p].peak_kPa);
    EXPECT_EQ(a.plates[p].worst_gap_mm, b.plates[p].worst_gap_mm);
  }
}

void expect_same(const SolveRecord& a, const SolveRecord& b) {
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.reason, b.reason);
  ASSERT_EQ(a.iterations.size(), b.iterations.size());
  for (std::size_t i = 0; i < a.iterations.size(); ++i) {
    EXPECT_EQ(a.iterations[i].step, b.iterations[i].step);
    EXPECT_EQ(a.iterations[i].iteration, b.iterations[i].iteration);
    EXPECT_EQ(a.iterations[i].residual, b.iterations[i].residual);
    EXPECT_EQ(a.iterations[i].min_det_F, b.iterations[i].min_det_F);
    EXPECT_EQ(a.iterations[i].max_det_F, b.iterations[i].max_det_F);
    EXPECT_EQ(a.iterations[i].step_length, b.iterations[i].step_length);
    EXPECT_EQ(a.iterations[i].seconds, b.iterations[i].seconds);
  }
}

void expect_same(const HexMesh& a, const HexMesh& b) {
  EXPECT_EQ(a.order, b.order);
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.imaged, b.imaged);
  EXPECT_EQ(a.reference, b.reference);
  EXPECT_EQ(a.connectivity, b.connectivity);
  EXPECT_EQ(a.tissue, b.tissue);
  EXPECT_EQ(a.fibroglandular_fraction, b.fibroglandular_fraction);
  EXPECT_EQ(a.pressure, b.pressure);
  EXPECT_EQ(a.det_F, b.det_F);
  EXPECT_EQ(a.scaled_jacobian, b.scaled_jacobian);
  EXPECT_EQ(a.contact_pressure, b.contact_pressure);
  EXPECT_EQ(flat(a.skin_faces), flat(b.skin_faces));
  EXPECT_EQ(flat(a.pectoral_faces), flat(b.pectoral_faces));
  EXPECT_EQ(flat(a.cut_faces), flat(b.cut_faces));
  EXPECT_EQ(a.tumour_node, b.tumour_node);
  EXPECT_EQ(a.nipple_node, b.nipple_node);
  EXPECT_EQ(a.skin_model, b.skin_model);
  EXPECT_EQ(a.skin_thickness, b.skin_thickness);
  EXPECT_EQ(a.side, b.side);
  EXPECT_EQ(a.template_name, b.template_name);
  EXPECT_EQ(a.template_size, b.template_size);
  EXPECT_EQ(a.gravity, b.gravity);
  EXPECT_EQ(a.wall_seconds, b.wall_seconds);
  expect_same(a.history, b.history);
  ASSERT_EQ(a.landmarks.size(), b.landmarks.size());
  for (std::size_t i = 0; i < a.landmarks.size(); ++i) {
    EXPECT_EQ(a.landmarks[i].name, b.landmarks[i].name);
    EXPECT_EQ(a.landmarks[i].imaged, b.landmarks[i].imaged);
    EXPECT_EQ(a.landmarks[i].element, b.landmarks[i].element);
    EXPECT_EQ(a.landmarks[i].local, b.landmarks[i].local);
    EXPECT_EQ(a.landmarks[i].moved, b.landmarks[i].moved);
  }
  ASSERT_EQ(a.geometry.has_value(), b.geometry.has_value());
  if (a.geometry) {
    expect_same(*a.geometry, *b.geometry);
    EXPECT_EQ(a.geometry->content_sha256, b.geometry->content_sha256);
  }
  ASSERT_EQ(a.solve.has_value(), b.solve.has_value());
  if (a.solve) expect_same(*a.solve, *b.solve);
  ASSERT_EQ(a.contact.has_value(), b.contact.has_value());
  if (a.contact) expect_same(*a.contact, *b.contact);
}

TEST(MeshFile, RoundTripsEveryField) {
  const ScratchFolder folder;
  for (const int order : {1, 2}) {
    const HexMesh mesh = samples::full_mesh(3, order);
    write_mesh(folder / "mesh.vtkhdf", mesh);
    expect_same(mesh, read_mesh(folder / "mesh.vtkhdf", {true, true, true}));
  }
}

TEST(MeshFile, RoundTripsTheBareMinimum) {
  const ScratchFolder folder;
  HexMesh mesh = samples::block(2, 1);
  mesh.tissue.assign(8, Tissue::fat);
  write_mesh(folder / "mesh.vtkhdf", mesh);
  const HexMesh back = read_mesh(folder / "mesh.vtkhdf");
  expect_same(mesh, back);
  EXPECT_EQ(back.content_sha256.size(), 64u);
}

TEST(LabelFile, RoundTrips) {
  const ScratchFolder folder;
  const LabelVolume a = samples::labels();
  write_labels(folder / "labels.vtkhdf", a);
  const LabelVolume b = read_labels(folder / "labels.vtkhdf");
  EXPECT_EQ(a.grid.size, b.grid.size);
  EXPECT_EQ(a.grid.spacing, b.grid.spacing);
  EXPECT_EQ(a.grid.origin, b.grid.origin);
  EXPECT_EQ(a.grid.direction, b.grid.direction);
  EXPECT_EQ(a.tissue, b.tissue);
  EXPECT_EQ(a.fibroglandular_fraction, b.fibroglandular_fraction);
  EXPECT_EQ(a.chest_wall_confidence, b.chest_wall_confidence);
  EXPECT_EQ(a.side, b.side);
  EXPECT_EQ(a.landmarks, b.landmarks);
  EXPECT_EQ(a.skin_thickness, b.skin_thickness);
  expect_same(a.history, b.history);
}

TEST(GeometryFile, RoundTrips) {
  const ScratchFolder folder;
  const BreastGeometry a = samples::geometry();
  write_geometry(folder / "geometry.vtkhdf", a);
  const BreastGeometry b = read_geometry(folder / "geometry.vtkhdf");
  expect_same(a, b);
  expect_same(a.history, b.history);
}

TEST(MeshFile, SameMeshGivesTheSameBytes) {
  const ScratchFolder folder;
  write_mesh(folder / "a.vtkhdf", samples::full_mesh());
  write_mesh(folder / "b.vtkhdf", samples::full_mesh());
  EXPECT_EQ(read_text(folder / "a.vtkhdf"), read_text(folder / "b.vtkhdf"));
}

TEST(MeshFile, ContentHashIgnoresHistoryAndClocksOnly) {
  const ScratchFolder folder;
  const auto hash = [&](const HexMesh& mesh) {
    write_mesh(folder / "m.vtkhdf", mesh);
    return read_mesh(folder / "m.vtkhdf").content_sha256;
  };
  const HexMesh mesh = samples::full_mesh();
  const std::string plain = hash(mesh);
  HexMesh other = mesh;
  other.history.pop_back();
  other.wall_seconds = 99;
  other.solve->iterations[0].seconds = 99;
  EXPECT_EQ(hash(other), plain);
  other = mesh;
  other.points[7].y() = std::nextafter(other.points[7].y(), 1e9);
  EXPECT_NE(hash(other), plain);
  other = mesh;
  other.gravity = -other.gravity;
  EXPECT_NE(hash(other), plain);
}

TEST(MeshFile, NeedsAreRefusedByTheToolThatMakesThem) {
  const ScratchFolder folder;
  HexMesh mesh = samples::block(2, 1);
  mesh.tissue.assign(8, Tissue::fat);
  write_mesh(folder / "mesh.vtkhdf", mesh);
  const auto complaint = [&](const MeshNeeds& needs) {
    try {
      read_mesh(folder / "mesh.vtkhdf", needs);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(complaint({true, false, false}).find("backward"), std::string::npos);
  EXPECT_NE(complaint({false, true, false}).find("hexmesh"), std::string::npos);
  EXPECT_NE(complaint({false, false, true}).find("compress"), std::string::npos);
}

TEST(MeshFile, WriterRefusesWhatNoReaderWouldTake) {
  const ScratchFolder folder;
  HexMesh mesh = samples::full_mesh();
  mesh.points[3].z() = std::nan("");
  EXPECT_THROW(write_mesh(folder / "mesh.vtkhdf", mesh), Error);
  mesh = samples::full_mesh();
  mesh.skin_faces.pop_back();
  EXPECT_THROW(write_mesh(folder / "mesh.vtkhdf", mesh), Error);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

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
    try {
      read_mesh(folder / "file.vtkhdf");
    } catch (const Error& error) {
      EXPECT_EQ(error.exit_code(), 2);
      return std::string(error.what());
    }
    return std::string("accepted");
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
