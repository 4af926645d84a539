// SPDX-License-Identifier: GPL-3.0-or-later
// The prior of a patient's material parameters.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "material/law.hpp"

namespace breast {

enum class PriorKind { set, none };
/// "set" or "none". Throws Error (input) for any other.
PriorKind prior_from_name(const std::string& name);

/// Covariance of the logarithms of factors on the named parts of a set (material/set_parameter.hpp)
/// about the set itself: the set's own uncertainty where it has one, 1.1 (a factor of three either way)
/// where it has none, for the ratio of gland to fat 0.7. `none`: a factor of twenty either way for
/// each, which only keeps what the data leave open finite.
Eigen::MatrixXd prior_covariance(const MaterialSet& set, const std::vector<std::string>& names,
                                 PriorKind kind);

}  // namespace breast
