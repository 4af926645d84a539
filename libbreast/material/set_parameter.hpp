// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters that scale the laws of a whole material set.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "material/material_set.hpp"

namespace breast {

/// One constant of one tissue's law.
struct LawConstant {
  Tissue tissue = Tissue::fat;
  std::size_t constant = 0;
};

/// A parameter: "low_order" (constants linear in the invariants, of all tissues except skin),
/// "quadratic" (their other stiffness constants), "stiffness" (both together), "gland" (all
/// stiffness constants of fibroglandular tissue and tumour, and hence the ratio of gland to fat) or
/// "skin". The covariance of a set's uncertainty refers to the logarithms of such factors and of those on
/// the supports (mechanics/options.hpp).
const std::vector<std::string>& set_parameter_names();

/// The constants that a parameter multiplies; none for another name, and for constants that the laws do
/// not have.
std::vector<LawConstant> constants_of(const MaterialSet& set, std::string_view parameter);

/// Names of the parameters that the set has, without "stiffness".
std::vector<std::string> set_parameters(const MaterialSet& set);

/// Multiplies the constants of the parameter; false if the set has none.
bool scale_set(MaterialSet& set, std::string_view parameter, double factor);

}  // namespace breast
