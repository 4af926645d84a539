// SPDX-License-Identifier: GPL-3.0-or-later
// Isotropic hyperelastic laws, defined by their first and second derivatives with respect to the
// invariants I1 and I2. Every law is one file in material/laws, which declares all that the rest of
// the library knows about it; what a law does not declare is refused by name.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.hpp"

namespace breast {

/// W and its derivatives at (I1, I2), Pa.
struct LawValue {
  double w = 0, w1 = 0, w2 = 0, w11 = 0, w12 = 0, w22 = 0;
};

/// ∂(∂W/∂I1)/∂m and ∂(∂W/∂I2)/∂m of one parameter m.
struct LawSlope {
  double w1 = 0, w2 = 0;
};

/// How W depends on a constant. W is linear in all constants of the first two roles together.
enum class ConstantRole {
  low_order,  ///< a factor of terms whose expansion begins with I1 − 3 or I2 − 3
  quadratic,  ///< a factor of terms of higher order
  shape,      ///< W is not linear in it, so that it is no stiffness
};

struct ConstantKind {
  std::string_view name;
  std::string_view unit;  ///< "Pa", or empty for a number
  ConstantRole role;

  bool is_stiffness() const { return role != ConstantRole::shape; }
  /// Its column in tables: the name with the unit, as in "a10_Pa".
  std::string column() const;
};

/// How another program names a law and takes its constants: {NAME} stands for the value of a constant.
/// Empty where the program lacks the law.
struct LawExport {
  std::string_view type, body;
};

/// What a law declares. The constants c are in the order of `constants`; u = I1 − 3, v = I2 − 3.
struct LawKind {
  std::string_view name;
  std::vector<ConstantKind> constants;
  LawValue (*evaluate)(const double* c, double u, double v);
  /// False where the law is not defined or exceeds what can be computed: such a trial step must be
  /// rejected. Null: defined everywhere.
  bool (*defined)(const double* c, double u, double v);
  /// The derivative with respect to a constant of the role `shape`; null for a law without one.
  LawSlope (*shape_slope)(const double* c, std::size_t constant, double u, double v);
  /// Why these constants are impossible; empty if they are not. Null: any are possible that give a
  /// positive shear modulus.
  std::string (*refusal)(const double* c);
  /// The margin of constants that are proved to be elliptic wherever the law is defined: 1 if no constant
  /// acts against it, 0 at the bound. No value for constants that are not proved.
  std::optional<double> (*margin)(const double* c);
  LawExport calculix;  ///< and Abaqus; {D1}, {D2}, {D3} are the volumetric constants
  LawExport febio;
};

/// All laws, in the order of the columns of material tables.
const std::vector<const LawKind*>& law_kinds();
/// Throws Error (input) naming the choices.
const LawKind& law_kind(std::string_view name);

/// One law with its constants.
struct Law {
  const LawKind* kind;
  std::vector<double> constants;

  /// A neo-Hookean law that has no constants yet.
  Law();
  /// Throws Error (input) for an unknown name. The constants are not checked (see check_law).
  Law(std::string_view name, std::vector<double> values);

  LawValue evaluate(double i1, double i2) const {
    return kind->evaluate(constants.data(), i1 - 3, i2 - 3);
  }
  /// Whether the law can be evaluated there.
  bool in_range(double i1, double i2) const {
    return kind->defined == nullptr || kind->defined(constants.data(), i1 - 3, i2 - 3);
  }
  /// Small-strain shear modulus 2(W1+W2) at the identity, Pa.
  double shear_modulus() const;
  /// The law with all stiffness constants multiplied, and hence W.
  Law scaled(double factor) const;
  /// Derivative with respect to constants[index], per unit of it. Throws Error (input) for a constant
  /// whose derivative the law does not declare.
  LawSlope slope(std::size_t index, double i1, double i2) const;
  /// Derivative with respect to the logarithm of a factor on all stiffness constants, as in scaled.
  LawSlope scale_slope(double i1, double i2) const;
  /// "polynomial a10 310 Pa, a01 300 Pa, ..."
  std::string describe() const;
  bool operator==(const Law&) const = default;
};

}  // namespace breast
