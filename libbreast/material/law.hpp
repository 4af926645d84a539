// SPDX-License-Identifier: GPL-3.0-or-later
// Isotropic hyperelastic laws, defined by their first and second derivatives with respect to the
// invariants I1 and I2.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.hpp"

namespace breast {

struct Table;

/// W and its derivatives at (I1, I2), Pa.
struct LawValue {
  double w = 0, w1 = 0, w2 = 0, w11 = 0, w12 = 0, w22 = 0;
};

enum class LawKind { polynomial, exponential, neo_hookean, mooney_rivlin, yeoh };

/// One law with its constants (Pa, except b).
/// Constants of each law: polynomial (eq. 9): α10, α01, α20, α02, α11; exponential (eq. 10): a, b,
/// c; neo_hookean: α10 (= μ/2); mooney_rivlin: α10, α01; yeoh: c1, c2, c3 in (I1−3).
struct Law {
  LawKind kind = LawKind::neo_hookean;
  std::vector<double> constants;

  LawValue evaluate(double i1, double i2) const;
  /// False where the exponential would overflow (b(I1−3) > 50): such a trial step must be rejected.
  bool in_range(double i1) const;
  /// Small-strain shear modulus 2(W1+W2) at the identity, Pa.
  double shear_modulus() const;
  /// The law with all stiffness constants multiplied (b of the exponential is not a stiffness).
  Law scaled(double factor) const;
  std::string describe() const;
  bool operator==(const Law&) const = default;
};

/// "polynomial", "exponential", ...; throws Error (input) naming the choices.
LawKind law_kind_from_name(std::string_view name);
std::string_view law_kind_name(LawKind kind);
/// Names of Law::constants in order: {"a10", "a01", ...}.
std::vector<std::string_view> law_constant_names(LawKind kind);
/// Column of a constant in tables: its name with the unit, as in "a10_Pa"; b has no unit.
std::string law_constant_column(std::string_view constant);

/// Behaviour of thin skin in addition to its law: it wrinkles instead of resisting compression, and
/// is stretched even on the stress-free body. The defaults give the law alone, as in the paper.
struct SkinBehaviour {
  double kept = 1;          ///< fraction of the law that remains in compression; 1: all of it
  double smoothing = 0.02;  ///< half the width of the transition, in squared stretches
  double prestretch = 0;    ///< stretch of the skin in the stress-free shape of the body, minus 1
};
/// Throws Error (input) unless the fraction kept is 0.001 to 1, the smoothing 1e-4 to 0.5 and the
/// pre-stretch 0 to 0.5. Skin of which less than the whole law is kept in compression must also be
/// stretched enough at rest to lie beyond the transition: (1 + pre-stretch)² at least 1 + smoothing.
void check_skin(const SkinBehaviour& skin, const std::string& where);

/// Uncertainty left by the data from which a set was identified: covariance of the natural
/// logarithms of "low_order" (the constants of polynomial laws that are linear in the invariants),
/// "quadratic" (the others), "skin", "wall", "cut" and "sternum". Empty for published sets.
struct SoftnessUncertainty {
  std::vector<std::string> parameters;
  Eigen::MatrixXd covariance;  ///< parameters²
};

/// Law and density of every tissue, with skin behaviour, supports and uncertainty.
struct MaterialSet {
  std::string name;
  std::array<Law, n_tissues> laws;
  std::array<double, n_tissues> density;  ///< g/mm^3
  SkinBehaviour skin;
  /// Resistance to sliding at the chest wall and stiffness at the cut, kPa/mm, with which the set
  /// was identified; if absent, the wall is fixed and the cut free. Stiffness of an attachment to
  /// the sternum, which only pulls; if absent, there is none.
  std::optional<double> wall_support, cut_support, sternum_support;
  bool tissue_beyond = false;  ///< the cut carries the weight of the tissue beyond it
  SoftnessUncertainty uncertainty;
  const Law& law(Tissue t) const { return laws[static_cast<std::size_t>(t)]; }
  /// Whether two tissues have the same law and density.
  bool alike(Tissue a, Tissue b) const {
    return law(a) == law(b) && density[std::size_t(a)] == density[std::size_t(b)];
  }
};

/// The set with which a chain begins unless another one is given: the default of backward and of the
/// pipeline. All later stages take the model that is stated in their input.
inline constexpr const char* default_material_set = "invivo";

/// Named set (one of material_set_names()) or a TSV file of the same columns.
MaterialSet load_materials(const std::string& name_or_file);
/// The set in a table of these columns; errors begin with the table's name.
MaterialSet read_materials(const Table& table, const std::string& name);
/// The names of the embedded sets, in alphabetical order.
std::vector<std::string> material_set_names();
/// Applies "--scale fat=50" settings (per cent). Throws Error (input).
void scale_materials(MaterialSet& set, const std::vector<std::string>& settings);

}  // namespace breast
