// SPDX-License-Identifier: GPL-3.0-or-later
// The phantom's truth obeys the same discrete mechanics as the chain.
#include <gtest/gtest.h>

#include "core/units.hpp"
#include "fixtures/in_place.hpp"
#include "fixtures/small_phantom.hpp"
#include "mesh/quality.hpp"
#include "phantom/chest/rib_surface.hpp"
#include "phantom/postures.hpp"

using namespace breast;

namespace {

struct Solved {
  Solved()
      : parameters(small_phantom()),
        materials(load_materials("seed2008")),
        torso(parameters.torso, 1),
        breast(parameters, torso, Side::right),
        postures(solve_breast(breast, parameters, materials, error)) {}
  PhantomParameters parameters;
  MaterialSet materials;
  Torso torso;
  PhantomBreast breast;
  TruthError error;
  Postures postures;
};
Solved& solved() {
  static Solved made;
  return made;
}

double largest(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double worst = 0;
  for (std::size_t n = 0; n < a.size(); ++n) worst = std::max(worst, (a[n] - b[n]).norm());
  return worst;
}

}  // namespace

TEST(PhantomPostures, ForwardFromTheStressFreeShapeReturnsTheProneOne) {
  HexMesh mesh = solved().breast.mesh;
  const std::vector<Vec3> prone = mesh.points;
  mesh.points = mesh.reference;
  MechanicsOptions options;
  options.materials = solved().materials;
  options.element = Element::q2p1;
  options.cut = cut_support("fixed");
  ASSERT_TRUE(fixtures::forward_into(mesh, posture_gravity(Posture::prone), options).converged());
  // The stored imaged shape is the prone one to 1e-4 mm, its forces the same to 1e-7.
  EXPECT_LT(largest(mesh.points, prone), 1e-6);
  EXPECT_LT(largest(solved().breast.mesh.imaged, prone), 1e-4);
}

TEST(PhantomPostures, BackwardFindsTheStressFreeShape) {
  HexMesh mesh = solved().breast.mesh;
  const std::vector<Vec3> truth = mesh.reference;
  MechanicsOptions options;
  options.materials = solved().materials;
  options.element = Element::q2p1;
  options.cut = cut_support("fixed");
  ASSERT_TRUE(fixtures::backward_into(mesh, posture_gravity(Posture::prone), options).converged());
  EXPECT_LT(largest(mesh.reference, truth), 1e-3);
}

// The truth of a breast that slides: the body found is in balance in the shape of the scan, its wall
// nodes stay on the rib cage, and it moves as breasts do.
TEST(SlidingPhantom, HangsAsShapedAndSlidesOnItsRibs) {
  PhantomParameters parameters = phantom_preset("slim", 1);
  parameters.mesh = coarse_mesh(parameters);
  const MaterialSet materials = body_materials(parameters.body);
  const Torso torso(parameters.torso, 1);
  PhantomBreast breast(parameters, torso, Side::left);
  TruthError error;
  const Postures postures = solve_breast(breast, parameters, materials, error);
  EXPECT_LT(error.worst(), 2.5);
  EXPECT_LT(error.prone_mm, 1e-9);

  HexMesh mesh = breast.mesh;
  EXPECT_EQ(largest(mesh.points, mesh.imaged), 0);
  mesh.reference = postures.stress_free;
  mesh.points = mesh.reference;
  MechanicsOptions options;
  options.materials = materials;
  options.element = Element::q2p1;
  take_supports_of_set(options);
  options.wall_surface = std::make_shared<RibSurface>(parameters.torso);
  ASSERT_TRUE(fixtures::forward_into(mesh, posture_gravity(Posture::prone), options).converged());
  EXPECT_LT(largest(mesh.points, mesh.imaged), 1e-7);

  const RibSurface ribs(parameters.torso);
  double slid = 0;
  for (const int node : nodes_of(mesh, mesh.pectoral_faces)) {
    const Vec3 &from = mesh.imaged[std::size_t(node)], &to = postures.supine[std::size_t(node)];
    EXPECT_NEAR(ribs.at(to)->value, ribs.at(from)->value, 1e-9);
    slid = std::max(slid, (to - from).norm());
  }
  EXPECT_GT(slid, 10);
  const Vec3 nipple =
      postures.supine[std::size_t(mesh.nipple_node)] - mesh.imaged[std::size_t(mesh.nipple_node)];
  EXPECT_GT(nipple.x(), 10);
  EXPECT_GT(nipple.y(), 10);
}

