// SPDX-License-Identifier: GPL-3.0-or-later
#include "fem/stress.hpp"

#include <Eigen/LU>
#include <cmath>

#include "fem/voigt.hpp"

namespace breast {

namespace {

// (a ⊙ a)_{IJKL} = ½ (a_IK a_JL + a_IL a_JK) in Voigt form.
Matrix6 self_product(const Mat3& a) {
  Matrix6 out;
  for (int r = 0; r < 6; ++r) {
    for (int c = r; c < 6; ++c) {
      const int i = voigt_row[r], j = voigt_column[r], k = voigt_row[c], l = voigt_column[c];
      out(r, c) = 0.5 * (a(i, k) * a(j, l) + a(i, l) * a(j, k));
      out(c, r) = out(r, c);
    }
  }
  return out;
}

Matrix6 symmetric_product(const Vector6& a, const Vector6& b) {
  const Matrix6 ab = a * b.transpose();
  return ab + ab.transpose();
}

const Vector6 identity = (Vector6() << 1, 1, 1, 0, 0, 0).finished();

// I ⊗ I − 𝕀: second derivative of I2 with respect to C.
Matrix6 second_of_i2() {
  Matrix6 out = identity * identity.transpose();
  out.diagonal() -= (Vector6() << 1, 1, 1, 0.5, 0.5, 0.5).finished();
  return out;
}

// Derivatives of the two invariants a law sees with respect to C.
struct Invariants {
  double i1, i2;
  Vector6 d1, d2;
  Matrix6 d11, d22;
};

Invariants plain_invariants(const Mat3& c, const Vector6& cv) {
  Invariants out;
  out.i1 = c.trace();
  out.i2 = 0.5 * (out.i1 * out.i1 - c.squaredNorm());
  out.d1 = identity;
  out.d2 = out.i1 * identity - cv;
  out.d11.setZero();
  out.d22 = second_of_i2();
  return out;
}

// Ī1 = J^(−2/3) I1, Ī2 = J^(−4/3) I2.
Invariants isochoric_invariants(const Mat3& c, const Vector6& cv, double det_f, bool with_tangent) {
  const Mat3 inverse = c.inverse();
  const Vector6 ci = to_voigt(inverse);
  const double i1 = c.trace(), i2 = 0.5 * (i1 * i1 - c.squaredNorm());
  const double scale1 = 1 / std::cbrt(det_f * det_f), scale2 = scale1 * scale1;
  const Vector6 t = i1 * identity - cv;
  Invariants out;
  out.i1 = scale1 * i1;
  out.i2 = scale2 * i2;
  out.d1 = scale1 * (identity - i1 / 3 * ci);
  out.d2 = scale2 * (t - 2 * i2 / 3 * ci);
  if (!with_tangent) return out;
  const Matrix6 cc = ci * ci.transpose(), square = self_product(inverse);
  out.d11 = scale1 * (-symmetric_product(identity, ci) / 3 + i1 / 9 * cc + i1 / 3 * square);
  out.d22 = scale2 * (second_of_i2() - 2.0 / 3 * symmetric_product(t, ci) + 4 * i2 / 9 * cc +
                      2 * i2 / 3 * square);
  return out;
}

}  // namespace

Vector6 to_voigt(const Mat3& a) {
  Vector6 v;
  for (int r = 0; r < 6; ++r) v[r] = a(voigt_row[r], voigt_column[r]);
  return v;
}

Mat3 from_voigt(const Vector6& v) {
  Mat3 a;
  for (int r = 0; r < 6; ++r) {
    const int i = voigt_row[r], j = voigt_column[r];
    a(i, j) = a(j, i) = v[r];
  }
  return a;
}

bool law_stress(const Law& law, bool isochoric, const Mat3& c, double det_f, bool with_tangent,
                Stress& out) {
  const Vector6 cv = to_voigt(c);
  const Invariants i =
      isochoric ? isochoric_invariants(c, cv, det_f, with_tangent) : plain_invariants(c, cv);
  if (!law.in_range(i.i1, i.i2)) return false;
  const LawValue w = law.evaluate(i.i1, i.i2);
  out.energy = w.w;
  out.s = 2 * (w.w1 * i.d1 + w.w2 * i.d2);
  if (with_tangent) {
    out.tangent = 4 * (w.w1 * i.d11 + w.w2 * i.d22 + w.w11 * (i.d1 * i.d1.transpose()) +
                       w.w12 * symmetric_product(i.d1, i.d2) + w.w22 * (i.d2 * i.d2.transpose()));
  }
  return true;
}

void add_pressure(double pressure, const Mat3& c, double det_f, bool with_tangent, Stress& out) {
  const Mat3 inverse = c.inverse();
  const Vector6 ci = to_voigt(inverse);
  const double pj = pressure * det_f;
  out.energy -= pressure * (det_f - 1);
  out.s -= pj * ci;
  if (with_tangent) out.tangent -= pj * (ci * ci.transpose() - 2 * self_product(inverse));
}

}  // namespace breast
