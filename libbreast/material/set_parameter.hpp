// SPDX-License-Identifier: GPL-3.0-or-later
// Parameters that scale the stiffness of a whole material set.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "material/law.hpp"

namespace breast {

/// One constant of one tissue's law.
struct LawConstant {
  Tissue tissue = Tissue::fat;
  std::size_t constant = 0;
};

/// A parameter: "low_order" (constants linear in the invariants, of all tissues except skin),
/// "quadratic" (their other stiffness constants), "stiffness" (both together), "gland" (all
/// stiffness constants of fibroglandular tissue and tumour, and hence the ratio of gland to fat),
/// "skin", "wall", "cut" or "sternum" (the attachment to it). The covariance of a set's uncertainty
/// refers to the logarithms of such factors.
const std::vector<std::string>& set_parameter_names();

/// The constants that a parameter multiplies; none for "wall", "cut" and "sternum", and for constants
/// that the laws do not have.
std::vector<LawConstant> constants_of(const MaterialSet& set, std::string_view parameter);

/// The support that a parameter multiplies ("wall", "cut", "sternum"), which the set may lack; null for
/// any other name.
std::optional<double>* support_in(MaterialSet& set, std::string_view parameter);
const std::optional<double>* support_in(const MaterialSet& set, std::string_view parameter);

/// Names of the parameters that the set has, without "stiffness".
std::vector<std::string> set_parameters(const MaterialSet& set);

/// Multiplies the constants or support of the parameter. Throws Error (input) if the set does not
/// have it.
void scale_set(MaterialSet& set, std::string_view parameter, double factor);

}  // namespace breast
