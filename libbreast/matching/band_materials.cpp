// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/band_materials.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.hpp"

namespace breast {

namespace {

const NodalField& derivative_in(const DerivativeFields& fields, const std::string& name) {
  const auto found = fields.find(name);
  if (found == fields.end()) {
    throw input_error("band: the material set states the uncertainty of '", name,
                      "', but a file has no derivative with respect to it; run sensitivity with "
                      "--parameters main and this set, or give --priors FILE");
  }
  return found->second;
}

NodalField combined(const DerivativeFields& fields, const std::vector<std::string>& parameters,
                    const Eigen::VectorXd& weights) {
  NodalField sum;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const NodalField& one = derivative_in(fields, parameters[i]);
    sum.resize(one.size(), Vec3::Zero());
    for (std::size_t n = 0; n < one.size(); ++n) sum[n] += weights[Eigen::Index(i)] * one[n];
  }
  return sum;
}

}  // namespace

void use_covariance(const std::vector<std::string>& parameters, const Eigen::MatrixXd& covariance,
                    DerivativeFields& from, DerivativeFields& to, std::vector<Prior>& priors) {
  // A parameter replaces the prior of the same name, or of the tissue whose laws it scales.
  static const std::map<std::string, std::string> of_laws{{"low_order", "fat"},
                                                          {"quadratic", "fat"},
                                                          {"stiffness", "fat"},
                                                          {"gland", "fibroglandular"}};
  for (const std::string& parameter : parameters) {
    const auto law = of_laws.find(parameter);
    const std::string& replaced = law == of_laws.end() ? parameter : law->second;
    std::erase_if(priors, [&](const Prior& prior) { return prior.parameter == replaced; });
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> found(covariance);
  for (Eigen::Index k = covariance.rows(); k-- > 0;) {
    const std::string name = "materials_" + std::to_string(covariance.rows() - k);
    const Eigen::VectorXd weights = found.eigenvectors().col(k);
    from[name] = combined(from, parameters, weights);
    to[name] = combined(to, parameters, weights);
    priors.push_back({name, std::sqrt(std::max(found.eigenvalues()[k], 0.0)), "relative",
                      "covariance of the material set"});
  }
}

}  // namespace breast
