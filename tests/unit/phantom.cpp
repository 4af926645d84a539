// SPDX-License-Identifier: GPL-3.0-or-later
// The phantom's parts without mechanics: template, gland, imaging, labels, coil and noise.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "fixtures/small_phantom.hpp"
#include "mechanics/supports/support.hpp"
#include "mesh/quality.hpp"
#include "phantom/chest/rib_spline.hpp"
#include "phantom/chest/rib_surface.hpp"
#include "phantom/random.hpp"
#include "phantom/scanner.hpp"

using namespace breast;

namespace {

const PhantomScene& scene() {
  static const PhantomScene made(small_phantom());
  return made;
}
const PhantomImage& image() {
  static const PhantomImage made = image_scene(scene());
  return made;
}

struct Moments {
  double sum = 0, squares = 0, count = 0;
  void add(double x) { sum += x, squares += x * x, ++count; }
  double mean() const { return sum / count; }
  double deviation() const { return std::sqrt(squares / count - mean() * mean()); }
};

}  // namespace

TEST(PhantomRandom, NormalNumbersHaveUnitVarianceAndNoCorrelation) {
  Moments first, second;
  double product = 0;
  constexpr int n = 40000;
  for (int i = 0; i < n; ++i) {
    const Vec2 pair = normal_pair(7, i);
    first.add(pair.x()), second.add(pair.y());
    product += pair.x() * pair.y();
  }
  EXPECT_NEAR(first.mean(), 0, 0.02);
  EXPECT_NEAR(first.deviation(), 1, 0.02);
  EXPECT_NEAR(second.deviation(), 1, 0.02);
  EXPECT_NEAR(product / n, 0, 0.02);
}

TEST(PhantomTemplate, EveryPresetGivesRoundElementsOnSkinAndWall) {
  for (const std::string& preset : preset_names()) {
    for (Side side : {Side::left, Side::right}) {
      PhantomParameters p = phantom_preset(preset, 3);
      p.mesh = coarse_mesh(p);
      const Torso torso(p.torso, 1);
      const BreastShape shape(p, torso, side);
      const MeridianMap map(shape);
      const HexMesh mesh = phantom_mesh(shape, map, p.mesh);
      const MeshQuality quality = mesh_quality(mesh, mesh.points);
      EXPECT_GT(quality.min_det, 0) << preset;
      EXPECT_GT(quality.min_scaled_jacobian, 0.35) << preset;
      for (int node : nodes_of(mesh, mesh.skin_faces))
        EXPECT_NEAR(shape.skin_distance(mesh.points[node]), 0, 1e-3) << preset;
      for (int node : nodes_of(mesh, mesh.pectoral_faces))
        EXPECT_NEAR(torso.wall_distance(mesh.points[node]), 0, 1e-3) << preset;
      EXPECT_EQ(mesh.skin_faces.size() + mesh.pectoral_faces.size() + mesh.cut_faces.size(),
                boundary_faces(mesh).size());
    }
  }
}

TEST(RibSurface, DerivativesAreThoseOfTheValueAndItIsTheTorsosWall) {
  for (const double power : {2.0, 2.4}) {
    TorsoParameters torso;
    torso.power = power, torso.sternal_groove = 0;
    const RibSurface ribs(torso);
    const Torso body(torso, 1);
    for (const Vec3& x : {Vec3(70, 8, 10), Vec3(-120, 40, -60), Vec3(20, -50, 70)}) {
      const auto here = ribs.at(x);
      ASSERT_TRUE(here);
      constexpr double h = 1e-4;
      for (int a = 0; a < 3; ++a) {
        const auto up = ribs.at(x + h * Vec3::Unit(a)), down = ribs.at(x - h * Vec3::Unit(a));
        EXPECT_NEAR((up->value - down->value) / (2 * h), here->gradient[a], 1e-7);
        EXPECT_LT(((up->gradient - down->gradient) / (2 * h) - here->hessian.col(a)).norm(), 1e-7);
      }
    }
    const Vec3 foot = body.wall_point(60, 20);
    EXPECT_NEAR(ribs.at(foot)->value, 0, 1e-9);
    EXPECT_FALSE(ribs.at(Vec3(0, torso.half_depth, 0)));
  }
  TorsoParameters sharp;
  sharp.power = 1.8;
  EXPECT_THROW(RibSurface{sharp}, Error);
}

