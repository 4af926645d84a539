// SPDX-License-Identifier: GPL-3.0-or-later
// Plates as rounded bodies: distance and derivatives, placement, T0.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "contact/faces.hpp"
#include "contact/plates.hpp"
#include "core/error.hpp"
#include "fixtures/standing_block.hpp"
#include "mesh/plate_edge.hpp"

using namespace breast;

namespace {

Plate tilted_plate(double radius) {
  Plate plate = plate_facing(view_pose(Side::left, 37));
  plate.level = -3;
  plate.edge_start = 10;
  plate.far_edge = 60;
  plate.half_width = 30;
  plate.lateral_centre = 4;
  plate.mid_depth = 35;
  plate.tilt_slope = 0.07;
  plate.edge_radius = radius;
  return plate;
}

Vec3 at(const Plate& plate, double h, double a, double v) {
  return h * plate.n + a * plate.anterior + (plate.lateral_centre + v) * plate.lateral;
}

}  // namespace

TEST(Plates, GapDerivativesMatchDifferences) {
  const Plate plate = tilted_plate(15);
  const double step = 1e-5;
  // Over the flat, round the wall edge, behind its wall, the front edge, sides, and a corner.
  for (const Vec3& place : {Vec3(5, 30, 0), Vec3(5, 4, 0), Vec3(-40, -9, 3), Vec3(5, 66, -5),
                            Vec3(5, 30, 37), Vec3(5, 30, -41), Vec3(5, 3, 38), Vec3(-4, 4, 37)}) {
    const Vec3 x = at(plate, place[0], place[1], place[2]);
    const Gap gap = plate.gap(x);
    EXPECT_NEAR(gap.gradient.norm(), 1, 1e-12) << place;
    for (int i = 0; i < 3; ++i) {
      const Vec3 d = step * Vec3::Unit(i);
      const Gap up = plate.gap(x + d), down = plate.gap(x - d);
      EXPECT_NEAR((up.value - down.value) / (2 * step), gap.gradient[i], 1e-8) << place;
      const Vec3 hessian = (up.gradient - down.gradient) / (2 * step);
      EXPECT_LT((hessian - gap.hessian.col(i)).norm(), 1e-7) << place;
    }
  }
}

TEST(Plates, GapIsTheDistanceToTheRoundedEdge) {
  Plate plate = tilted_plate(15);
  plate.tilt_slope = 0;
  // Centre of the rounding: a radius below the flat, where the edge starts.
  const Vec3 centre = at(plate, plate.level - 15, plate.edge_start, 0);
  for (const double angle : {0.1, 0.7, 1.5}) {
    for (const double away : {-2.0, 0.0, 6.0}) {
      const Vec3 out = std::cos(angle) * plate.n - std::sin(angle) * plate.anterior;
      const Gap gap = plate.gap(centre + (15 + away) * out);
      EXPECT_NEAR(gap.value, away, 1e-12) << angle;
      EXPECT_LT((gap.gradient - out).norm(), 1e-12) << angle;
    }
  }
  // Behind the wall only the way to it counts, however far the plate has come.
  EXPECT_NEAR(plate.gap(at(plate, plate.level - 80, plate.edge_start - 21, 0)).value, 6, 1e-12);
}

TEST(Plates, OverlapIsTheWayBackAlongTheBeam) {
  Plate plate = tilted_plate(15);
  plate.tilt_slope = 0;
  for (const Vec3& place :
       {Vec3(-20, 30, 0), Vec3(-25, 4, 0), Vec3(-30, -2, 3), Vec3(-12, 5, 37)}) {
    const Vec3 x = at(plate, place[0], place[1], place[2]);
    const double back = plate.overlap(x);
    ASSERT_GT(back, 0) << place;
    Plate drawn = plate;
    drawn.level -= back;
    EXPECT_NEAR(drawn.gap(x).value, 0, 1e-10) << place;
  }
  EXPECT_EQ(plate.overlap(at(plate, -80, 10 - 16, 0)), 0) << "behind the wall";
  EXPECT_EQ(plate.overlap(at(plate, 5, 30, 0)), 0);
}

