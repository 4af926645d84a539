// SPDX-License-Identifier: GPL-3.0-or-later
// X-rays through meshes with known chords: blocks exactly, balls to the order of the
// elements, volumes to the pixel rule; labels through the element map; the same image
// for any number of threads.
#include "projection/projection.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fixtures/analytic_breast.hpp"
#include "fixtures/block.hpp"
#include "fixtures/squashed.hpp"
#include "fixtures/traced.hpp"
#include "meshing/body_mesh.hpp"
#include "projection/ray_mesh.hpp"
#include "projection/report.hpp"

using namespace breast;
using namespace breast::fixtures;

namespace {

// Block with its wall at the back (y largest), as a breast has it: x → −y.
HexMesh facing_block(double distortion = 0, int order = 1) {
  BlockSettings settings;
  settings.elements = {4, 5, 3};
  settings.size = {60, 80, 40};
  settings.distortion = distortion;
  settings.order = order;
  HexMesh mesh = block(settings);
  for (auto* field : {&mesh.points, &mesh.imaged, &mesh.reference}) {
    for (Vec3& x : *field) x = Vec3(x.y(), -x.x(), x.z());
  }
  return mesh;
}

HexMesh ball(int n, double radius, int order) {
  BlockSettings settings;
  settings.elements = {n, n, n};
  settings.size = {2, 2, 2};
  settings.order = order;
  HexMesh mesh = block(settings);
  for (Vec3& x : mesh.imaged) x = radius * ball_from_cube(x - Vec3::Ones());
  mesh.points = mesh.reference = mesh.imaged;
  mesh.skin_faces = boundary_faces(mesh);
  mesh.pectoral_faces.clear();
  return mesh;
}

const HexMesh& breast_mesh() {
  static const HexMesh mesh = body_mesh(analytic_breast(), {.size = dome_near(10)});
  return mesh;
}

LabelVolume labels_around(const HexMesh& mesh, const std::function<Tissue(const Vec3&)>& tissue) {
  Vec3 low = mesh.imaged[0], high = low;
  for (const Vec3& x : mesh.imaged) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  LabelVolume labels;
  labels.grid.spacing = Vec3(1, 1, 2);
  labels.grid.origin = low - Vec3::Constant(3);
  for (int k = 0; k < 3; ++k) {
    labels.grid.size[k] = int((high - low)[k] / labels.grid.spacing[k]) + 8;
  }
  labels.tissue.resize(labels.grid.voxels());
  labels.fibroglandular_fraction.resize(labels.grid.voxels());
  labels.chest_wall_confidence.resize(labels.grid.voxels());
  for (int k = 0; k < labels.grid.size[2]; ++k) {
    for (int j = 0; j < labels.grid.size[1]; ++j) {
      for (int i = 0; i < labels.grid.size[0]; ++i) {
        const Tissue t = tissue(labels.grid.to_patient(Vec3(i, j, k)));
        labels.tissue[labels.grid.offset(i, j, k)] = std::uint8_t(t);
        labels.fibroglandular_fraction[labels.grid.offset(i, j, k)] =
            t == Tissue::fibroglandular ? 1.0f : 0.0f;
      }
    }
  }
  return labels;
}

}  // namespace

TEST(Trilinear, InvertsItselfAndKnowsItsVolume) {
  const HexMesh mesh = facing_block(0.3);
  const RayMesh rays(mesh, mesh.points, view_pose(Side::left, 0));
  for (int p = 0; p < rays.pieces(); p += 7) {
    const Vec3 local(0.3, -0.8, 0.95);
    Vec3 found = Vec3::Zero();
    ASSERT_TRUE(rays.piece(p).invert(rays.piece(p).at(local), 1e-12, found));
    EXPECT_LT((found - local).norm(), 1e-10);
  }
  EXPECT_NEAR(rays.volume(), 60 * 80 * 40, 1e-6);
}

