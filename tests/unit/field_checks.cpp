// SPDX-License-Identifier: GPL-3.0-or-later
// What is said about pressures and skin: filter, checkerboard, resultants, wrinkles.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "fem/membrane_kernel.hpp"
#include "fixtures/block.hpp"
#include "fixtures/laws.hpp"
#include "fixtures/pulled_skin.hpp"
#include "mechanics/pressure_filter.hpp"
#include "mechanics/skin_state.hpp"

namespace breast {
namespace {

HexMesh four_cubed(double distortion) {
  fixtures::BlockSettings settings;
  settings.distortion = distortion;
  return fixtures::block(settings);
}

TEST(PressureFilter, KeepsLinearPressures) {
  const HexMesh mesh = four_cubed(0.2);
  std::vector<double> pressure;
  for (int e = 0; e < mesh.elements(); ++e) {
    pressure.push_back(7 +
                       Vec3(3, -2, 5).dot(element_position(mesh, mesh.imaged, e, Vec3::Zero())));
  }
  const std::vector<double> filtered = filter_pressure(mesh, mesh.imaged, pressure);
  for (int e = 0; e < mesh.elements(); ++e) EXPECT_NEAR(filtered[e], pressure[e], 1e-4);
  EXPECT_LT(pressure_quality(mesh, mesh.imaged, pressure, filtered).at(Tissue::fat).checkerboard,
            1e-6);
}

TEST(PressureFilter, RemovesTheCheckerboard) {
  const HexMesh mesh = four_cubed(0);
  std::vector<double> smooth, pressure;
  for (int e = 0; e < mesh.elements(); ++e) {
    const int i = e % 4, j = e / 4 % 4, k = e / 16;
    smooth.push_back(10 * i);
    pressure.push_back(smooth.back() + ((i + j + k) % 2 ? 100 : -100));
  }
  const std::vector<double> filtered = filter_pressure(mesh, mesh.imaged, pressure);
  int left = 0;
  for (int e = 0; e < mesh.elements(); ++e) {
    const bool corner = (e % 4) % 3 == 0 && (e / 4 % 4) % 3 == 0 && (e / 16) % 3 == 0;
    EXPECT_NEAR(filtered[e], smooth[e], corner ? 26 : 1e-5);
    left += std::abs(filtered[e] - smooth[e]) > 1;
  }
  EXPECT_EQ(left, 8);  // a corner has one neighbour along each axis: a quarter stays there
  EXPECT_GT(pressure_quality(mesh, mesh.imaged, pressure, filtered).at(Tissue::fat).checkerboard,
            0.95);
}

// Tissues are not mixed: a jump between them is theirs.
TEST(PressureFilter, KeepsJumpsBetweenTissues) {
  HexMesh mesh = four_cubed(0);
  std::vector<double> pressure;
  for (int e = 0; e < mesh.elements(); ++e) {
    if (e % 4 > 1) mesh.tissue[e] = Tissue::tumour;
    pressure.push_back(e % 4 > 1 ? 900 : 100);
  }
  EXPECT_EQ(filter_pressure(mesh, mesh.imaged, pressure).size(), pressure.size());
  const std::vector<double> filtered = filter_pressure(mesh, mesh.imaged, pressure);
  for (int e = 0; e < mesh.elements(); ++e) EXPECT_NEAR(filtered[e], pressure[e], 1e-6);
}

// The resultant is the pull over the width λ^(−1/2) that is left.
TEST(Membrane, ResultantsOfUniaxialStretch) {
  for (const double stretch : {0.8, 1.3}) {
    for (const Law& law : every_law()) {
      const MembraneInput<4> in = fixtures::pulled_skin(law, stretch, 1.5);
      const double expected = 1.5 * fixtures::uniaxial_pull(law, stretch) * std::sqrt(stretch);
      const Vec2 found = membrane_resultants<4>(in);
      EXPECT_NEAR(found[stretch < 1 ? 0 : 1], expected, 1e-9 * std::abs(expected));
      EXPECT_NEAR(found[stretch < 1 ? 1 : 0], 0, 1e-9 * std::abs(expected));
    }
  }
}

// A block squeezed along x: its sides' skin is pressed; stiff and thick enough, it wrinkles over
// elements, and the paper's does not.
TEST(Skin, WrinklesWhenStiffAndThick) {
  fixtures::BlockSettings settings;
  settings.skin_mm = 1.45;
  HexMesh mesh = fixtures::block(settings);
  std::vector<Vec3> deformed;
  for (const Vec3& x : mesh.reference) {
    deformed.emplace_back(0.8 * x.x(), x.y() / std::sqrt(0.8), x.z() / std::sqrt(0.8));
  }
  MaterialSet set = load_materials("seed2008");
  SkinState state = skin_state(mesh, set, mesh.reference, deformed);
  EXPECT_EQ(state.faces, 5 * 16);
  EXPECT_EQ(state.compressed, 4 * 16);  // the far face is only pulled
  EXPECT_GT(state.compressed_share, 0.7);
  EXPECT_LT(state.least_resultant_N_per_m, 0);
  EXPECT_EQ(state.wrinkling, 0);
  scale_materials(set, {"skin=20000"});
  for (double& t : mesh.skin_thickness) t = 3;
  state = skin_state(mesh, set, mesh.reference, deformed);
  EXPECT_EQ(state.wrinkling, 4 * 16);
  EXPECT_GT(state.longest_wrinkle_mm, 40);
  EXPECT_EQ(skin_state(mesh, set, mesh.reference, mesh.reference).compressed, 0);
  // A plate presses on one side, and holds it flat.
  std::vector<double> pressure(mesh.reference.size(), 0);
  const double top = fixtures::BlockSettings{}.size.z();
  for (std::size_t n = 0; n < pressure.size(); ++n)
    if (mesh.reference[n].z() > top - 1e-6) pressure[n] = 1;
  state = skin_state(mesh, set, mesh.reference, deformed, pressure);
  EXPECT_EQ(state.compressed, 4 * 16);
  EXPECT_EQ(state.wrinkling, 3 * 16);
  // Under a stretch of 0.8 the weakest shear modulus of a neo-Hookean tissue is 0.8² times that at rest.
  for (const Tissue tissue : {Tissue::fat, Tissue::fibroglandular})
    set.laws[std::size_t(tissue)] = {"neo_hookean", {610}};
  state = skin_state(mesh, set, mesh.reference, deformed);
  const double shear = set.law(Tissue::fat).shear_modulus();
  EXPECT_NEAR(state.longest_wrinkle_mm * 0.64 * shear,
              std::numbers::pi * -1e3 * state.least_resultant_N_per_m, 1e-6 * shear);
}

// A groove across the top of a block, 25 mm wide: its slopes turn by twice the angle of each at the bottom.
TEST(Skin, FoldsWhereItTurnsInwardsSharply) {
  const HexMesh mesh = fixtures::block({});
  const auto groove = [&](double deep) {
    std::vector<Vec3> x = mesh.imaged;
    for (Vec3& p : x)
      if (p.z() > 99 && std::abs(p.x() - 50) < 1) p.z() -= deep;
    return skin_folds(mesh, x);
  };
  EXPECT_EQ(groove(0).edges, 0);
  EXPECT_EQ(groove(8).edges, 0);  // 35 degrees
  EXPECT_EQ(groove(20).edges, 4);
  EXPECT_NEAR(groove(20).sharpest_deg, 2 * std::atan2(20, 25) * 180 / std::numbers::pi, 1e-9);
  EXPECT_EQ(groove(-20).edges, 0);  // beside a ridge, 39 degrees
  EXPECT_EQ(groove(-30).edges, 8);
}

}  // namespace
}  // namespace breast