TEST(Plates, EdgeRecedesOnACircleUntilItStandsUpright) {
  EXPECT_EQ(edge_recession(15, -1), 0);
  EXPECT_NEAR(edge_recession(15, 9), 3, 1e-12);
  EXPECT_NEAR(edge_recession(15, 15 - 1e-12), 15, 1e-5);
  EXPECT_TRUE(std::isinf(edge_recession(15, 15)));
  EXPECT_TRUE(std::isinf(edge_recession(0, 1e-3)));
}

TEST(Plates, PaddleAndDetectorFaceEachOther) {
  Plate paddle = tilted_plate(10), detector = paddle;
  paddle.tilt_slope = detector.tilt_slope = 0;
  detector.sign = -1;
  detector.level = 7;
  const Vec3 x = at(paddle, 2, 35, 0);
  EXPECT_NEAR(paddle.gap(x).value, 5, 1e-12);
  EXPECT_NEAR(detector.gap(x).value, 5, 1e-12);
  EXPECT_LT((paddle.normal() + detector.normal()).norm(), 1e-14);
  EXPECT_NEAR(paddle.gap(paddle.origin()).value, 0, 1e-12);
}

TEST(Plates, PlacementMeasuresStandoffAndThickness) {
  // 60 deep (anterior), 40 high, 50 wide; wall at y = 0.
  const HexMesh mesh = fixtures::standing_block({50, 60, 40}, {5, 6, 4});
  PlateOptions options;
  options.standoff = 25;
  PlatePair plates = place_plates(mesh, mesh.points, view_pose(Side::left, 0), options);
  EXPECT_NEAR(plates.wall_point, 0, 1e-12);
  EXPECT_NEAR(plates.paddle.edge_start, 25, 1e-12);
  EXPECT_NEAR(plates.initial_thickness, 40, 1e-12);
  EXPECT_NEAR(plates.touching_thickness, 40, 1e-12);
  EXPECT_NEAR(plates.paddle.mid_depth, 42.5, 1e-12);
  plates.close_to(30);
  EXPECT_NEAR(plates.thickness(), 30, 1e-12);
  // Both plates moved by 5 mm about the mid-plane.
  const Vec3 middle(25, -42.5, 20);
  EXPECT_NEAR(plates.paddle.gap(middle).value, 15, 1e-12);
  EXPECT_NEAR(plates.detector.gap(middle).value, 15, 1e-12);
  // The mid-plane follows the breast.
  plates.moved = 4;
  plates.close_to(30);
  EXPECT_NEAR(plates.thickness(), 30, 1e-12);
  EXPECT_NEAR(plates.paddle.gap(middle).value, 11, 1e-12);
  EXPECT_NEAR(plates.detector.gap(middle).value, 19, 1e-12);
}

TEST(Plates, StandoffFollowsTheDepthUpToALimit) {
  for (const auto& [depth, standoff] : {std::pair{60.0, 20.0}, std::pair{120.0, 25.0}}) {
    const HexMesh mesh = fixtures::standing_block({50, depth, 40}, {2, 2, 2});
    const PlatePair plates = place_plates(mesh, mesh.points, view_pose(Side::left, 0), {});
    EXPECT_NEAR(plates.standoff, standoff, 1e-12);
    EXPECT_NEAR(plates.paddle.edge_start, standoff, 1e-12);
  }
}