TEST(RibSpline, IsTheRibSurfaceWhereBreastsSlide) {
  for (const char* preset : {"average", "slim", "broad", "heavy"}) {
    const TorsoParameters torso = phantom_preset(preset, 1).torso;
    const RibSurface ribs(torso);
    const ThoraxSurface spline = rib_spline(torso);
    for (double angle = -2.9; angle < 2.95; angle += 0.237) {
      for (double height = -290; height < 291; height += 47.3) {
        const Vec3 x = spline.point(angle, height);
        ASSERT_TRUE(spline.at(x) && ribs.at(x));
        EXPECT_NEAR(ribs.at(x)->value, 0, 1e-4) << preset << " " << angle << " " << height;
        const Vec3 a = ribs.at(x)->gradient.normalized(), b = spline.at(x)->gradient.normalized();
        EXPECT_NEAR((a - b).norm(), 0, 1e-4) << preset << " " << angle << " " << height;
      }
    }
  }
  TorsoParameters sharp;
  sharp.power = 1.5;
  EXPECT_THROW(rib_spline(sharp), Error);
  TorsoParameters steep;
  steep.power = 2;
  steep.bend = 5e-3;  // 300 mm up the ribs are no longer about the axis
  EXPECT_THROW(rib_spline(steep), Error);
}

// Only the ring of fat behind the fold is longer at the side; what the image shows and where
// landmarks lie does not depend on it.
TEST(PhantomBreast, ABodyThatSlidesGoesOnPastTheCutOfTheImage) {
  PhantomParameters p = phantom_preset("heavy", 1);
  p.mesh = coarse_mesh(p);
  const Torso torso(p.torso, 1);
  const PhantomBreast breast(p, torso, Side::right);
  ASSERT_TRUE(breast.seen);
  const std::vector<Vec3>&body = breast.mesh.points, &seen = breast.seen->points;
  ASSERT_EQ(body.size(), seen.size());
  double farthest = 0;
  for (std::size_t n = 0; n < body.size(); ++n) {
    if (body[n] == seen[n]) continue;
    farthest = std::max(farthest, (body[n] - seen[n]).norm());
    EXPECT_GT(breast.shape.beyond_fold(seen[n], 0.0), -1e-6);
  }
  // Least at the skin, most at the wall, which falls away.
  EXPECT_GT(farthest, p.body.beyond);
  EXPECT_LT(farthest, 2 * p.body.beyond);
  p.body.beyond = 0;
  const PhantomBreast narrow(p, torso, Side::right);
  EXPECT_FALSE(narrow.seen);
  EXPECT_EQ(&narrow.imaged_mesh(), &narrow.mesh);
  EXPECT_EQ(narrow.mesh.points, seen);
  for (std::size_t k = 0; k < breast.mesh.landmarks.size(); ++k)
    EXPECT_EQ(breast.mesh.landmarks[k].imaged, narrow.mesh.landmarks[k].imaged);
}

TEST(BodyMaterials, ASlidingBreastNeedsSupportsAndTheyAreScaled) {
  BodyParameters body;
  body.materials = "phantom2026", body.slides = true, body.wall_percent = 120,
  body.cut_percent = 50;
  body.scale = {"fat=90"};
  const MaterialSet set = body_materials(body), plain = load_materials("phantom2026");
  EXPECT_EQ(set.wall, wall_support(plain.wall)->stiffened(1.2)->text());
  EXPECT_EQ(set.cut, cut_support(plain.cut)->stiffened(0.5)->text());
  EXPECT_EQ(set.uncertainty.parameters.size(), 5u) << "band-truth draws bodies from it";
  EXPECT_NEAR(set.law(Tissue::fat).shear_modulus(), 0.9 * plain.law(Tissue::fat).shear_modulus(),
              1e-9);
  body.materials = "seed2008";
  EXPECT_THROW(body_materials(body), Error);
}

TEST(PhantomTemplate, RefinementKeepsTheVolume) {
  const PhantomBreast& breast = scene().breast(Side::left);
  const HexMesh fine = phantom_mesh(breast.shape, breast.map, {8, 4, 2, 2, 5, 2});
  const double coarse_ml = mesh_volume(breast.mesh, breast.mesh.points);
  EXPECT_NEAR(coarse_ml / mesh_volume(fine, fine.points), 1, 0.005);
}