TEST(RayMesh, BlockChordsAreExactInEveryDirection) {
  const HexMesh mesh = facing_block(0.35);
  for (const double angle : {0.0, 45.0, 90.0, 17.0}) {
    const ViewPose pose = view_pose(Side::left, angle);
    const RayMesh rays(mesh, mesh.points, pose);
    // The expected chord of the box [0,80] × [-60,0] × [0,40].
    const Vec3 low(0, -60, 0), high(80, 0, 40);
    for (double u = 2.5; u < 60; u += 5) {
      for (double v = -95.3; v < 95; v += 3.1) {
        const Vec3 x = pose.on_detector({u, v});
        double enter = -1e9, leave = 1e9;
        for (int k = 0; k < 3; ++k) {
          if (std::abs(pose.n[k]) < 1e-12) {
            if (x[k] <= low[k] || x[k] >= high[k]) leave = enter;
            continue;
          }
          const double a = (low[k] - x[k]) / pose.n[k], b = (high[k] - x[k]) / pose.n[k];
          enter = std::max(enter, std::min(a, b));
          leave = std::min(leave, std::max(a, b));
        }
        EXPECT_NEAR(traced(rays, {u, v}), std::max(0.0, leave - enter), 1e-5)
            << angle << " " << u << " " << v;
      }
    }
  }
}

TEST(RayMesh, RaysInTheFacesOfAnAlignedMeshAreCountedOnce) {
  const HexMesh mesh = facing_block();
  const RayMesh rays(mesh, mesh.points, view_pose(Side::left, 0));
  for (const double u : {0.0, 15.0, 30.0, 45.0}) {
    for (const double v : {-64.0, -48.0, -32.0, -16.0}) {
      EXPECT_NEAR(traced(rays, {u, v}), 40, 1e-9);
    }
  }
}

TEST(RayMesh, ChordsFollowEachOtherWithoutGapOrOverlap) {
  const HexMesh& mesh = breast_mesh();
  const ViewPose pose = view_pose(mesh.side, 45);
  const RayMesh rays(mesh, mesh.points, pose);
  std::vector<Chord> chords;
  int joints = 0;
  for (double u = -60; u < 60; u += 3.7) {
    for (double v = -60; v < 60; v += 4.1) {
      rays.trace({u, v}, chords);
      for (std::size_t c = 1; c < chords.size(); ++c) {
        const double gap = chords[c].enter - chords[c - 1].leave;
        EXPECT_GT(gap, -1e-7);
        joints += std::abs(gap) < 1e-7;
      }
    }
  }
  EXPECT_GT(joints, 1000);
}

TEST(RayMesh, APacketOfRaysIsTheRaysOneByOne) {
  const HexMesh& mesh = breast_mesh();
  ViewPose pose = view_pose(mesh.side, 45);
  for (const double distance : {0.0, 650.0}) {
    pose.source_distance = distance;
    const RayMesh rays(mesh, mesh.points, pose);
    ChordPacket packet;
    std::vector<Chord> single;
    const double step = 0.31;
    int compared = 0, shortened = 0;
    for (double v = -60; v < 60; v += 2.3) {
      for (int i = 0; i < 400;) {
        const int count = rays.trace({-60 + i * step, v}, step, packet_rays, packet);
        ASSERT_GE(count, 1);
        shortened += count < packet_rays;
        for (int k = 0; k < count; ++k, ++i) {
          rays.trace({-60 + i * step, v}, single);
          ASSERT_EQ(packet[k].size(), single.size()) << i << " " << v;
          for (std::size_t c = 0; c < single.size(); ++c, ++compared) {
            EXPECT_EQ(packet[k][c].piece, single[c].piece);
            EXPECT_NEAR(packet[k][c].enter, single[c].enter, 1e-9);
            EXPECT_NEAR(packet[k][c].leave, single[c].leave, 1e-9);
            EXPECT_LT((packet[k][c].local_leave - single[c].local_leave).norm(), 1e-9);
          }
        }
      }
    }
    EXPECT_GT(compared, 10000);
    EXPECT_GT(shortened, 100);
  }
}

TEST(RayMesh, BallChordsApproachTheSphere) {
  const double radius = 50;
  double worst[2] = {0, 0};
  for (const int order : {1, 2}) {
    const HexMesh mesh = ball(order == 1 ? 16 : 8, radius, order);
    const RayMesh rays(mesh, mesh.points, view_pose(Side::left, 30));
    for (double u = -40; u <= 40; u += 4.3) {
      for (double v = -25; v <= 25; v += 3.9) {
        const double exact = 2 * std::sqrt(radius * radius - u * u - v * v);
        worst[order - 1] = std::max(worst[order - 1], std::abs(traced(rays, {u, v}) - exact));
      }
    }
  }
  EXPECT_LT(worst[0], 0.8);  // facets of 16³ elements
  EXPECT_LT(worst[1], 0.2);  // pieces of 8³ quadratic elements
}

