// SPDX-License-Identifier: GPL-3.0-or-later
// Second Piola–Kirchhoff stress and material tangent, built once for every law from dW/dI1, dW/dI2.
#pragma once

#include <Eigen/Core>

#include "core/types.hpp"
#include "material/law.hpp"

namespace breast {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

/// In Voigt order 11, 22, 33, 12, 23, 13, with plain stresses and strains with doubled shear: δS =
/// tangent δE.
struct Stress {
  double energy = 0;  ///< Pa
  Vector6 s = Vector6::Zero();
  Matrix6 tangent = Matrix6::Zero();
};

Vector6 to_voigt(const Mat3& a);
Mat3 from_voigt(const Vector6& v);

/// W and its derivatives at C = FᵀF, with the invariants of C (plain) or of J^(−2/3) C (isochoric).
/// Returns false if the law is out of range.
bool law_stress(const Law& law, bool isochoric, const Mat3& c, double det_f, bool with_tangent,
                Stress& out);

/// Adds the constraint term −p (J − 1): energy, stress and tangent.
void add_pressure(double pressure, const Mat3& c, double det_f, bool with_tangent, Stress& out);

}  // namespace breast
