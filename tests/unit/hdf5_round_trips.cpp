// SPDX-License-Identifier: GPL-3.0-or-later
// Meshes, label volumes and geometries survive their files bit for bit, and writers refuse what no reader
// would take.
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
  ASSERT_EQ(a.thorax.has_value(), b.thorax.has_value());
  if (!a.thorax) return;
  EXPECT_EQ(a.thorax->origin, b.thorax->origin);
  EXPECT_EQ(a.thorax->slope, b.thorax->slope);
  EXPECT_EQ(a.thorax->angle_low, b.thorax->angle_low);
  EXPECT_EQ(a.thorax->angle_high, b.thorax->angle_high);
  EXPECT_EQ(a.thorax->height_low, b.thorax->height_low);
  EXPECT_EQ(a.thorax->height_high, b.thorax->height_high);
  EXPECT_EQ(a.thorax->angles, b.thorax->angles);
  EXPECT_EQ(a.thorax->heights, b.thorax->heights);
  EXPECT_EQ(a.thorax->coefficients, b.thorax->coefficients);
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
  EXPECT_EQ(a.model, b.model);
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
  mesh.fibroglandular_fraction.assign(8, 0);  // of elements that are all fat
  expect_same(mesh, back);
  EXPECT_EQ(back.content_sha256.size(), 64u);
}

// As of a phantom: a surface to slide on, and no sheets.
TEST(MeshFile, KeepsAWallSurfaceThatComesWithoutSheets) {
  const ScratchFolder folder;
  HexMesh mesh = samples::block(2, 1);
  mesh.tissue.assign(8, Tissue::fat);
  mesh.geometry.emplace().side = mesh.side;
  mesh.geometry->thorax = samples::geometry().thorax;
  write_mesh(folder / "mesh.vtkhdf", mesh);
  const HexMesh back = read_mesh(folder / "mesh.vtkhdf");
  ASSERT_TRUE(back.geometry && back.geometry->thorax);
  EXPECT_EQ(back.geometry->thorax->coefficients, mesh.geometry->thorax->coefficients);
  EXPECT_EQ(back.geometry->thorax->slope, mesh.geometry->thorax->slope);
  EXPECT_TRUE(back.geometry->skin.nodes.empty());
  EXPECT_THROW(read_mesh(folder / "mesh.vtkhdf", {.geometry = true}), Error);
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
  const auto refused = [&](const MeshNeeds& needs) {
    return fixtures::complaint([&] { read_mesh(folder / "mesh.vtkhdf", needs); });
  };
  EXPECT_NE(refused({true, false, false}).find("backward"), std::string::npos);
  EXPECT_NE(refused({false, true, false}).find("hexmesh"), std::string::npos);
  EXPECT_NE(refused({false, false, true}).find("compress"), std::string::npos);
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

}  // namespace
}  // namespace breast