// The block turned about the patient's long axis, as ribs are that fall away towards the side.
TEST(Plates, TheEdgeOfTheImageLiesAlongTheWall) {
  for (const Side side : {Side::left, Side::right}) {
    SCOPED_TRACE(side_name(side));
    HexMesh mesh = fixtures::standing_block({50, 60, 40}, {5, 6, 4});
    mesh.side = side;
    const double angle = 20, turn = lateral_sign(side) * angle * std::numbers::pi / 180;
    const Eigen::AngleAxisd turned(turn, Vec3::UnitZ());
    for (Vec3& x : mesh.points) x = turned * x;
    mesh.reference = mesh.imaged = mesh.points;
    EXPECT_NEAR(wall_turn_deg(mesh, mesh.points, 45), angle, 1e-9);
    EXPECT_NEAR(wall_turn_deg(mesh, mesh.points, 15), 15, 1e-9);
    const ViewPose pose = view_pose(side, 45, angle);
    EXPECT_LT((pose.e_u - turned * Vec3(0, -1, 0)).norm(), 1e-12);
    EXPECT_NEAR(pose.n.dot(pose.e_u), 0, 1e-12);
    EXPECT_NEAR(pose.n.z(), view_pose(side, 45).n.z(), 1e-12);
    PlateOptions options;
    options.image_edge = 5;
    const PlatePair plates = place_plates(mesh, mesh.points, pose, options);
    EXPECT_NEAR(plates.paddle.edge_start, 5, 1e-9);
    EXPECT_NEAR(plates.standoff, 5, 1e-9);
  }
}

// The block tipped forwards at its upper end, as a chest wall that recedes towards the neck.
TEST(Plates, TheEdgeOfObliquePlatesLeansWithTheWallAndATriangleMore) {
  for (const Side side : {Side::left, Side::right}) {
    for (const double angle : {45.0, 90.0}) {
      SCOPED_TRACE(testing::Message() << side_name(side) << " " << angle);
      HexMesh mesh = fixtures::standing_block({50, 60, 40}, {5, 6, 4});
      mesh.side = side;
      const ViewPose level = view_pose(side, angle);
      const double tip = 10 * std::numbers::pi / 180;
      const Vec3 axis = -lateral_sign(side) * level.n;
      for (Vec3& x : mesh.points) x = Eigen::AngleAxisd(tip, axis) * x;
      mesh.reference = mesh.imaged = mesh.points;
      const double lean = muscle_lean_deg(mesh, mesh.points, level);
      EXPECT_NEAR(lean, 14, 1e-9);
      const ViewPose pose = view_pose(side, angle, 0, lean);
      EXPECT_LT((pose.n - level.n).norm(), 1e-12);
      EXPECT_GT(pose.e_u.z(), 0);
      EXPECT_NEAR(pose.e_u.dot(level.e_u), std::cos(lean * std::numbers::pi / 180), 1e-12);
      EXPECT_LT((pose.e_v - pose.n.cross(pose.e_u)).norm(), 1e-12);
    }
  }
}

TEST(Plates, TheEdgeOfCraniocaudalPlatesDoesNotLean) {
  const HexMesh mesh = fixtures::standing_block({50, 60, 40}, {5, 6, 4});
  EXPECT_EQ(muscle_lean_deg(mesh, mesh.points, view_pose(mesh.side, 0)), 0);
}

// The same block: between plates that press from head to foot the patient bends forwards, and gravity turns with her.
TEST(Plates, APatientWhoseChestWallRecedesUpwardsBendsForwardsAlongIt) {
  for (const Side side : {Side::left, Side::right}) {
    SCOPED_TRACE(side_name(side));
    HexMesh mesh = fixtures::standing_block({50, 60, 40}, {5, 6, 4});
    mesh.side = side;
    const auto tip = [&mesh](double degrees) {
      for (Vec3& x : mesh.points)
        x = Eigen::AngleAxisd(degrees * std::numbers::pi / 180, -Vec3::UnitX()) * x;
      mesh.reference = mesh.imaged = mesh.points;
    };
    tip(10);
    PlateOptions options;
    options.bend_deg = std::nullopt;
    options.image_edge = 5;
    const ViewPose pose = place_pose(mesh, mesh.points, 0, options);
    EXPECT_NEAR(pose.bend_deg, 10, 1e-9);
    EXPECT_GT(pose.e_u.z(), 0);
    EXPECT_NEAR(pose.n.dot(pose.e_u), 0, 1e-12);
    EXPECT_LT((pose.e_v - pose.n.cross(pose.e_u)).norm(), 1e-12);
    EXPECT_LT((turned_by_bend(pose, {0, 0, -1}) - pose.n).norm(), 1e-12);
    EXPECT_NEAR(place_plates(mesh, mesh.points, pose, options).standoff, 5, 1e-9);
    tip(20);
    EXPECT_EQ(place_pose(mesh, mesh.points, 0, options).bend_deg, 20) << "at most";
    tip(-50);
    EXPECT_EQ(place_pose(mesh, mesh.points, 0, options).bend_deg, 0) << "nobody bends backwards";
  }
}

