// SPDX-License-Identifier: GPL-3.0-or-later
#include "identification/agreement.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "core/table.hpp"

namespace breast {

namespace {

constexpr double beyond_observer = 4;  // smaller residuals, in errors of a mark, are not judged
// Limit for a landmark left out, relative to the median of all.
constexpr double beyond_others = 6;
constexpr double surely_wrong_mm = 25;    // errors above this cannot come from the model
constexpr double most_unexplained = 0.6;  // as a fraction of the rms motion
constexpr std::size_t few = 5;            // with fewer landmarks no median is formed

// Distances of two landmarks, predicted without their marks, from their observed positions in units
// of their errors.
Eigen::VectorXd without_both(const Identified& found, const Eigen::MatrixXd& covariance,
                             std::size_t i, std::size_t k) {
  std::vector<Eigen::Index> rows;
  for (const std::size_t one : {i, k})
    for (Eigen::Index c = 0; c < 3; ++c) rows.push_back(3 * Eigen::Index(one) + c);
  return left_out(found.fit.residuals, found.fit.jacobian, covariance, rows);
}

void check_exchanged(const Observations& seen, const Identified& found) {
  const Eigen::MatrixXd& j = found.fit.jacobian;
  const Eigen::MatrixXd covariance =
      (j.transpose() * j).ldlt().solve(Eigen::MatrixXd::Identity(j.cols(), j.cols()));
  const auto far = [&](std::size_t i) {
    return found.landmarks[i].left_out > beyond_observer * found.landmarks[i].observer;
  };
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (!far(i) || !far(k)) continue;
      const SeenPoint &a = seen.points[i], &b = seen.points[k];
      const Eigen::VectorXd off = without_both(found, covariance, i, k);
      const Vec3 from_a = a.deviation * off.head<3>(), from_b = b.deviation * off.tail<3>();
      const double now = from_a.norm() + from_b.norm(),
                   crossed = (a.seen + from_a - b.seen).norm() + (b.seen + from_b - a.seen).norm();
      if (!(crossed < 0.4 * now)) continue;
      throw input_error("landmarks '", b.name, "' and '", a.name,
                        "' seem to be interchanged in one of the postures: the other landmarks "
                        "predict them ",
                        format_fixed(from_b.norm(), 1), " and ", format_fixed(from_a.norm(), 1),
                        " mm from their marks, and when interchanged ",
                        format_fixed(crossed / 2, 1), " mm on average");
    }
  }
}

void check_one_against_all(const Identified& found) {
  if (found.landmarks.size() < few) return;
  std::vector<double> left_out;
  for (const LandmarkFit& landmark : found.landmarks) left_out.push_back(landmark.left_out);
  const double usual = median(left_out);
  for (const LandmarkFit& landmark : found.landmarks) {
    if (landmark.left_out < std::max(surely_wrong_mm, beyond_others * usual)) continue;
    throw not_converged_error("landmark '", landmark.name, "' lies ",
                              format_fixed(landmark.left_out, 1),
                              " mm from where the other landmarks predict it, while the median "
                              "is ",
                              format_fixed(usual, 1), " mm: check its positions, or omit it");
  }
}

void check_explained(const HexMesh& mesh, const Observations& seen, const Identified& found) {
  if (seen.points.empty()) return;
  double left = 0, motion = 0, observer = 0;
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    const SeenPoint& point = seen.points[i];
    const Vec3 before = element_position(mesh, mesh.imaged, point.at.element, point.at.local);
    motion += (point.seen - before).squaredNorm();
    left += found.landmarks[i].residual * found.landmarks[i].residual;
    observer += found.landmarks[i].observer * found.landmarks[i].observer;
  }
  if (left <= beyond_observer * beyond_observer * observer ||
      left <= most_unexplained * most_unexplained * motion)
    return;
  const double n = double(seen.points.size());
  throw not_converged_error(
      "the landmarks contradict each other or the mesh: the best fit leaves ",
      format_fixed(std::sqrt(left / n), 1), " mm rms of their motion of ",
      format_fixed(std::sqrt(motion / n), 1),
      " mm; check names, frames and the alignment of the rib cages (--align)");
}

}  // namespace

void check_agreement(const HexMesh& mesh, const Observations& seen, const Identified& found) {
  check_exchanged(seen, found);
  check_one_against_all(found);
  check_explained(mesh, seen, found);
}

std::vector<std::string> doubts_of(const Identified& found) {
  std::vector<std::string> doubts;
  if (found.fit.at_limit && !found.fit.converged) {
    doubts.push_back("the solution lies at the limit beyond which there is no stable body (" +
                     found.refusals.back() +
                     "): nothing is known beyond it, and the standard deviations hold on this "
                     "side only");
  }
  if (found.misfit.probability < misfit_level) {
    doubts.push_back(message(
        "misfit: chi-squared ", format_fixed(found.misfit.chi_squared, 1), " of ",
        found.misfit.freedom, " data, probability ", format_number(found.misfit.probability),
        ": the laws, mesh or alignment are not this patient's, or the marks are less accurate "
        "than stated; the data were given ",
        format_fixed(std::sqrt(found.discount), 2),
        " times their stated errors in all standard deviations"));
  }
  if (found.decided < 0.5 * double(found.names.size())) {
    doubts.push_back(message("the result is mostly the prior: the data determine ",
                             format_fixed(found.decided, 1), " of ", found.names.size(),
                             " numbers"));
  }
  return doubts;
}

}  // namespace breast
