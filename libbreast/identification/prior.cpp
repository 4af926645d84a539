// SPDX-License-Identifier: GPL-3.0-or-later
#include "identification/prior.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace breast {

namespace {

constexpr double unknown_ln_sd = 1.1, gland_ln_sd = 0.7, no_prior_ln_sd = 3;

Eigen::Index index_in(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) - names.begin();
}

}  // namespace

PriorKind prior_from_name(const std::string& name) {
  if (name == "set") return PriorKind::set;
  if (name == "none") return PriorKind::none;
  throw input_error("prior '", name, "': use set or none");
}

Eigen::MatrixXd prior_covariance(const MaterialSet& set, const std::vector<std::string>& names,
                                 PriorKind kind) {
  const Eigen::Index n = Eigen::Index(names.size());
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(n, n);
  const SoftnessUncertainty& known = set.uncertainty;
  const Eigen::Index count = Eigen::Index(known.parameters.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index a = index_in(known.parameters, names[std::size_t(i)]);
    const double alone = kind == PriorKind::none            ? no_prior_ln_sd
                         : names[std::size_t(i)] == "gland" ? gland_ln_sd
                                                            : unknown_ln_sd;
    if (kind == PriorKind::none || a == count) {
      covariance(i, i) = alone * alone;
      continue;
    }
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::Index b = index_in(known.parameters, names[std::size_t(j)]);
      if (b < count) covariance(i, j) = known.covariance(a, b);
    }
    if (!(covariance(i, i) > 0)) {
      throw input_error("materials ", set.name, ", uncertainty of ", names[std::size_t(i)],
                        ": a standard deviation of 0 leaves nothing to identify; omit it from "
                        "--parameters");
    }
  }
  return covariance;
}

}  // namespace breast
