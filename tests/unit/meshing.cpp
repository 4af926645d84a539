// SPDX-License-Identifier: GPL-3.0-or-later
// Templates, placement, smoothing, skin layer, tissue and landmarks on the analytic breast.
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "fixtures/boundary_sets.hpp"
#include "mesh/cut_border.hpp"
#include "mesh/locate.hpp"
#include "mesh/quality.hpp"
#include "meshing/agreement.hpp"
#include "meshing/attempts.hpp"
#include "meshing/layers/surrounding_layers.hpp"
#include "meshing/skin.hpp"
#include "meshing/smoothing/corner_energy.hpp"
#include "meshing/tissue.hpp"
#include "meshing/tumour.hpp"

namespace breast {
namespace {

// Tests run beside one another: threads waiting for a busy core cost more than they bring.
class OneThread : public testing::Environment {
  void SetUp() override { set_threads(1); }
};
const auto* const one_thread = testing::AddGlobalTestEnvironment(new OneThread);

TEST(Dome, CountsFollowTheFormula) {
  for (const DomeSize& size :
       {DomeSize{10, 10, 6, 3}, {4, 6, 2, 2}, {7, 5, 3, 1}, {16, 16, 0, 4}}) {
    const DomeTemplate dome = dome_template(size);
    const int n = size.n, l = size.l, m = size.m, k = size.k;
    EXPECT_EQ(int(dome.connectivity.size()) / 8, n * n * l + m * (n * n + 4 * n * l));
    EXPECT_EQ(dome.skin_faces.size(), std::size_t(n * n + 4 * n * (l - k)));
    EXPECT_EQ(dome.cut_faces.size(), std::size_t(4 * n * k));
    EXPECT_EQ(dome.wall_faces.size(), std::size_t(n * n + 4 * n * m));
    EXPECT_EQ(1 + *std::max_element(dome.connectivity.begin(), dome.connectivity.end()),
              int(dome.places.size()));
  }
}

TEST(Dome, SixteenIsThePapersSize) {
  const DomeSize dome = dome_near(16);
  EXPECT_EQ((std::array{dome.n, dome.l, dome.m, dome.k}), (std::array{10, 10, 6, 3}));
  const DomeTemplate cuboid = dome_template(cuboid_size(16));
  EXPECT_EQ(cuboid.connectivity.size() / 8, 4096u);
  EXPECT_EQ(cuboid.places.size(), 4913u);
}

TEST(Dome, EveryEdgeHasAnEvenlyProportionedMember) {
  for (int edge = 4; edge <= 32; edge += 2) {
    const double wanted = double(edge) * edge * edge;
    EXPECT_NEAR(dome_near(edge).elements() / wanted, 1, edge < 8 ? 0.45 : 0.15) << edge;
  }
}

/// Every attempt is a possible mesh, in the stated order, and those before the last step have about as
/// many elements.
TEST(MeshAttempts, FollowTheStatedOrder) {
  const std::vector<std::string> order = {"",          "template",   "layers",
                                          "smoothing", "untangling", "elements"};
  for (const DomeSize& size : {dome_near(4), dome_near(10), dome_near(16), cuboid_size(16)}) {
    std::size_t step = 0;
    for (const MeshAttempt& attempt : mesh_attempts(size, {})) {
      const auto found = std::find(order.begin() + std::ptrdiff_t(step), order.end(), attempt.step);
      ASSERT_NE(found, order.end()) << attempt.step;
      step = std::size_t(found - order.begin());
      EXPECT_NO_THROW(check_dome(attempt.size));
      if (attempt.step != "elements") {
        EXPECT_NEAR(double(attempt.size.elements()) / size.elements(), 1, 0.2) << attempt.step;
      }
    }
    EXPECT_EQ(order[step], "elements");
  }
}

TEST(Dome, BadSizesAreRefused) {
  EXPECT_THROW(check_dome({10, 10, 6, 10}), Error);
  EXPECT_THROW(check_dome({10, 10, 6, 0}), Error);
  EXPECT_THROW(check_dome({1, 10, 6, 3}), Error);
  EXPECT_THROW(check_dome({500, 500, 60, 3}), Error);
  EXPECT_THROW(dome_near(3), Error);
}

TEST(BodyMesh, AnalyticBreastIsWellShaped) {
  BodyMeshReport report;
  const HexMesh mesh = body_mesh(analytic_breast(), {}, &report);
  EXPECT_EQ(mesh.elements(), 4000);
  EXPECT_GT(report.smoothed_scaled_jacobian, 0.6);
  EXPECT_GT(report.smoothed_scaled_jacobian, report.placed_scaled_jacobian);
  EXPECT_GT(mesh_quality(mesh, mesh.points).median_scaled_jacobian, 0.9);
  EXPECT_NEAR(report.mesh_volume / report.body_volume, 1, 0.01);
  expect_faces_cover_boundary(mesh);
}

/// Every border has about a quarter of the cut, also beyond the breast, and lies on its side of it.
TEST(CutBorder, IsThatOfTheNearestPlaceOfTheRim) {
  HexMesh mesh = body_mesh(analytic_breast(), {.size = dome_near(8)});
  for (const bool surrounded : {false, true}) {
    if (surrounded) add_surroundings(10, mesh);
    const std::vector<RimBorder> borders = cut_borders(mesh);
    ASSERT_EQ(borders.size(), mesh.cut_faces.size());
    std::array<int, n_rim_borders> count{};
    for (std::size_t f = 0; f < borders.size(); ++f) {
      ++count[std::size_t(borders[f])];
      Vec3 centre = Vec3::Zero();
      for (const int node : face_nodes(mesh, mesh.cut_faces[f])) centre += 0.25 * mesh.imaged[node];
      const bool along_x = borders[f] == RimBorder::medial || borders[f] == RimBorder::lateral;
      const bool positive = borders[f] == RimBorder::lateral || borders[f] == RimBorder::superior;
      EXPECT_EQ((along_x ? centre.x() : centre.z()) > 0, positive) << f;
    }
    for (const int faces : count)
      EXPECT_NEAR(double(faces) / double(borders.size()), 0.25, 0.08) << surrounded;
  }
  mesh.geometry.reset();
  EXPECT_TRUE(cut_borders(mesh).empty());
}

/// Nodes slide out of the tongue of a rim to better shaped elements and would leave the tongue to flat
/// faces: they are held there, and the mesh that was asked for is well shaped.
TEST(BodyMesh, NarrowPartOfTheBodyIsKept) {
  BreastGeometry geometry = analytic_breast();
  for (std::vector<Vec2>* rim : {&geometry.rim_skin, &geometry.rim_wall}) {
    for (Vec2& point : *rim) {
      const Vec2 way = point - geometry.centre;
      const double off = std::remainder(std::atan2(way.y(), way.x()) - 1.6, 2 * M_PI) / 0.4;
      point = geometry.centre + way * (0.6 + 0.45 * std::exp(-off * off));
    }
  }
  BodyMeshReport report;
  const HexMesh mesh = body_mesh(geometry, {.size = dome_near(8)}, &report);
  EXPECT_EQ(report.step, "");
  EXPECT_GT(report.smoothed_scaled_jacobian, 0.2);
  EXPECT_GT(report.mesh_volume / report.body_volume, 0.96);
}

TEST(BodyMesh, VolumeOfTheBodyIsThatOfTheFinestMesh) {
  BodyMeshReport coarse, fine;
  body_mesh(analytic_breast(), {.size = dome_near(8)}, &coarse);
  body_mesh(analytic_breast(), {.size = dome_near(24)}, &fine);
  EXPECT_NEAR(fine.mesh_volume / fine.body_volume, 1, 0.004);
  EXPECT_EQ(coarse.body_volume, fine.body_volume);
}

TEST(BodyMesh, CuboidIsNotFolded) {
  const HexMesh mesh = body_mesh(analytic_breast(), {.size = cuboid_size(16)});
  EXPECT_EQ(mesh.elements(), 4096);
  EXPECT_EQ(mesh.nodes(), 4913);
  EXPECT_GT(mesh_quality(mesh, mesh.points).min_scaled_jacobian, 0.04);
  expect_faces_cover_boundary(mesh);
}

TEST(CornerEnergy, SameWhateverTheThreads) {
  const DomeTemplate dome = dome_template(dome_near(21));  // large enough to be shared out
  const BreastGeometry geometry = analytic_breast();
  const std::vector<Vec3> x = place_nodes(dome, BodyMap(geometry)).x;
  ASSERT_GT(dome.connectivity.size() / 8, 8000u);
  CornerEnergy energy(dome.connectivity, x);
  std::vector<Vec3> one, two;
  set_threads(1);
  const double energy_one = energy.evaluate(x, one);
  set_threads(2);
  const double energy_two = energy.evaluate(x, two);
  set_threads(1);
  EXPECT_EQ(energy_one, energy_two);
  EXPECT_EQ(one, two);
}

TEST(BodyMesh, InsideOutSheetsAreRefused) {
  BreastGeometry geometry = analytic_breast();
  for (HermiteSheet* sheet : {&geometry.skin, &geometry.wall}) {
    for (auto& node : sheet->nodes) {
      for (Vec3* v : {&node.x, &node.x_1, &node.x_2, &node.x_12}) v->x() = -v->x();
    }
  }
  EXPECT_THROW(body_mesh(geometry, {}), Error);
}

TEST(BodyMesh, RimThatTurnsBackIsRefused) {
  BreastGeometry geometry = analytic_breast();
  std::swap(geometry.rim_skin[10], geometry.rim_skin[14]);
  EXPECT_THROW(body_mesh(geometry, {}), Error);
  geometry = analytic_breast();
  geometry.rim_wall.pop_back();
  EXPECT_THROW(body_mesh(geometry, {}), Error);
}

TEST(CornerEnergy, GradientMatchesDifferences) {
  const DomeTemplate dome = dome_template({4, 4, 2, 1});
  const BreastGeometry geometry = analytic_breast();
  std::vector<Vec3> x = place_nodes(dome, BodyMap(geometry)).x, gradient, unused;
  for (std::size_t a = 0; a < x.size(); ++a) {  // some corners folded
    x[a] += 6 * Vec3(std::sin(7.0 * a), std::cos(3.0 * a), std::sin(5.0 * a + 1));
  }
  CornerEnergy energy(dome.connectivity, x);
  for (const bool mid_edges : {false, true}) {
    energy.set({0.2, mid_edges ? 1 : 8, 0.5, mid_edges});
    energy.evaluate(x, gradient);
    double largest = 0;
    for (const Vec3& g : gradient) largest = std::max(largest, g.norm());
    for (std::size_t a = 0; a < x.size(); a += 11) {
      for (int d = 0; d < 3; ++d) {
        std::vector<Vec3> plus = x, minus = x;
        plus[a][d] += 1e-5;
        minus[a][d] -= 1e-5;
        const double slope =
            (energy.evaluate(plus, unused) - energy.evaluate(minus, unused)) / 2e-5;
        EXPECT_NEAR(slope, gradient[a][d], 1e-7 * largest + 1e-6 * std::abs(slope));
      }
    }
  }
}

TEST(SkinLayer, HasItsThicknessAndCoversTheSkin) {
  const double thickness = 1.45;
  BodyMeshReport report;
  const HexMesh mesh =
      body_mesh(analytic_breast(), {.size = {10, 10, 5, 3}, .skin_layer = thickness}, &report);
  expect_faces_cover_boundary(mesh);
  EXPECT_GT(report.smoothed_scaled_jacobian, 0.4);
  EXPECT_EQ(mesh.skin_model, SkinModel::layer);
  EXPECT_TRUE(mesh.skin_thickness.empty());
  std::size_t skin_elements = 0;
  double volume = 0, area = 0;
  const std::vector<double> volumes = element_volumes(mesh, mesh.points);
  for (int e = 0; e < mesh.elements(); ++e) {
    if (mesh.tissue[e] != Tissue::skin) continue;
    ++skin_elements;
    volume += volumes[e];
  }
  EXPECT_EQ(skin_elements, mesh.skin_faces.size());
  for (const Face& face : mesh.skin_faces) {
    EXPECT_EQ(mesh.tissue[face.element], Tissue::skin);
    std::array<Vec3, 4> c;
    for (int i = 0; i < 4; ++i) {
      c[i] = mesh.points[mesh.element(face.element)[hex_face_corners[face.local][i]]];
    }
    area += 0.5 * (c[2] - c[0]).cross(c[3] - c[1]).norm();
  }
  EXPECT_NEAR(volume / area, thickness, 0.06);
}

TEST(SkinLayer, CuboidKeepsItsCounts) {
  BodyMeshReport report;
  const HexMesh mesh =
      body_mesh(analytic_breast(), {.size = cuboid_size(16), .skin_layer = 1.45}, &report);
  EXPECT_EQ(mesh.elements(), 4096);
  EXPECT_EQ(mesh.nodes(), 4913);
  EXPECT_GT(report.smoothed_scaled_jacobian, 0.02);
  EXPECT_GT(mesh_quality(mesh, mesh.points).min_det, 0);
  // Under the middle of the skin's faces the layer is as thick as asked for.
  const int n = 16;
  const auto number = [&](int i, int j, int row) { return (row * (n + 1) + j) * (n + 1) + i; };
  for (int j = 3; j <= n - 3; ++j) {
    for (int i = 3; i <= n - 3; ++i) {
      EXPECT_NEAR((mesh.points[number(i, j, n)] - mesh.points[number(i, j, n - 1)]).norm(), 1.45,
                  0.05);
    }
  }
  for (const Face& face : mesh.skin_faces) EXPECT_EQ(mesh.tissue[face.element], Tissue::skin);
}

// A ball of gland in a box of fat, voxels of 1 mm, fractions exact at the voxel.
LabelVolume ball_of_gland(const Vec3& centre, double radius) {
  LabelVolume labels;
  labels.grid.size = {170, 150, 170};
  labels.grid.origin = Vec3(-85, -20, -85);
  labels.tissue.assign(labels.grid.voxels(), std::uint8_t(Tissue::fat));
  labels.fibroglandular_fraction.assign(labels.grid.voxels(), 0);
  for (int k = 0; k < 170; ++k) {
    for (int j = 0; j < 150; ++j) {
      for (int i = 0; i < 170; ++i) {
        const double depth = radius - (labels.grid.to_patient(Vec3(i, j, k)) - centre).norm();
        const std::size_t voxel = labels.grid.offset(i, j, k);
        labels.fibroglandular_fraction[voxel] = float(std::clamp(depth + 0.5, 0.0, 1.0));
        if (depth > 0) labels.tissue[voxel] = std::uint8_t(Tissue::fibroglandular);
      }
    }
  }
  return labels;
}

TEST(Tissue, FractionsOfABallAddUpToItsVolume) {
  const Vec3 centre(0, 45, 0);
  const double radius = 22, volume = 4.0 / 3 * std::numbers::pi * std::pow(radius, 3);
  HexMesh mesh = body_mesh(analytic_breast(), {});
  const TissueReport report = assign_tissue(ball_of_gland(centre, radius), mesh);
  EXPECT_NEAR(report.fibroglandular_volume / volume, 1, 0.02);
  EXPECT_NEAR(report.volume[int(Tissue::fibroglandular)] / volume, 1, 0.06);
  EXPECT_NEAR(report.outside_fraction, 0, 1e-12);
  for (int e = 0; e < mesh.elements(); ++e) {
    const double away = (element_position(mesh, mesh.points, e, Vec3::Zero()) - centre).norm();
    if (std::abs(away - radius) > 9) {
      EXPECT_EQ(mesh.tissue[e], away < radius ? Tissue::fibroglandular : Tissue::fat);
    }
  }
}

/// Ducts too thin to fill a third of any element still count with their volume.
TEST(Tissue, ThinDuctsKeepTheirVolume) {
  LabelVolume labels = ball_of_gland(Vec3(0, 45, 0), 30);
  for (int k = 0; k < 170; ++k) {
    for (int j = 0; j < 150; ++j) {
      for (int i = 0; i < 170; ++i) {
        if (i % 11 < 2) continue;
        labels.fibroglandular_fraction[labels.grid.offset(i, j, k)] = 0;
      }
    }
  }
  HexMesh mesh = body_mesh(analytic_breast(), {.size = dome_near(8)});
  const TissueReport report = assign_tissue(labels, mesh);
  EXPECT_NEAR(report.volume[int(Tissue::fibroglandular)] / report.fibroglandular_volume, 1, 0.1);
}

TEST(Tissue, WrongSideOrFrameIsRefused) {
  HexMesh mesh = body_mesh(analytic_breast(), {.size = dome_near(8)});
  LabelVolume labels = ball_of_gland(Vec3(0, 45, 0), 20);
  labels.grid.origin += Vec3(1000, 0, 0);
  EXPECT_THROW(assign_tissue(labels, mesh), Error);
  labels.grid.origin -= Vec3(1000, 0, 0);
  labels.side = Side::right;
  EXPECT_THROW(assign_tissue(labels, mesh), Error);
}

TEST(Tumour, AutomaticPointLiesOnTheEdgeOfTheGland) {
  const Vec3 centre(0, 45, 0);
  const LabelVolume labels = ball_of_gland(centre, 22);
  HexMesh coarse = body_mesh(analytic_breast(), {.size = dome_near(8)});
  HexMesh fine = body_mesh(analytic_breast(), {.size = dome_near(14)});
  const auto tumour = automatic_tumour(labels, fine);
  ASSERT_TRUE(tumour);
  EXPECT_NEAR((tumour->centre - centre).norm(), 22, 1.2);
  EXPECT_GT(tumour->centre.x(), 10);  // left breast: lateral is +x
  EXPECT_GT(tumour->centre.z(), 10);
  EXPECT_EQ(automatic_tumour(labels, coarse)->centre, tumour->centre);
  add_tumour(*tumour, coarse);
  add_tumour(*tumour, fine);
  for (const HexMesh* mesh : {&coarse, &fine}) {
    const Landmark* landmark = mesh->landmark("tumour");
    ASSERT_NE(landmark, nullptr);
    EXPECT_EQ(landmark->name, "artificial_tumour");  // nobody found it
    EXPECT_EQ(landmark->moved, 0);
    EXPECT_LT((landmark_position(*mesh, mesh->imaged, *landmark) - tumour->centre).norm(), 1e-9);
  }
}

/// Labels may call more tissue breast than the mesh holds, the gland's upper outer part included.
TEST(Tumour, AutomaticPointLiesInsideTheMeshWhateverTheLabels) {
  HexMesh mesh = body_mesh(analytic_breast(), {.size = dome_near(8)});
  const Locator locator(mesh, mesh.imaged);
  for (const Vec3& centre : {Vec3(45, 60, 45), Vec3(0, 80, 70), Vec3(60, 80, 0)}) {
    const auto tumour = automatic_tumour(ball_of_gland(centre, 25), mesh);
    ASSERT_TRUE(tumour) << centre.transpose();
    EXPECT_TRUE(locator.find(tumour->centre));
    for (int d = 0; d < 3; ++d) {
      for (const double step : {-2.0, 2.0})
        EXPECT_TRUE(locator.find(tumour->centre + step * Vec3::Unit(d))) << centre.transpose();
    }
    HexMesh with = mesh;
    EXPECT_NO_THROW(add_tumour(*tumour, with));
    EXPECT_EQ(with.landmarks.back().moved, 0);
  }
  EXPECT_FALSE(automatic_tumour(ball_of_gland(Vec3(75, 0, 75), 6), mesh)) << "all of it outside";
}

/// Labels in voxels of 2 mm whose skin and wall are those of the analytic breast, moved back by these
/// distances (mm). Beyond `wide` mm from the middle the body is not labelled breast.
LabelVolume labels_of_analytic_breast(double skin_back, double wall_back, double wide) {
  const AnalyticBreast shape;
  std::vector<Vec2> profile;  // (radius, depth) of the skin
  for (double arc = 0; arc <= shape.arc; arc += 0.5)
    profile.push_back(analytic::profile(shape, arc));
  const auto skin_depth = [&](double radius) {
    const auto past = std::find_if(profile.begin(), profile.end(),
                                   [&](const Vec2& at) { return at.x() >= radius; });
    return past == profile.end() ? profile.back().y() : past->y();
  };
  LabelVolume labels;
  labels.grid.size = {90, 90, 90};
  labels.grid.spacing = Vec3::Constant(2);
  labels.grid.origin = Vec3(-89, -20, -89);
  labels.tissue.assign(labels.grid.voxels(), std::uint8_t(Tissue::air));
  for (int k = 0; k < 90; ++k) {
    for (int j = 0; j < 90; ++j) {
      for (int i = 0; i < 90; ++i) {
        const Vec3 at = labels.grid.to_patient(Vec3(i, j, k));
        const double radius = std::hypot(at.x(), at.z());
        if (at.y() < skin_depth(radius) + skin_back) continue;
        const bool muscle = at.y() > analytic::wall_depth(shape, at.x()) + wall_back;
        labels.tissue[labels.grid.offset(i, j, k)] = std::uint8_t(muscle          ? Tissue::muscle
                                                                  : radius < wide ? Tissue::fat
                                                                                  : Tissue::other);
      }
    }
  }
  return labels;
}

TEST(Agreement, IsADistanceOfSurfacesWhereverTheLabelledBreastEnds) {
  const BreastGeometry geometry = analytic_breast();
  for (const double wide : {90.0, 60.0}) {
    const LabelVolume labels = labels_of_analytic_breast(0, 0, wide);
    const Agreement agreement = agreement_of(geometry, labels);
    EXPECT_LT(agreement.skin.distance.p95_mm, 1);
    EXPECT_LT(agreement.wall.distance.p95_mm, 1);
    EXPECT_GT(agreement.skin.seen, 0.99);
    EXPECT_FALSE(mismatch(agreement)) << *mismatch(agreement);
  }
}

TEST(Agreement, AnotherSkinOrWallIsAMismatchWithAPlace) {
  const BreastGeometry geometry = analytic_breast();
  const auto skin = mismatch(agreement_of(geometry, labels_of_analytic_breast(9, 0, 90)));
  ASSERT_TRUE(skin);
  EXPECT_NE(skin->find("its skin lies"), std::string::npos) << *skin;
  EXPECT_NE(skin->find("mm at ("), std::string::npos) << *skin;
  const Agreement moved = agreement_of(geometry, labels_of_analytic_breast(0, 10, 90));
  EXPECT_NEAR(moved.wall.distance.mean_mm, 9, 1.5);
  const auto wall = mismatch(moved);
  ASSERT_TRUE(wall);
  EXPECT_NE(wall->find("its chest wall lies"), std::string::npos) << *wall;
}

TEST(Agreement, AWallThatTheLabelsAreUnsureOfIsNoMeasure) {
  LabelVolume labels = labels_of_analytic_breast(0, 10, 90);
  labels.chest_wall_confidence.assign(labels.grid.voxels(), 0.2F);
  EXPECT_FALSE(mismatch(agreement_of(analytic_breast(), labels)));
}

TEST(Agreement, FlatFacesAreAWarning) {
  BodyMeshReport body;
  body.body_volume = 500e3;
  body.mesh_volume = 498e3;
  EXPECT_FALSE(too_coarse(body));
  body.mesh_volume = 450e3;
  ASSERT_TRUE(too_coarse(body));
  EXPECT_NE(too_coarse(body)->find("10.0 %"), std::string::npos) << *too_coarse(body);
}

TEST(Tumour, OneOfTheLabelsOrGivenIsNotCalledArtificial) {
  LabelVolume labels = ball_of_gland(Vec3(0, 45, 0), 22);
  labels.landmarks["tumour"] = Vec3(3, 45, 2);
  HexMesh marked = body_mesh(analytic_breast(), {.size = dome_near(8)}), given = marked;
  add_tumour(*automatic_tumour(labels, marked), marked);
  add_tumour(parse_tumour("5,45,3"), given);
  for (const HexMesh* mesh : {&marked, &given}) {
    ASSERT_NE(mesh->landmark("tumour"), nullptr);
    EXPECT_EQ(mesh->landmark("tumour")->name, "tumour");
    EXPECT_EQ(mesh->landmark("artificial_tumour"), nullptr);
  }
}

TEST(Tumour, BallBecomesTumourElements) {
  HexMesh mesh = body_mesh(analytic_breast(), {});
  const Tumour ball = parse_tumour("5,45,3:12");
  add_tumour(ball, mesh);
  const double volume = tissue_volumes(mesh)[int(Tissue::tumour)];
  EXPECT_NEAR(volume / (4.0 / 3 * std::numbers::pi * 12 * 12 * 12), 1, 0.15);
  EXPECT_THROW(add_tumour(parse_tumour("0,-300,0"), mesh), Error);
}

TEST(Tumour, TextIsParsedStrictly) {
  EXPECT_EQ(parse_tumour("1,-2.5,3").centre, Vec3(1, -2.5, 3));
  EXPECT_EQ(parse_tumour("1,-2.5,3:4").radius, 4);
  for (const char* bad : {"", "1,2", "1,2,3,4", "1,2,x", "1,2,3:", "1,2,3:-1", "nan,0,0"}) {
    EXPECT_THROW(parse_tumour(bad), Error) << bad;
  }
}

TEST(Nipple, IsTheClosestPointOfTheSkin) {
  HexMesh mesh = body_mesh(analytic_breast(), {});
  add_nipple(mesh);
  const Landmark* nipple = mesh.landmark("nipple");
  ASSERT_NE(nipple, nullptr);
  EXPECT_LT(nipple->moved, 0.8);
  EXPECT_LT((mesh.points[mesh.nipple_node] - mesh.geometry->nipple).norm(), 4);
}

TEST(Skin, MembraneOnSkinFacesOnly) {
  HexMesh mesh = body_mesh(analytic_breast(), {.size = dome_near(8)});
  set_membrane_skin(1.45, mesh);
  EXPECT_EQ(mesh.skin_thickness, std::vector<double>(mesh.skin_faces.size(), 1.45));
  set_membrane_skin(0, mesh);
  EXPECT_EQ(mesh.skin_model, SkinModel::none);
  EXPECT_TRUE(mesh.skin_thickness.empty());
  EXPECT_THROW(parse_skin_thickness("-1"), Error);
  EXPECT_THROW(parse_skin_thickness("thick"), Error);
}

}  // namespace
}  // namespace breast