// In an oblique view, too, she bends about the direction along the edge.
TEST(Plates, APatientBendsForwardsInAnObliqueView) {
  for (const Side side : {Side::left, Side::right}) {
    SCOPED_TRACE(side_name(side));
    HexMesh mesh = fixtures::standing_block({50, 60, 40}, {5, 6, 4});
    mesh.side = side;
    for (Vec3& x : mesh.points) x = Eigen::AngleAxisd(0.2, -Vec3::UnitX()) * x;
    mesh.reference = mesh.imaged = mesh.points;
    PlateOptions options;
    options.bend_deg = options.lean_deg = std::nullopt;
    options.image_edge = 5;
    const Vec3 forwards(0, -std::cos(0.2), std::sin(0.2));  // away from the ribs
    const ViewPose pose = place_pose(mesh, mesh.points, 45, options);
    EXPECT_GT(pose.bend_deg, 5);
    EXPECT_NEAR(pose.n.dot(forwards), 0, 1e-9) << "neither plate's edge is nearer to the ribs";
  }
}

TEST(Plates, APatientBendsUntilBothEdgesCarryTheSameShare) {
  EXPECT_NEAR(balanced_bend_deg(8, {0.20, 0.44}), 10, 1e-9) << "to the paddle's edge";
  EXPECT_NEAR(balanced_bend_deg(8, {0.44, 0.20}), 6, 1e-9) << "to the detector's";
  EXPECT_EQ(balanced_bend_deg(8, {0.5, 0.5}), 8);
  EXPECT_EQ(balanced_bend_deg(8, {0, 1}), 12) << "at most 4 degrees at once";
  EXPECT_EQ(balanced_bend_deg(18, {0, 1}), 20);
  EXPECT_EQ(balanced_bend_deg(2, {1, 0}), 0);
}

// The beam's direction and the image's axes as functions of the angle have one axis of rotation.
TEST(Plates, ALargerAngleTurnsLeaningPlatesAboutTheAxisOfTheirPose) {
  for (const Side side : {Side::left, Side::right}) {
    const ViewPose pose = view_pose(side, 45, 20, 12, 7);
    constexpr double step = 1e-4;
    const Vec3 turn = lateral_sign(side) * step * std::numbers::pi / 180 * pose.angle_axis;
    const ViewPose more = view_pose(side, 45 + step, 20, 12, 7);
    EXPECT_LT((more.n - pose.n - turn.cross(pose.n)).norm(), 1e-11);
    EXPECT_LT((more.e_u - pose.e_u - turn.cross(pose.e_u)).norm(), 1e-11);
    EXPECT_LT((more.e_v - pose.e_v - turn.cross(pose.e_v)).norm(), 1e-11);
  }
}

// Points of the cut are tissue: an edge of the image is measured from the chest wall alone.
TEST(Plates, TheEdgeOfTheImageDoesNotSeeTheCut) {
  HexMesh mesh = fixtures::standing_block({50, 60, 40}, {5, 6, 4});
  const auto in_front = [&](const Face& face) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    return std::all_of(nodes.begin(), nodes.end(), [&](int n) {
      return mesh.points[std::size_t(n)].z() > 39.9 && mesh.points[std::size_t(n)].y() > -20.1;
    });
  };
  for (const Face& face : mesh.skin_faces) {
    if (in_front(face)) mesh.cut_faces.push_back(face);
  }
  std::erase_if(mesh.skin_faces, in_front);
  ASSERT_FALSE(mesh.cut_faces.empty());
  PlateOptions by_wall, by_both;
  by_wall.image_edge = 5;
  by_both.standoff = 5;
  const ViewPose pose = view_pose(Side::left, 0);
  EXPECT_NEAR(place_plates(mesh, mesh.points, pose, by_wall).paddle.edge_start, 5, 1e-9);
  EXPECT_NEAR(place_plates(mesh, mesh.points, pose, by_both).paddle.edge_start, 25, 1e-9);
}