TEST(Projection, ThicknessTimesAreaIsTheVolume) {
  HexMesh mesh = ball(8, 50, 1);
  add_contact(mesh, View::cc);
  ProjectionReport report;
  project_mammogram(mesh, {.pixel = 0.5}, &report);
  EXPECT_NEAR(report.imaged_volume / report.mesh_volume, 1, 1e-4);
  // A breast: with what lies behind the posterior edge, the whole is the whole.
  const HexMesh cc = squashed(breast_mesh(), View::cc, 0.6);
  const ImageFrame frame = image_frame(cc);
  const RayMesh rays(cc, cc.points, frame.pose);
  double sum = 0;
  for (double u = -120.25; u < 120; u += 0.5) {
    for (double v = -20.25; v < 260; v += 0.5) sum += 0.25 * traced(rays, {u, v});
  }
  EXPECT_NEAR(sum / rays.volume(), 1, 1e-3);
}

TEST(Projection, ConeMagnifiesByDistance) {
  HexMesh mesh = facing_block();
  add_contact(mesh, View::cc);
  const ImageFrame frame = image_frame(mesh, Beam::cone);
  // The anterior upper edge lies 40 mm above the detector.
  const Vec2 edge = frame.pose.project(Vec3(40, -60, 40));
  EXPECT_NEAR(edge.x(), 60 * 650.0 / (650 - 40), 1e-9);
  const RayMesh rays(mesh, mesh.points, frame.pose);
  const Ray ray = rays.ray({30, frame.pose.source_v});
  EXPECT_NEAR(traced(rays, {30, frame.pose.source_v}), 40 / std::abs(ray.direction.z()), 1e-5);
  // What the projection says and where the ray goes agree.
  const Vec3 inside(33, -41, 17);
  const Ray through = rays.ray(frame.pose.project(inside));
  const Vec3 off = inside - through.origin;
  EXPECT_LT((off - off.dot(through.direction) * through.direction).norm(), 1e-6);
}

TEST(Projection, NoColumnOfTheImageLeavesThroughTheBack) {
  for (const View view : {View::cc, View::mlo, View::ml}) {
    const HexMesh mesh = squashed(breast_mesh(), view, 0.6);
    ProjectionReport report;
    const Mammogram image = project_mammogram(mesh, {.pixel = 1}, &report);
    EXPECT_EQ(report.back_columns, 0) << view_name(view);
    EXPECT_EQ(image.thickness[std::size_t(image.width) - 1], 0) << view_name(view);  // air in front
    EXPECT_GT(*std::max_element(image.thickness.begin(), image.thickness.end()), 20)
        << view_name(view);
  }
}

// The block's hindmost 15 mm are muscle, and its lower faces there belong to the cut. With `thicker_front` the block is 60 mm thick
// in front of the muscle, which is 40 mm thick 7 mm behind its posterior edge.
HexMesh block_cut_below(bool thicker_front) {
  HexMesh mesh = facing_block();
  if (thicker_front) {
    for (auto* field : {&mesh.points, &mesh.imaged, &mesh.reference})
      for (Vec3& x : *field) x.z() *= x.y() > -1e-9 ? 22.5 / 40 : 1.5;
  }
  add_contact(mesh, View::cc);
  mesh.contact->thickness_mm = 50;
  mesh.contact->ends_image = true;
  mesh.skin_faces.clear(), mesh.cut_faces.clear(), mesh.pectoral_faces.clear();
  for (const Face& face : boundary_faces(mesh)) {
    double height = 0;
    for (const int node : face_nodes(mesh, face)) height = std::max(height, mesh.points[node].z());
    const bool below =
        height < 1e-9 && element_position(mesh, mesh.points, face.element, Vec3::Zero()).y() > -15;
    (below ? mesh.cut_faces : mesh.skin_faces).push_back(face);
  }
  for (int e = 0; e < mesh.elements(); ++e) {
    if (element_position(mesh, mesh.points, e, Vec3::Zero()).y() > -15)
      mesh.tissue[std::size_t(e)] = Tissue::muscle;
  }
  return mesh;
}

std::size_t pixel_at(const Mammogram& image, double u) {
  return std::size_t(image.height / 2) * std::size_t(image.width) + std::size_t(u / image.pixel);
}

