// SPDX-License-Identifier: GPL-3.0-or-later
// Element and membrane kernels against central differences.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "fem/hex_kernel.hpp"
#include "fem/membrane_kernel.hpp"
#include "fem/stress.hpp"
#include "fixtures/laws.hpp"
#include "fixtures/pulled_skin.hpp"
#include "mesh/shape.hpp"

namespace breast {
namespace {

double noise(int seed) {
  const double x = std::sin(12.9898 * seed + 78.233) * 43758.5453;
  return 2 * (x - std::floor(x)) - 1;
}

TEST(Stress, IsTheDerivativeOfEnergyAndTangentThatOfStress) {
  Mat3 f;
  f << 1.15, 0.2, -0.1, 0.05, 0.92, 0.12, 0.1, -0.15, 1.05;
  const Mat3 c = f.transpose() * f;
  const double h = 1e-6;
  for (const Law& law : every_law()) {
    for (const bool isochoric : {true, false}) {
      const auto at = [&](const Mat3& metric) {
        Stress s;
        const double j = std::sqrt(metric.determinant());
        EXPECT_TRUE(law_stress(law, isochoric, metric, j, true, s));
        add_pressure(700, metric, j, true, s);
        return s;
      };
      const Stress s = at(c);
      EXPECT_LT((s.tangent - s.tangent.transpose()).norm(), 1e-12 * s.tangent.norm());
      for (int k = 0; k < 6; ++k) {
        Vector6 e = Vector6::Zero();
        e[k] = k < 3 ? 1 : 0.5;  // shear strains are doubled
        const Mat3 direction = 2 * from_voigt(e);
        const Stress up = at(c + h * direction), down = at(c - h * direction);
        EXPECT_NEAR((up.energy - down.energy) / (2 * h), s.s[k], 1e-6 * s.s.norm());
        EXPECT_LT(((up.s - down.s) / (2 * h) - s.tangent.col(k)).norm(), 1e-6 * s.tangent.norm())
            << law.describe() << (isochoric ? " isochoric" : " plain");
      }
    }
  }
}

template <int N, int P>
HexInput<N, P> distorted_element(const Law& law, bool isochoric) {
  HexInput<N, P> in;
  for (int a = 0; a < N; ++a) {
    const Vec3 local = hex_node_local(N == 8 ? 1 : 2, a);
    for (int i = 0; i < 3; ++i) {
      in.reference(i, a) = 4 * local[i] + 0.5 * noise(3 * a + i);
      in.deformed(i, a) =
          in.reference(i, a) + 0.25 * noise(500 + 3 * a + i) + 0.1 * local[(i + 1) % 3];
    }
  }
  for (int k = 0; k < P; ++k) in.pressure[k] = 300 * noise(900 + k);
  for (int q = 0; q < HexRule<N>::points; ++q) {
    in.basis(0, q) = 1;
    for (int k = 1; k < P; ++k) in.basis(k, q) = HexRule<N>::get().local[q][k - 1];
  }
  in.law = &law;
  in.isochoric = isochoric;
  return in;
}

template <int N, int P>
void check_element(const Law& law, bool isochoric) {
  HexInput<N, P> in = distorted_element<N, P>(law, isochoric);
  auto base = std::make_unique<HexOutput<N, P>>(), up = std::make_unique<HexOutput<N, P>>(),
       down = std::make_unique<HexOutput<N, P>>();
  hex_kernel<N, P>(in, {true, true}, *base);
  ASSERT_TRUE(base->valid);
  EXPECT_LT((base->k - base->k.transpose()).norm(), 1e-12 * base->k.norm());
  const double h = 1e-5, k_scale = base->k.norm(), b_scale = base->b.norm();
  for (int a = 0; a < N; a += N == 8 ? 1 : 5) {
    for (int i = 0; i < 3; ++i) {
      for (const bool of_reference : {false, true}) {
        double& value = of_reference ? in.reference(i, a) : in.deformed(i, a);
        const double kept = value;
        value = kept + h;
        hex_kernel<N, P>(in, {}, *up);
        value = kept - h;
        hex_kernel<N, P>(in, {}, *down);
        value = kept;
        const Eigen::Matrix<double, 3, N> dr = (up->residual - down->residual) / (2 * h);
        const Eigen::Map<const Eigen::Matrix<double, 3 * N, 1>> column(dr.data());
        const Eigen::Matrix<double, P, 1> dt = (up->theta - down->theta) / (2 * h);
        const auto& matrix = of_reference ? base->k_x : base->k;
        const auto& rows = of_reference ? base->b_x : base->b;
        EXPECT_LT((column - matrix.col(3 * a + i)).norm(), 1e-6 * k_scale) << law.describe();
        EXPECT_LT((dt - rows.col(3 * a + i)).norm(), 1e-7 * b_scale);
        if (!of_reference) {
          EXPECT_NEAR((up->energy - down->energy) / (2 * h), base->residual(i, a),
                      1e-6 * base->residual.norm());
        }
      }
    }
  }
}

TEST(HexKernel, DerivativesOfEveryLaw) {
  for (const Law& law : every_law()) {
    for (const bool isochoric : {true, false}) {
      check_element<8, 1>(law, isochoric);
      check_element<27, 4>(law, isochoric);
    }
  }
}

TEST(HexKernel, RigidMotionIsStressFree) {
  HexInput<8, 1> in = distorted_element<8, 1>(every_law()[0], true);
  const Mat3 turn = Eigen::AngleAxisd(0.8, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  in.deformed = (turn * in.reference).colwise() + Vec3(3, -2, 5);
  in.pressure.setZero();
  HexOutput<8, 1> out;
  hex_kernel<8, 1>(in, {}, out);
  ASSERT_TRUE(out.valid);
  EXPECT_LT(out.residual.norm(), 1e-8);
  EXPECT_LT(out.theta.norm(), 1e-11);
}

TEST(HexKernel, RefusesAFoldedElementAndNaN) {
  HexInput<8, 1> in = distorted_element<8, 1>(every_law()[0], true);
  HexOutput<8, 1> out;
  in.deformed.col(0) = in.deformed.col(6);
  hex_kernel<8, 1>(in, {true, false}, out);
  EXPECT_FALSE(out.valid);
  in = distorted_element<8, 1>(every_law()[0], true);
  in.deformed(1, 3) = std::nan("");
  hex_kernel<8, 1>(in, {true, false}, out);
  EXPECT_FALSE(out.valid);
  in = distorted_element<8, 1>(every_law()[0], true);
  in.pressure[0] = std::nan("");
  hex_kernel<8, 1>(in, {true, false}, out);
  EXPECT_FALSE(out.valid);
}

template <int N>
MembraneInput<N> curved_face(const Law& law) {
  MembraneInput<N> in;
  for (int a = 0; a < N; ++a) {
    const Vec3 local = hex_node_local(2, N == 4 ? a : (a < 4 ? a : a < 8 ? a + 4 : 24));
    in.reference.col(a) = Vec3(4 * local[0] + 0.4 * noise(a), 4 * local[1] + 0.4 * noise(a + 50),
                               0.5 * noise(a + 90));
    in.deformed.col(a) = in.reference.col(a) +
                         0.4 * Vec3(noise(a + 130), noise(a + 170), 2 * noise(a + 210)) +
                         Vec3(0.5 * local[1], 0.2 * local[0], 0);
  }
  in.volume.setConstant(1.45 * 7);
  in.law = &law;
  return in;
}

template <int N>
void check_face(const Law& law, const SkinBehaviour& skin = {}, const Vec2& stretch = Vec2(1, 1)) {
  MembraneInput<N> in = curved_face<N>(law);
  in.skin = skin;
  in.deformed.row(0) *= stretch.x();
  in.deformed.row(1) *= stretch.y();
  MembraneOutput<N> base, up, down;
  membrane_kernel<N>(in, {true, true}, base);
  ASSERT_TRUE(base.valid);
  EXPECT_LT((base.k - base.k.transpose()).norm(), 1e-12 * base.k.norm());
  const double h = 1e-5;
  for (int a = 0; a < N; ++a) {
    for (int i = 0; i < 3; ++i) {
      for (const bool of_reference : {false, true}) {
        double& value = of_reference ? in.reference(i, a) : in.deformed(i, a);
        const double kept = value;
        value = kept + h;
        membrane_kernel<N>(in, {}, up);
        value = kept - h;
        membrane_kernel<N>(in, {}, down);
        value = kept;
        const Eigen::Matrix<double, 3, N> dr = (up.residual - down.residual) / (2 * h);
        const Eigen::Map<const Eigen::Matrix<double, 3 * N, 1>> column(dr.data());
        const auto& matrix = of_reference ? base.k_x : base.k;
        EXPECT_LT((column - matrix.col(3 * a + i)).norm(), 1e-6 * base.k.norm()) << law.describe();
        if (!of_reference) {
          EXPECT_NEAR((up.energy - down.energy) / (2 * h), base.residual(i, a),
                      1e-6 * base.residual.norm());
        }
      }
    }
  }
}

TEST(MembraneKernel, DerivativesOfEveryLaw) {
  for (const Law& law : every_law()) {
    check_face<4>(law);
    check_face<9>(law);
  }
}

// Pressed, sheared and pulled skin: all branches of the tension field, and its transitions.
TEST(MembraneKernel, DerivativesOfATensionField) {
  for (const Law& law : every_law()) {
    for (const double across : {0.7, 0.9, 0.95, 0.97, 1.05}) {
      for (const double along : {0.8, 0.96, 1.0, 1.1}) {
        check_face<4>(law, {0.05, 0.02, 0.03}, Vec2(along, across));
        check_face<9>(law, {0.05, 0.02, 0.03}, Vec2(along, across));
      }
    }
  }
}

// Skin pressed in one direction and pulled in the other carries the force of uniaxial tension.
TEST(MembraneKernel, WrinkledSkinIsInUniaxialTension) {
  const double stretch = 1.2, kept = 0.01;
  for (const Law& law : every_law()) {
    MembraneInput<4> in = fixtures::pulled_skin(law, stretch, 2);
    in.skin = {kept, 0.02, 0};
    in.deformed.row(1) *= 0.8;
    MembraneOutput<4> out;
    membrane_kernel<4>(in, {}, out);
    ASSERT_TRUE(out.valid);
    const double force = 2 * fixtures::uniaxial_pull(law, stretch);
    EXPECT_NEAR(out.residual(0, 1) + out.residual(0, 2), force, 2 * kept * std::abs(force));
  }
}

// The skin's own shape at rest is the body's, smaller by the pre-stretch.
TEST(MembraneKernel, PreStretchedSkinPullsAtRest) {
  const double prestretch = 0.2;
  for (const Law& law : every_law()) {
    MembraneInput<4> in = fixtures::pulled_skin(law, 1, 2), same = in;
    in.skin.prestretch = prestretch;
    same.reference /= 1 + prestretch;
    MembraneOutput<4> out, expected;
    membrane_kernel<4>(in, {}, out);
    membrane_kernel<4>(same, {}, expected);
    EXPECT_GT(out.residual(0, 1), 0);
    EXPECT_LT((out.residual - expected.residual).norm(), 1e-12 * out.residual.norm());
  }
}

TEST(MembraneKernel, UniaxialTension) {
  const double stretch = 1.2;
  for (const Law& law : every_law()) {
    const MembraneInput<4> in = fixtures::pulled_skin(law, stretch, 2);
    MembraneOutput<4> out;
    membrane_kernel<4>(in, {}, out);
    ASSERT_TRUE(out.valid);
    const double force = 2 * fixtures::uniaxial_pull(law, stretch);
    EXPECT_NEAR(out.residual(0, 1) + out.residual(0, 2), force, 1e-10 * std::abs(force));
    EXPECT_NEAR(out.residual(1, 2) + out.residual(1, 3), 0, 1e-10 * std::abs(force));
  }
}

}  // namespace
}  // namespace breast
