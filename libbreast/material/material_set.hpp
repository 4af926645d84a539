// SPDX-License-Identifier: GPL-3.0-or-later
// Material sets: law and density of every tissue, skin behaviour, supports and uncertainty; the embedded
// tables of pipelines/materials, or a file of the same columns.
#pragma once

#include <array>
#include <optional>

#include "core/table.hpp"
#include "material/law.hpp"

namespace breast {

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
/// "quadratic" (the others), "skin" and the parameters of its supports. Empty for published sets.
struct SoftnessUncertainty {
  std::vector<std::string> parameters;
  Eigen::MatrixXd covariance;  ///< parameters²
};

/// Law and density of every tissue, with skin behaviour, supports and uncertainty.
struct MaterialSet {
  std::string name;
  std::array<Law, n_tissues> laws;
  std::array<double, n_tissues> density;  ///< g/mm^3
  /// Bulk modulus with which the corners of an element (of 27 nodes: all of them) resist changes of volume, Pa; 0: they do not
  /// (mechanics/terms/corner_volume.hpp).
  std::array<double, n_tissues> corner_bulk{};
  SkinBehaviour skin;
  /// Supports of chest wall and cut with which the set was identified, as the command line takes them
  /// (mechanics/supports); if empty, the wall is held and the cut free.
  std::string wall, cut;
  SoftnessUncertainty uncertainty;
  const Law& law(Tissue t) const { return laws[static_cast<std::size_t>(t)]; }
  /// Whether two tissues have the same law, density and resistance of corners.
  bool alike(Tissue a, Tissue b) const {
    const auto i = std::size_t(a), j = std::size_t(b);
    return laws[i] == laws[j] && density[i] == density[j] && corner_bulk[i] == corner_bulk[j];
  }
};

/// The set with which a chain begins unless another one is given: the default of backward and of the
/// pipeline. All later stages take the model that is stated in their input.
inline constexpr const char* default_material_set = "invivo-borders";

/// Named set (one of material_set_names()) or a TSV file of the same columns.
MaterialSet load_materials(const std::string& name_or_file);
/// The set in a table of these columns; errors begin with the table's name.
MaterialSet read_materials(const Table& table, const std::string& name);
/// The names of the embedded sets, in alphabetical order.
std::vector<std::string> material_set_names();
/// Applies "--scale fat=50" settings (per cent). Throws Error (input).
void scale_materials(MaterialSet& set, const std::vector<std::string>& settings);

/// A table that load_materials can read: one row for each of fat, fibroglandular, muscle, tumour and skin,
/// and of air and other tissue if they differ from fat, whose law and density a set without their row gives
/// them; rows for the supports of wall and cut if the set has them, and for its uncertainty if that is
/// known. Numbers read back exactly.
Table material_table(const MaterialSet& set);

/// The number of per cent that, divided by 100, reads back as this fraction.
std::string percent_text(double fraction);

}  // namespace breast