TEST(PhantomGland, FillsTheWantedShareAndReachesTheNipple) {
  const PhantomBreast& breast = scene().breast(Side::left);
  double inside = 0, all = 0;
  const HexMesh& mesh = breast.mesh;
  const std::vector<double> volumes = element_volumes(mesh, mesh.points);
  for (int e = 0; e < mesh.elements(); ++e) {
    inside += volumes[e] * mesh.fibroglandular_fraction[e];
    all += volumes[e];
  }
  EXPECT_NEAR(inside / mm3_per_ml, breast.gland.volume_ml(), 0.06 * breast.gland.volume_ml());
  EXPECT_GT(inside / all, 0.10);
  EXPECT_LT(inside / all, 0.26);
  EXPECT_LT(breast.gland.distance(breast.shape.apex() - 5 * breast.shape.axis()), 0);
  const Landmark& tumour = *mesh.landmark("tumour");
  EXPECT_LT(std::abs(breast.gland.distance(tumour.imaged)), 0.5);
}

TEST(PhantomImage, DoesNotDependOnThreads) {
  const int before = threads();
  set_threads(1);
  const PhantomImage one = image_scene(scene());
  const Volume<std::int16_t> scan_one = scan(one, scene().parameters.mri, 5);
  set_threads(2);
  const PhantomImage two = image_scene(scene());
  const Volume<std::int16_t> scan_two = scan(two, scene().parameters.mri, 5);
  set_threads(before);
  EXPECT_EQ(one.signal.voxels, two.signal.voxels);
  EXPECT_EQ(one.tissue, two.tissue);
  EXPECT_EQ(scan_one.voxels, scan_two.voxels);
}

TEST(PhantomImage, SeedsGiveDifferentBreasts) {
  const PhantomParameters a = small_phantom(1), b = small_phantom(1), c = small_phantom(2);
  EXPECT_EQ(a.left.height, b.left.height);
  EXPECT_NE(a.left.height, c.left.height);
  EXPECT_NE(a.left.height, a.right.height);
}

TEST(PhantomImage, SignalAgreesWithLabels) {
  Moments fat, gland, muscle, air;
  const PhantomImage& made = image();
  for (std::size_t n = 0; n < made.tissue.size(); ++n) {
    const double signal = made.signal.voxels[n];
    switch (Tissue(made.tissue[n])) {
      case Tissue::fat:
        fat.add(signal);
        break;
      case Tissue::fibroglandular:
        gland.add(signal);
        break;
      case Tissue::muscle:
        muscle.add(signal);
        break;
      case Tissue::air:
        air.add(signal);
        break;
      default:
        break;
    }
  }
  EXPECT_GT(fat.mean(), 800);
  EXPECT_LT(gland.mean(), 600);
  EXPECT_LT(muscle.mean(), 350);
  EXPECT_LT(air.mean(), 15);
  EXPECT_GT(gland.count, 100);
}

TEST(PhantomImage, LabelsHoldTheVolumeOfTheMesh) {
  for (Side side : {Side::left, Side::right}) {
    const LabelVolume labels = true_labels(scene(), image(), side);
    double breast_voxels = 0;
    for (std::uint8_t tissue : labels.tissue)
      if (tissue >= 1 && tissue <= 3) ++breast_voxels;
    const HexMesh& mesh = scene().breast(side).mesh;
    const double expected = mesh_volume(mesh, mesh.points);
    EXPECT_NEAR(breast_voxels * labels.grid.voxel_volume() / expected, 1, 0.04);
    EXPECT_EQ(labels.side, side);
    const Vec3 at = labels.grid.to_index(labels.landmarks.at("tumour"));
    const int i = int(std::lround(at.x())), j = int(std::lround(at.y())),
              k = int(std::lround(at.z()));
    ASSERT_TRUE(labels.grid.contains(i, j, k));
    EXPECT_TRUE(labels.at(i, j, k) == Tissue::fat || labels.at(i, j, k) == Tissue::fibroglandular);
  }
}