// Between plates 50 mm apart what lacks of those columns is muscle, of which the mesh has but a layer.
TEST(Projection, MuscleIsShownAndColumnsGoOnBeyondTheCut) {
  ProjectionReport report;
  const Mammogram image = project_mammogram(block_cut_below(true), {.pixel = 0.5}, &report);
  const std::size_t muscle = pixel_at(image, 7), breast = pixel_at(image, 30);
  EXPECT_EQ(image.through_back[muscle], 1);
  EXPECT_FALSE(image.blank(muscle));
  EXPECT_NEAR(image.thickness[muscle], 50, 1e-4);
  EXPECT_NEAR(image.path[muscle], 50, 1e-4);
  EXPECT_NEAR(image.fibroglandular[muscle], 0, 1e-6);
  EXPECT_EQ(image.through_back[breast], 0);
  EXPECT_NEAR(image.thickness[breast], 60, 1e-4);
  EXPECT_NEAR(report.muscle_columns * 0.25, 15 * 80, 0.05 * 15 * 80);
  EXPECT_EQ(report.volumes.muscle, 0);  // of columns that go on beyond the mesh nothing is summed
}

// What is said of the tissue in the image is said of the columns that are summed: what lies in the others does not count.
TEST(Projection, ForeignLabelsBehindTheImageAreNotCounted) {
  HexMesh mesh = block_cut_below(true);
  std::fill(mesh.tissue.begin(), mesh.tissue.end(), Tissue::fat);
  const auto share = [&](double from) {
    const LabelVolume labels = labels_around(
        mesh, [&](const Vec3& x) { return x.y() > from ? Tissue::other : Tissue::fat; });
    ProjectionReport report;
    project_mammogram(mesh, {.pixel = 1, .labels = &labels}, &report);
    EXPECT_GT(report.back_columns, 1000);
    return report.unlabelled;
  };
  EXPECT_EQ(share(-8), 0);
  EXPECT_NEAR(share(-37.5), 0.5, 0.05);  // half of the 45 mm in front of the cut
  EXPECT_NEAR(share(-200), 1, 1e-6);
}

// Where the breast in front does not reach both plates, its continuation does not either: no step at the end of the model.
TEST(Projection, BeyondTheCutTheBodyIsAsThickAsInFrontOfIt) {
  const Mammogram image = project_mammogram(block_cut_below(false), {.pixel = 0.5});
  const std::size_t muscle = pixel_at(image, 7), breast = pixel_at(image, 30);
  EXPECT_EQ(image.through_back[muscle], 1);
  EXPECT_NEAR(image.thickness[breast], 40, 1e-4);
  EXPECT_NEAR(image.thickness[muscle], 40, 1e-4);
  EXPECT_NEAR(image.path[muscle], 40, 1e-4);
}

// A column behind the body that misses the mesh is not air: at the height of breast in front of it there is always body behind it.
TEST(Projection, ColumnsThatMissTheMeshBehindTheBodyAreFilled) {
  HexMesh mesh = block_cut_below(true);
  for (auto* field : {&mesh.points, &mesh.imaged, &mesh.reference})
    for (Vec3& x : *field)
      if (x.y() > -1e-9 && x.x() > 41) x.y() -= 6;  // the back recedes at one side
  const Mammogram image = project_mammogram(mesh, {.pixel = 0.5});
  int filled = 0, air = 0;
  for (int v = 0; v < image.height; ++v) {
    const std::size_t row = std::size_t(v) * std::size_t(image.width);
    for (std::size_t u = 0; u < 6; ++u) {
      if (!(image.thickness[row + pixel_at(image, 30) % std::size_t(image.width)] > 0)) continue;
      (image.thickness[row + u] > 0 && image.through_back[row + u] == 1 ? filled : air) += 1;
    }
  }
  EXPECT_GT(filled, 100);
  EXPECT_EQ(air, 0);
  for (std::size_t i = 0; i < image.path.size(); ++i) EXPECT_FALSE(image.blank(i));
}

TEST(Projection, TheFrameDoesNotDependOnTheTumour) {
  // Sheared so that one side of the chest wall lies far in front of the other: tissue whose column
  // leaves through skin only, behind the posterior edge, is a place where a tumour would be missed.
  HexMesh mesh = deformed(breast_mesh(), View::cc,
                          [](const Vec3& x) { return Vec3(x.x(), x.y() - 0.6 * x.x(), x.z()); });
  mesh.landmarks.clear();
  const ImageFrame frame = image_frame(mesh);
  const RayMesh rays(mesh, mesh.points, frame.pose);
  int behind = -1;
  std::vector<Chord> chords;
  for (int e = 0; e < mesh.elements(); ++e) {
    const Vec2 uv = frame.pose.project(element_position(mesh, mesh.points, e, Vec3::Zero()));
    if (uv.x() > -4) continue;
    rays.trace(uv, chords);
    if (!rays.leaves_through_back(chords)) behind = e;
  }
  ASSERT_GE(behind, 0);
  mesh.landmarks = {{"tumour", Vec3::Zero(), behind, Vec3::Zero(), 0}};
  const ImageFrame same = image_frame(mesh);
  EXPECT_EQ(same.pose.origin, frame.pose.origin);
  EXPECT_EQ(same.width, frame.width);
  EXPECT_EQ(same.height, frame.height);
  // Said, not hidden.
  ProjectionReport report;
  const Mammogram image = project_mammogram(mesh, {.pixel = 2}, &report);
  const auto said = doubts(mesh, image, report);
  EXPECT_TRUE(std::any_of(said.begin(), said.end(), [](const std::string& doubt) {
    return doubt.find("tumour") != std::string::npos;
  }));
}

