// SPDX-License-Identifier: GPL-3.0-or-later
// Contact of faces with the plates: the patch test, an edge in the middle of the skin, friction.
#include <gtest/gtest.h>

#include <cmath>

#include "contact/faces.hpp"
#include "contact/path/path.hpp"
#include "contact/solvers/surface_contact.hpp"
#include "core/units.hpp"
#include "fixtures/block.hpp"
#include "fixtures/pressed_body.hpp"
#include "fixtures/rivlin_pressure.hpp"
#include "fixtures/standing_block.hpp"
#include "fixtures/wide_plates.hpp"
#include "mesh/nodal_faces.hpp"

namespace breast {
namespace {

MechanicsOptions seed2008(Element element = Element::q1p0) {
  MechanicsOptions options;
  options.materials = load_materials("seed2008");
  options.element = element;
  return options;
}

/// A weightless block whose faces two plates press.
class PressedFaces {
 public:
  PressedFaces(HexMesh mesh, const MechanicsOptions& options, Constraints held,
               const PlatePair& plates, const std::vector<Face>& faces, double friction = 0)
      : plates(plates),
        mesh_(std::move(mesh)),
        scene_(mesh_, options),
        body_(scene_.problem(Eigen::VectorXd::Zero(3L * scene_.nodes())).problem),
        solver_(body_.space().pattern) {
    body_.set_constraints(std::move(held));
    SurfaceContactOptions settings;
    settings.friction = {friction};
    contact_ = std::make_unique<SurfaceContact>(mesh_, faces, body_, solver_, settings);
    state = scene_.at_rest(flatten(mesh_.reference));
  }
  PathResult close_to(double thickness, const PathOptions& path = {}) {
    const auto area = [](const State&) { return 1.0; };
    return follow_path(*contact_, plates, state, {TargetKind::thickness, thickness}, area, path);
  }
  const HexMesh& mesh() const { return mesh_; }
  const std::vector<int>& candidates() const { return contact_->candidates(); }

  PlatePair plates;
  State state;

 private:
  HexMesh mesh_;
  Scene scene_;
  Problem body_;
  SaddleSolver solver_;
  std::unique_ptr<SurfaceContact> contact_;
};

}  // namespace

TEST(ContactFaces, UniformPressurePassesThroughADistortedMesh) {
  constexpr double side = 30, ratio = 0.7;
  for (const int order : {1, 2}) {
    SCOPED_TRACE(order);
    HexMesh mesh = fixtures::block({.elements = {3, 3, 3},
                                    .size = Vec3(side, side, side),
                                    .order = order,
                                    .distortion = order == 1 ? 0.2 : 0.1});
    mesh.imaged = mesh.points = mesh.reference;
    const MechanicsOptions options = seed2008(order == 1 ? Element::q1p0 : Element::q2p1);
    // The flanks are left out: their rims would be pressed too, as deep as the plates give.
    std::vector<Face> pressed;
    for (const Face& face : mesh.skin_faces) {
      double low = side, high = 0;
      for (const int node : face_nodes(mesh, face)) {
        low = std::min(low, mesh.reference[std::size_t(node)].z());
        high = std::max(high, mesh.reference[std::size_t(node)].z());
      }
      if (high < 1e-9 || low > side - 1e-9) pressed.push_back(face);
    }
    PressedFaces body(mesh, options, fixtures::mirror_planes(mesh), fixtures::wide_plates(0, side),
                      pressed);
    const PathResult path = body.close_to(ratio * side);
    ASSERT_TRUE(path.reached()) << describe(path.last_failure);
    const NodalFaces area = nodal_faces(mesh, pressed, body.state.x);
    const std::vector<NodalContact>& contacts = path.final_step.contacts;
    double mean = 0;
    int touching = 0;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (contacts[c].plate < 0) continue;
      mean += contacts[c].normal / area.area[std::size_t(body.candidates()[c])];
      ++touching;
    }
    ASSERT_GT(touching, 0);
    mean /= touching;
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      if (contacts[c].plate < 0) continue;
      const double pressure = contacts[c].normal / area.area[std::size_t(body.candidates()[c])];
      EXPECT_NEAR(pressure / mean, 1, 1e-7) << "node " << body.candidates()[c];
    }
    double low = side, high = 0;
    for (int node = 0; node < mesh.nodes(); ++node) {
      low = std::min(low, body.state.x[3L * node + 2]);
      high = std::max(high, body.state.x[3L * node + 2]);
    }
    const double now = (high - low) / side;
    EXPECT_NEAR(now, ratio, 0.1 / side);  // what the plates give
    const double exact = fixtures::rivlin_pressure(options.materials.law(Tissue::fat), now) * now;
    EXPECT_NEAR(mean / exact, 1, 1e-6);
    EXPECT_LE(path.final_step.worst_penetration, 0.05);
  }
}