TEST(PhantomScanner, NoiseIsRicianInAirAndGaussianInFat) {
  MriParameters mri = scene().parameters.mri;
  mri.noise_percent = 3;
  mri.bias = 1;
  const Volume<std::int16_t> noisy = scan(image(), mri, 9);
  mri.noise_percent = 0;
  const Volume<std::int16_t> clean = scan(image(), mri, 9);
  Moments air, fat;
  for (std::size_t n = 0; n < noisy.voxels.size(); ++n) {
    if (image().signal.voxels[n] == 0) air.add(noisy.voxels[n]);
    if (image().signal.voxels[n] > 900) fat.add(noisy.voxels[n] - clean.voxels[n]);
  }
  const double sigma = 30;
  EXPECT_NEAR(air.mean(), sigma * std::sqrt(M_PI / 2), 0.3);
  EXPECT_NEAR(air.deviation(), sigma * std::sqrt(2 - M_PI / 2), 0.3);
  EXPECT_NEAR(fat.deviation(), sigma, 0.6);
}

TEST(PhantomScanner, BiasSpansTheFactorAskedFor) {
  for (double bias : {1.0, 2.0, 5.0}) {
    const Volume<float> field = coil_sensitivity(image(), bias, 3);
    double low = 1e9, high = 0;
    for (std::size_t n = 0; n < field.voxels.size(); ++n) {
      if (image().side[n] == 0 || image().tissue[n] != std::uint8_t(Tissue::fat)) continue;
      low = std::min<double>(low, field.voxels[n]), high = std::max<double>(high, field.voxels[n]);
    }
    EXPECT_GE(high / low, 0.999 * bias);
    EXPECT_LE(high / low, 1.6 * bias);
  }
}

TEST(PhantomContrast, SaturationLeavesMuscleAsBrightAsAsked) {
  const WaterFat muscle = matter_water_fat(Matter::muscle), fat = matter_water_fat(Matter::fat);
  EXPECT_NEAR(fat.in_phase(), 1000, 1e-9);
  for (const double ratio : {1.0, 1.4, 4.0}) {
    const double left = fat_left(ratio);
    EXPECT_NEAR((muscle.water + left * muscle.fat) / (fat.water + left * fat.fat), ratio, 1e-9);
  }
  EXPECT_THROW(fat_left(0.5), Error);
  EXPECT_THROW(fat_left(20), Error) << "water in fat alone is brighter";
}

TEST(PhantomContrast, WaterAndFatAddUpAndAreExchangedInTheShareAskedFor) {
  const PhantomImage parts = image_scene(scene(), no_progress(), {}, true);
  EXPECT_EQ(parts.tissue, image().tissue);
  const Volume<float> failing = failing_region(parts.signal, 0.1, 3);
  const SignalImages shown = exchanged(parts.parts, failing);
  double body = 0, exchanged_in = 0;
  for (std::size_t n = 0; n < parts.signal.voxels.size(); ++n) {
    const float water = parts.parts.water.voxels[n], fat = parts.parts.fat.voxels[n];
    ASSERT_NEAR(water + fat, parts.signal.voxels[n], 1e-3);
    ASSERT_NEAR(shown.water.voxels[n] + shown.fat.voxels[n], water + fat, 1e-3);
    body += parts.signal.voxels[n] > 0;
    exchanged_in += shown.water.voxels[n] != water;
  }
  EXPECT_NEAR(exchanged_in / body, 0.1, 0.01);
  // The coil and the texture of tissue are common to both images, their noise is not.
  MriParameters mri = small_phantom().mri;
  mri.noise_percent = 0;
  const DixonScan dixon = dixon_scan(parts, mri, {}, 1);
  const Volume<std::int16_t> sum = scan(parts, mri, 1);
  for (std::size_t n = 0; n < sum.voxels.size(); ++n)
    ASSERT_NEAR(dixon.water.voxels[n] + dixon.fat.voxels[n], sum.voxels[n], 2);
}

TEST(PhantomParametersTest, RefusesWhatItCannotMake) {
  EXPECT_THROW(phantom_preset("huge", 1), Error);
  PhantomParameters p = small_phantom();
  p.gland.fraction = 0.9;
  EXPECT_THROW(PhantomScene{p}, Error);
  p = small_phantom();
  p.mesh.core = 3;
  EXPECT_THROW(PhantomScene{p}, Error);
  p = small_phantom();
  p.left.centre_x = p.right.centre_x = 40;
  EXPECT_THROW(PhantomScene{p}, Error);
  EXPECT_THROW(coil_sensitivity(image(), 0.5, 1), Error);
  MriParameters mri;
  mri.voxel_factor = std::nan("");
  EXPECT_THROW(phantom_grid(mri), Error);
}