TEST(Plates, EdgeMayBeGivenByItsPlace) {
  const HexMesh mesh = fixtures::standing_block({50, 60, 40}, {2, 2, 2});
  PlateOptions options;
  options.edge_at = 18;
  options.middle_at = -13;  // the block reaches from −40 to 0
  options.edge_radius = 0;
  const PlatePair plates = place_plates(mesh, mesh.points, view_pose(Side::left, 0), options);
  EXPECT_NEAR(plates.paddle.edge_start, 18, 1e-12);
  EXPECT_NEAR(plates.standoff, 18, 1e-12);
  EXPECT_NEAR(plates.middle(), -13, 1e-12);
  EXPECT_NEAR(plates.initial_thickness, 40, 1e-12);
  EXPECT_NEAR(plates.touching_thickness, 54, 1e-12) << "opened until the lower side is clear";
  EXPECT_NEAR(plates.paddle.edge_radius, 1, 0) << "no corner is sharper";
}

TEST(Plates, FootprintIsCutAtTheEdgeNotAtNodes) {
  // A wedge: height 60 at the wall falling to 20 at the front; coarse elements.
  HexMesh mesh = fixtures::standing_block({50, 60, 60}, {2, 2, 2});
  for (Vec3& x : mesh.points) {
    const double shrink = 1 - (-x.y() / 60) * (2.0 / 3);
    x.z() = 30 + (x.z() - 30) * shrink;
  }
  PlateOptions options;
  options.standoff = 20;
  options.edge_radius = 5;
  const PlatePair plates = place_plates(mesh, mesh.points, view_pose(Side::left, 0), options);
  EXPECT_NEAR(plates.initial_thickness, 60 - 20 * 40.0 / 60, 1e-9);
  EXPECT_GE(plates.touching_thickness, plates.initial_thickness);
  for (const int node : nodes_of(mesh, mesh.skin_faces)) {
    EXPECT_GE(plates.paddle.gap(mesh.points[node]).value, -1e-9);
    EXPECT_GE(plates.detector.gap(mesh.points[node]).value, -1e-9);
  }
  // Plates at the edge of the image begin where the wedge is thicker than the breast, which begins at a third of the depth.
  PlateOptions clinical;
  clinical.image_edge = 5;
  const PlatePair at_image = place_plates(mesh, mesh.points, view_pose(Side::left, 0), clinical);
  EXPECT_NEAR(at_image.paddle.edge_start, 5, 1e-9);
  EXPECT_NEAR(at_image.initial_thickness, 60 - 20 * 40.0 / 60, 1e-9);
  EXPECT_GE(at_image.touching_thickness, 60 - 5 * 40.0 / 60);
}