// The plates' edges stand in the middle of the skin: nodes alone let faces cut across them.
TEST(ContactFaces, NoPointOfAFaceEntersARoundedEdge) {
  const Vec3 size(30, 40, 40);
  Plate plate = plate_facing(view_pose(Side::left, 0));
  plate.edge_start = 17;
  plate.far_edge = plate.half_width = 500;
  plate.edge_radius = 3;
  const HexMesh mesh = fixtures::standing_block(size, {3, 4, 4});
  Constraints held(mesh.nodes());
  for (const int node : nodes_of(mesh, mesh.pectoral_faces)) held.hold(node);
  const PlatePair plates = fixtures::pair_at(plate, -size.z(), 0);
  PressedFaces faces(mesh, seed2008(), held, plates, touchable_faces(mesh));
  const PathResult path = faces.close_to(0.75 * size.z());
  ASSERT_TRUE(path.reached()) << describe(path.last_failure);
  const std::vector<Face> free = free_boundary_faces(mesh, held);
  for (int k = 0; k < 2; ++k) {
    EXPECT_LE(deepest_penetration(mesh, free, faces.state.x, faces.plates.plate(k)), 0.05);
  }
  EXPECT_NEAR(path.points.back().paddle_N / path.points.back().detector_N, 1, 1e-6);
  std::vector<int> skin = nodes_of(mesh, mesh.skin_faces);
  std::erase_if(skin, [&](int node) { return held.at(node) != nullptr; });
  fixtures::PressedBody nodes(mesh, seed2008(), held, skin, plates);
  ASSERT_TRUE(nodes.close_to(0.75 * size.z()).reached());
  EXPECT_GT(deepest_penetration(mesh, free, nodes.state.x, nodes.plates.paddle), 0.2);
}

// Points are close at every edge of a plate: here the lateral ones, past which the flanks of the body
// stand up.
TEST(ContactFaces, DepthIsSeenAtLateralEdges) {
  const Vec3 size(90, 120, 120);
  HexMesh mesh = fixtures::standing_block(size, {3, 4, 4});
  Plate plate = plate_facing(view_pose(Side::left, 0));
  plate.edge_start = -500;
  plate.far_edge = 500;
  for (const Vec3& x : mesh.points) {
    plate.lateral_centre += x.dot(plate.lateral) / double(mesh.points.size());
  }
  plate.half_width = 27.5;
  plate.edge_radius = 3;
  std::vector<Vec3> bent = mesh.points;
  for (Vec3& x : bent) {
    if (std::abs(x.dot(plate.lateral) - plate.lateral_centre) > 30) x.z() += 12;
  }
  const PlatePair plates = fixtures::pair_at(plate, -size.z(), 0);
  SurfacePressure pressure(mesh, touchable_faces(mesh), Discretisation{});
  pressure.set_plates(plates);
  const Eigen::VectorXd x = flatten(bent);
  pressure.choose_points(x);
  // The flanks rise by 12 in 30 mm from a line 12.5 mm inside the edge.
  EXPECT_GT(pressure.deepest(x), 0.97 * 12.5 * 12 / 30);
}