// A supine breast hangs over the cut at its side. Where that is as near as in the image, elements
// between cut and wall become flat (0.35 here, and folded on the mesh of the presets).
TEST(SlidingPhantom, ElementsAtItsSideKeepTheirShapeWhenItLiesSupine) {
  PhantomParameters parameters = phantom_preset("heavy", 1);
  parameters.mesh = coarse_mesh(parameters);
  const Torso torso(parameters.torso, 1);
  PhantomBreast breast(parameters, torso, Side::left);
  TruthError error;
  const Postures postures =
      solve_breast(breast, parameters, body_materials(parameters.body), error);
  for (const Face& face : breast.mesh.cut_faces)
    EXPECT_GT(scaled_jacobian(breast.mesh, postures.supine, face.element), 0.5);
}

TEST(PhantomPostures, AnotherMeshOfTheBodyCarriesTheSameLandmarks) {
  PhantomParameters finer = small_phantom();
  finer.mesh = {6, 3, 2, 2, 4, 1};
  PhantomBreast other(finer, solved().torso, Side::right);
  const HexMesh& mesh = solved().breast.mesh;
  carry_landmarks(mesh, other.mesh);
  ASSERT_EQ(other.mesh.landmarks.size(), mesh.landmarks.size());
  for (const Landmark& landmark : mesh.landmarks) {
    const Landmark* same = other.mesh.landmark(landmark.name);
    ASSERT_NE(same, nullptr) << landmark.name;
    const double moved = (landmark_position(other.mesh, other.mesh.reference, *same) -
                          landmark_position(mesh, mesh.reference, landmark))
                             .norm();
    EXPECT_LT(moved, landmark.name == "nipple" ? 0.5 : 1e-6) << landmark.name;
  }
}

TEST(PhantomPostures, WallAndCutStayAndTheVolumeIsKept) {
  const HexMesh& mesh = solved().breast.mesh;
  for (const auto* faces : {&mesh.pectoral_faces, &mesh.cut_faces})
    for (int node : nodes_of(mesh, *faces)) {
      EXPECT_LT((mesh.points[node] - mesh.reference[node]).norm(), 1e-12);
      EXPECT_LT((solved().postures.supine[node] - mesh.reference[node]).norm(), 1e-12);
    }
  EXPECT_NEAR(mesh_volume(mesh, mesh.points) / mesh_volume(mesh, mesh.reference), 1, 1e-6);
  EXPECT_GT(mesh_quality(mesh, solved().postures.supine).min_scaled_jacobian, 0.3);
}

TEST(PhantomPostures, TheNippleHangsProneAndSinksSupine) {
  const HexMesh& mesh = solved().breast.mesh;
  const Landmark& nipple = *mesh.landmark("nipple");
  const Vec3 free = landmark_position(mesh, mesh.reference, nipple);
  const Vec3 prone = landmark_position(mesh, mesh.points, nipple);
  const Vec3 supine = landmark_position(mesh, solved().postures.supine, nipple);
  EXPECT_LT(prone.y(), free.y() - 1);
  EXPECT_GT(supine.y(), free.y() + 1);
  EXPECT_LT((nipple.imaged - prone).norm(), 1e-3);
  EXPECT_GT(solved().error.worst(), 0);
  EXPECT_LT(solved().error.worst(), 0.3);
}
