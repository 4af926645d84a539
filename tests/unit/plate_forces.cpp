// SPDX-License-Identifier: GPL-3.0-or-later
// How the forces of plates change while the plates move, against finite differences.
#include <gtest/gtest.h>

#include "contact/terms/friction.hpp"
#include "contact/terms/surface_pressure.hpp"
#include "fixtures/block.hpp"
#include "fixtures/wide_plates.hpp"
#include "mesh/nodal.hpp"

namespace breast {
namespace {

PlatePair plates_at(double paddle, double shift) {
  Plate plate = plate_facing(view_pose(Side::left, 0));
  plate.edge_start = -10 + shift;
  plate.far_edge = plate.half_width = 200;
  plate.edge_radius = 3;
  return fixtures::pair_at(plate, paddle, 60);
}

class PlateForces : public testing::Test {
 protected:
  PlateForces() : mesh_(fixtures::block({.elements = {2, 2, 2}, .size = Vec3(20, 20, 20)})) {
    x_ = flatten(mesh_.reference);
    for (long i = 0; i < x_.size(); ++i) x_[i] += 0.1 * fixtures::noise(int(i));
  }
  std::unique_ptr<SurfacePressure> pressure(double paddle, double shift) const {
    auto term = std::make_unique<SurfacePressure>(mesh_, mesh_.skin_faces, Discretisation{});
    term->set_stiffness(1e4);
    term->set_plates(plates_at(paddle, 0));
    term->choose_points(x_);
    term->set_plates(plates_at(paddle, shift));
    return term;
  }
  HexMesh mesh_;
  Eigen::VectorXd x_;
  static constexpr double level = -19.7, h = 1e-6;  // mm
};

TEST_F(PlateForces, OfFacesFollowAPlateAlongTheBeamAndAlongItsDepth) {
  const Eigen::VectorXd here = pressure(level, 0)->plate_forces(x_, 0);
  ASSERT_GT(here.norm(), 1e4);
  for (const bool along_beam : {true, false}) {
    const auto forces = [&](double by) {
      return pressure(level + (along_beam ? by : 0), along_beam ? 0 : by)->plate_forces(x_, 0);
    };
    const Eigen::VectorXd slope = (forces(h) - forces(-h)) / (2 * h);
    const PlatePair plates = plates_at(level, 0);
    const Vec3 velocity = along_beam ? plates.paddle.n : plates.paddle.anterior;
    const Eigen::VectorXd change =
        pressure(level, 0)->change_of_forces(x_, 0, nullptr, [&](int, const Gap& gap, const Vec3&) {
          return GapSlope{-gap.gradient.dot(velocity), -gap.hessian * velocity};
        });
    EXPECT_LT((change - slope).norm(), 1e-5 * slope.norm()) << along_beam;
  }
}

TEST_F(PlateForces, OfFacesFollowTheBody) {
  Eigen::VectorXd moved(x_.size());
  for (long i = 0; i < moved.size(); ++i) moved[i] = fixtures::noise(int(i) + 77);
  const std::unique_ptr<SurfacePressure> term = pressure(level, 0);
  const Eigen::VectorXd slope =
      (term->plate_forces(x_ + h * moved, 0) - term->plate_forces(x_ - h * moved, 0)) / (2 * h);
  const Eigen::VectorXd change = term->change_of_forces(
      x_, 0, &moved, [](int, const Gap&, const Vec3&) { return GapSlope{}; });
  EXPECT_LT((change - slope).norm(), 1e-5 * slope.norm());
}

// On a flat plate, whose normal stays; of nodes that stick and of nodes that slip.
TEST_F(PlateForces, OfFrictionFollowWhatHoldsTheNodes) {
  const Vec3 velocity(0.3, -0.8, 0);
  const auto friction = [&](double by) {
    FrictionTerm term;
    term.set_plates(fixtures::wide_plates(0, 20));
    std::vector<FrictionEntry> entries;
    for (int node = 0; node < mesh_.nodes(); ++node) {
      const Vec3 anchor = mesh_.reference[std::size_t(node)] + by * velocity;
      entries.push_back({node, 0, anchor, node % 2 == 0 ? 1e9 : 20, 1e3});
    }
    term.set_entries(entries);
    return term;
  };
  const auto forces = [&](double by) {
    const FrictionTerm term = friction(by);
    Eigen::VectorXd all = Eigen::VectorXd::Zero(x_.size());
    for (const FrictionEntry& entry : term.entries()) {
      all.segment<3>(3L * entry.node) += term.at(entry, x_).force;
    }
    return all;
  };
  const Eigen::VectorXd slope = (forces(h) - forces(-h)) / (2 * h);
  const Eigen::VectorXd change =
      friction(0).change_of_forces(x_, 0, [&](int, const Vec3&) { return velocity; });
  ASSERT_GT(slope.norm(), 1);
  EXPECT_LT((change - slope).norm(), 1e-5 * slope.norm());
}

}  // namespace
}  // namespace breast