// What friction holds spreads less under the plates; no node is held with more than its bound.
TEST(ContactFaces, FrictionHoldsWithinItsBound) {
  constexpr double side = 30, friction = 0.1;
  const HexMesh mesh = fixtures::standing_block(Vec3(side, side, side), {4, 4, 4});
  const auto widest = [&](const State& state) {
    double most = 0;
    for (int node = 0; node < mesh.nodes(); ++node) most = std::max(most, state.x[3L * node]);
    return most;
  };
  PressedFaces smooth(mesh, seed2008(), fixtures::mirror_planes(mesh),
                      fixtures::wide_plates(0, side), touchable_faces(mesh));
  PressedFaces rough(mesh, seed2008(), fixtures::mirror_planes(mesh),
                     fixtures::wide_plates(0, side), touchable_faces(mesh), friction);
  ASSERT_TRUE(smooth.close_to(0.7 * side).reached());
  const PathResult path = rough.close_to(0.7 * side);
  ASSERT_TRUE(path.reached());
  double corner_smooth = 0, corner_rough = 0;  // where the plates touch
  for (int node = 0; node < mesh.nodes(); ++node) {
    if (mesh.reference[std::size_t(node)].z() < side - 1e-9) continue;
    corner_smooth = std::max(corner_smooth, smooth.state.x[3L * node]);
    corner_rough = std::max(corner_rough, rough.state.x[3L * node]);
  }
  EXPECT_LT(corner_rough, corner_smooth - 0.1);
  EXPECT_GT(widest(rough.state), corner_rough);  // it bulges between the plates
  int slipping = 0;
  for (const NodalContact& contact : path.final_step.contacts) {
    if (contact.plate < 0) continue;
    EXPECT_LE(contact.tangential.norm(), 1.01 * friction * contact.normal + 1);
    if (contact.tangential.norm() > 0.99 * friction * contact.normal) ++slipping;
  }
  EXPECT_GT(slipping, 0);
}

// Where a step of the plates begins before they touch, friction holds the nodes from where they were
// when they were touched, and not from the end of the step.
TEST(ContactFaces, FrictionHoldsFromWhereANodeWasTouched) {
  constexpr double side = 30, gap = 2.5;
  const HexMesh mesh = fixtures::standing_block(Vec3(side, side, side), {3, 3, 3});
  const auto spread = [&](double friction, double step) {
    PlatePair plates = fixtures::wide_plates(0, side + gap);
    plates.detector_rise = 0;
    PressedFaces block(mesh, seed2008(), fixtures::mirror_planes(mesh), plates,
                       touchable_faces(mesh), friction);
    PathOptions path;
    path.first_step = path.longest_step = step;
    EXPECT_TRUE(block.close_to(side - gap, path).reached());
    double widest = 0;
    for (int node = 0; node < mesh.nodes(); ++node) {
      if (mesh.reference[std::size_t(node)].z() < side - 1e-9) continue;
      widest = std::max(widest, block.state.x[3L * node] - side);
    }
    return widest;
  };
  const double smooth = spread(0, 2 * gap), held = spread(2, 0.1 * gap),
               at_once = spread(2, 2 * gap);
  EXPECT_LT(held, 0.3 * smooth);
  // Half of the step is made before the nodes are touched.
  EXPECT_LT(at_once - held, 0.6 * (smooth - held));
}

// A coefficient of 2 holds every touched node within the slip at which friction is fully developed,
// however soft the tissue is at small strains and however fine the mesh is.
TEST(ContactFaces, FrictionHoldsSoftTissueThatStiffens) {
  constexpr double side = 30;
  MechanicsOptions soft = seed2008();
  soft.materials = load_materials("invivo");
  for (const int elements : {2, 4}) {
    SCOPED_TRACE(elements);
    const HexMesh mesh =
        fixtures::standing_block(Vec3(side, side, side), {elements, elements, elements});
    PressedFaces block(mesh, soft, fixtures::mirror_planes(mesh), fixtures::wide_plates(0, side),
                       touchable_faces(mesh), 2);
    ASSERT_TRUE(block.close_to(0.6 * side).reached());
    double widest = 0;
    for (int node = 0; node < mesh.nodes(); ++node) {
      if (mesh.reference[std::size_t(node)].z() < side - 1e-9) continue;
      widest = std::max(widest, block.state.x[3L * node] - side);
    }
    EXPECT_LT(widest, 0.5);
  }
}

}  // namespace breast