TEST(Projection, LabelsAreFollowedThroughTheDeformation) {
  // A gland ball in the MR frame; the squashed image must show its projected ellipsoid.
  const Vec3 centre(5, 20, -4);
  const double radius = 15, lambda = 0.5;
  const LabelVolume labels = labels_around(breast_mesh(), [&](const Vec3& x) {
    return (x - centre).norm() < radius ? Tissue::fibroglandular : Tissue::fat;
  });
  const HexMesh mesh = squashed(breast_mesh(), View::cc, lambda);
  ProjectionReport report;
  const Mammogram image = project_mammogram(mesh, {.pixel = 0.5, .labels = &labels}, &report);
  const double exact = 4.0 / 3 * std::numbers::pi * std::pow(radius, 3);
  EXPECT_NEAR(report.volumes.fibroglandular / exact, 1, 0.02);
  EXPECT_EQ(report.unlabelled, 0);
  const Vec3 moved(centre.x() / std::sqrt(lambda), centre.y() / std::sqrt(lambda),
                   centre.z() * lambda);
  const Vec2 uv = image.pose.project(moved) / image.pixel;
  const auto at = [&](int du) {
    return image
        .fibroglandular[std::size_t(std::lround(uv.y())) * image.width + std::lround(uv.x()) + du];
  };
  EXPECT_NEAR(at(0), 2 * radius * lambda, 0.8);
  const double across = radius / std::sqrt(lambda);
  EXPECT_GT(at(int(2 * (across - 2))), 1);
  EXPECT_EQ(at(int(2 * (across + 3))), 0);
}

TEST(Projection, ElementModeSumsTissue) {
  HexMesh mesh = facing_block();
  for (int e = 0; e < mesh.elements(); ++e) {
    const Vec3 middle = element_position(mesh, mesh.imaged, e, Vec3::Zero());
    if (middle.z() < 40.0 / 3) mesh.tissue[e] = Tissue::fibroglandular;  // the lowest third
  }
  add_contact(mesh, View::cc);
  const Mammogram image = project_mammogram(mesh, {.pixel = 2});
  const std::size_t middle = std::size_t(image.height / 2) * image.width + 10;
  EXPECT_NEAR(image.thickness[middle], 40, 1e-5);
  EXPECT_NEAR(image.fibroglandular[middle], 40.0 / 3, 1e-5);
  EXPECT_NEAR(image.path[middle], 40.0 / 3 + 0.5 * 80.0 / 3, 1e-5);
}

TEST(Projection, TheSameForAnyNumberOfThreads) {
  const HexMesh mesh = squashed(breast_mesh(), View::mlo, 0.6);
  const LabelVolume labels = labels_around(breast_mesh(), [](const Vec3& x) {
    return std::sin(x.x() / 5) + std::sin(x.z() / 7) > 0.3 ? Tissue::fibroglandular : Tissue::fat;
  });
  const int before = threads();
  set_threads(1);
  ProjectionReport one, two;
  const Mammogram a = project_mammogram(mesh, {.pixel = 1, .labels = &labels}, &one);
  set_threads(2);
  const Mammogram b = project_mammogram(mesh, {.pixel = 1, .labels = &labels}, &two);
  set_threads(before);
  EXPECT_EQ(a.path, b.path);
  EXPECT_EQ(a.thickness, b.thickness);
  EXPECT_EQ(one.volumes.fibroglandular, two.volumes.fibroglandular);
}

TEST(Projection, RefusesWhatItCannotImage) {
  HexMesh mesh = facing_block();
  EXPECT_THROW(project_mammogram(mesh, {}), Error);  // no compression record
  add_contact(mesh, View::cc);
  EXPECT_THROW(project_mammogram(mesh, {.pixel = 1e-4}), Error);
  EXPECT_THROW(project_mammogram(mesh, {.pixel = std::nan("")}), Error);
}