TEST(Plates, DetectorStaysOrRisesAsFarAsItMay) {
  const HexMesh mesh = fixtures::standing_block({50, 60, 40}, {2, 2, 2});
  std::vector<Vec3> hanging = mesh.points;
  for (Vec3& x : hanging) x.z() -= 0.1 * -x.y();  // sinks towards the nipple
  const auto place = [&](double rise) {
    PlateOptions options;
    options.detector_rise = rise;
    return place_plates(mesh, hanging, view_pose(Side::left, 0), options);
  };
  PlatePair stays = place(0);
  const double touching = stays.detector_start, top = stays.paddle_start;
  EXPECT_NEAR(touching, 6, 1e-9);  // the lowest skin: h = −z
  stays.close_to(25);
  EXPECT_NEAR(stays.detector.level, touching, 1e-12);
  EXPECT_NEAR(stays.thickness(), 25, 1e-12);
  PlatePair rises = place(4);
  rises.close_to(25);
  EXPECT_NEAR(rises.detector.level, touching - 4, 1e-12);
  EXPECT_NEAR(rises.thickness(), 25, 1e-12);
  rises.close_to(rises.initial_thickness - 2);
  EXPECT_NEAR(rises.detector.level, touching - 1, 1e-12);
  EXPECT_NEAR(rises.paddle.level, top + 1, 1e-12);
  // Lifted all the way: the plates meet at the middle of the unloaded footprint.
  PlatePair lifts = place(std::numeric_limits<double>::infinity());
  lifts.close_to(10);
  EXPECT_NEAR(lifts.paddle.level + lifts.detector.level, -40, 1e-9);
}

TEST(Plates, MissingTheBreastIsAnInputError) {
  const HexMesh mesh = fixtures::standing_block({50, 60, 40}, {2, 2, 2});
  PlateOptions options;
  options.standoff = 80;
  try {
    place_plates(mesh, mesh.points, view_pose(Side::left, 0), options);
    FAIL() << "plates in front of the breast were accepted";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::input);
    EXPECT_NE(std::string(error.what()).find("miss the breast"), std::string::npos);
  }
}

// A face whose corners lie on the rounded edge cuts the corner: nothing at its nodes, the sagitta of
// the arc in its middle. The cut counts unless it is held.
TEST(Penetration, IsSeenInsideFacesWhoseNodesTouch) {
  HexMesh mesh = fixtures::standing_block({20, 20, 20}, {1, 1, 1});
  const Plate plate = [] {
    Plate made = plate_facing(view_pose(Side::left, 0));
    made.level = -20;
    made.edge_start = -20;
    made.far_edge = made.half_width = 1e3;
    made.edge_radius = 30;
    return made;
  }();
  // Two edges of the top face on the arc, whose axis runs across the breast.
  Eigen::VectorXd x(3L * mesh.nodes());
  const Vec3 axis = plate.origin() - plate.edge_radius * plate.normal();
  for (int n = 0; n < mesh.nodes(); ++n) {
    Vec3 point = mesh.reference[std::size_t(n)];
    if (point.z() > 19) {
      const double angle = point.y() < -10 ? 0.2 : 0.9;
      const Vec3 on_arc = axis + plate.edge_radius * (std::cos(angle) * plate.normal() -
                                                      std::sin(angle) * plate.anterior);
      point = Vec3(point.x(), on_arc.y(), on_arc.z());
    }
    x.segment<3>(3L * n) = point;
  }
  std::vector<Face> top;
  double at_nodes = 0;
  for (const Face& face : boundary_faces(mesh)) {
    bool all = true;
    for (const int node : face_nodes(mesh, face)) {
      all = all && mesh.reference[std::size_t(node)].z() > 19;
    }
    if (!all) continue;
    top.push_back(face);
    for (const int node : face_nodes(mesh, face)) {
      at_nodes = std::max(at_nodes, std::abs(plate.gap(x.segment<3>(3L * node)).value));
    }
  }
  ASSERT_EQ(top.size(), 1u);
  EXPECT_LT(at_nodes, 1e-12);
  const double sagitta = plate.edge_radius * (1 - std::cos(0.35));
  EXPECT_NEAR(deepest_penetration(mesh, top, x, plate), sagitta, 1e-9);

  Constraints held(mesh.nodes());
  const std::size_t all = free_boundary_faces(mesh, held).size();
  EXPECT_EQ(all, mesh.skin_faces.size() + mesh.cut_faces.size() + mesh.pectoral_faces.size());
  for (const int node : nodes_of(mesh, mesh.pectoral_faces)) held.hold(node);
  EXPECT_EQ(free_boundary_faces(mesh, held).size(), all - mesh.pectoral_faces.size());
}
