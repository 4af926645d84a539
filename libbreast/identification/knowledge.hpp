// SPDX-License-Identifier: GPL-3.0-or-later
// Statistics of a least-squares solution: determined directions, leave-one-out errors, misfit.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <vector>

namespace breast {

/// A combination of the unknown logarithms that is independent of the others.
struct KnownDirection {
  Eigen::VectorXd weights;     ///< unit vector of weights of the material parameters
  double deviation = 0;        ///< standard deviation of the combination
  double prior_deviation = 0;  ///< the same according to the prior
  /// Share of the information about it that comes from the data: 1 − variance / prior variance.
  double from_data() const {
    return std::max(0.0, 1 - deviation * deviation / (prior_deviation * prior_deviation));
  }
  std::string words;  ///< "wall and cut together known to 4 %; 98 % of it from the data"
};

/// Eigenvectors of the covariance, the best known first.
std::vector<KnownDirection> directions_of(const std::vector<std::string>& names,
                                          const Eigen::MatrixXd& covariance,
                                          const Eigen::MatrixXd& prior);

/// "low_order and wall together known to 8 % ...", "wall against cut not determined by these data ...".
std::string in_words(const std::vector<std::string>& names, const KnownDirection& direction);

/// The number of parameters that the data determine: the trace of 1 − covariance · prior⁻¹.
double decided_by_data(const Eigen::MatrixXd& covariance, const Eigen::MatrixXd& prior);

/// Residuals of these rows if they were left out: (1 − H)⁻¹ r with their block of the hat matrix H
/// = J C Jᵀ, C = (JᵀJ)⁻¹. Exact for a linear model.
Eigen::VectorXd left_out(const Eigen::VectorXd& residuals, const Eigen::MatrixXd& jacobian,
                         const Eigen::MatrixXd& covariance, const std::vector<Eigen::Index>& rows);

/// Probability that a sum of `freedom` squared standard normal deviates exceeds `value`: the upper
/// incomplete gamma function Q(freedom/2, value/2), to 1e-12.
double chi_squared_above(double value, double freedom);

/// Test of the whole sum of squares (data and prior) against its distribution: with the right model
/// and errors it is χ² with as many degrees of freedom as there are data.
struct Misfit {
  double chi_squared = 0;
  std::size_t freedom = 0;
  double probability = 1;  ///< probability of a larger sum
};
Misfit misfit_of(const Eigen::VectorXd& residuals, std::size_t data);

}  // namespace breast
