// SPDX-License-Identifier: GPL-3.0-or-later
#include "identification/identify.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mechanics/model.hpp"

namespace breast {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

// Directions known better than this need no correction for curvature.
constexpr double bends = 0.15;

Sought sought_of(const IdentifyOptions& options) {
  Sought sought{options.parameters, options.align};
  if (sought.names.empty()) sought.names = model_parameters(options.mechanics);
  for (const std::string& name : sought.names) {
    MechanicsOptions tried = options.mechanics;
    scale_model(tried, name, 1);  // throws if the model does not have it
    if (std::count(sought.names.begin(), sought.names.end(), name) > 1)
      throw input_error("parameter '", name, "' appears twice");
  }
  return sought;
}

// Data and prior as one least-squares problem.
class Search {
 public:
  Search(const HexMesh& mesh, const Observations& seen, const IdentifyOptions& options,
         Progress& progress)
      : options_(options),
        sought_(sought_of(options)),
        model_(mesh, options.mechanics, options.imaged_gravity, options.gravity, seen, sought_),
        progress_(progress) {
    prior_ = MatrixXd::Zero(sought_.count(), sought_.count());
    prior_.topLeftCorner(sought_.materials(), sought_.materials()) =
        prior_covariance(options.mechanics.materials, sought_.names, options.prior);
    unit_ = VectorXd::Ones(sought_.count());
    if (options.align) {
      for (Index k = 0; k < 6; ++k) {
        const double deviation = coordinate_deviation(k < 3 ? options.shift_mm : options.turn_deg);
        const Index at = sought_.materials() + k;
        prior_(at, at) = deviation * deviation;
        unit_[at] = deviation;
      }
      if (options.motion_covariance) {
        prior_.bottomRightCorner<6, 6>() = *options.motion_covariance;
        unit_.tail<6>() = options.motion_covariance->diagonal().cwiseSqrt();
      }
    }
    const Eigen::LLT<MatrixXd> factor(prior_);
    if (factor.info() != Eigen::Success) {
      throw input_error("materials ", options.mechanics.materials.name,
                        ": its covariance is not positive definite");
    }
    whitening_ = factor.matrixL().solve(MatrixXd::Identity(prior_.rows(), prior_.cols()));
    if (options.prior == PriorKind::none && Index(seen.count()) < sought_.materials()) {
      throw input_error("too few data: ", seen.count(), " numbers for ", sought_.materials(),
                        " material parameters without a prior; give more landmarks, fewer "
                        "--parameters, or --prior set");
    }
  }

  Identified run();

 private:
  const std::optional<VectorXd>& data(const VectorXd& x);
  std::optional<VectorXd> residuals(const VectorXd& x);
  MatrixXd jacobian() const;
  VectorXd start();
  void tell(const VectorXd& x, const std::optional<VectorXd>& data) const;
  void judge(Identified& out) const;
  void widen(Identified& out);
  void know(Identified& out) const;

  IdentifyOptions options_;
  Sought sought_;
  SecondPosture model_;
  Progress& progress_;
  MatrixXd prior_, whitening_;
  VectorXd unit_, solved_;
  std::optional<VectorXd> data_;  // at solved_
  std::vector<std::string> refusals_;
};

void Search::tell(const VectorXd& x, const std::optional<VectorXd>& data) const {
  std::string text = message(model_.pairs(), ".");
  for (Index k = 0; k < sought_.materials(); ++k)
    text += message(" ", sought_.names[std::size_t(k)], " x ", std::exp(x[k]));
  text += data ? message(", misfit ", std::sqrt(data->squaredNorm() / double(data->size())),
                         " of the observers' error")
               : ", no stable equilibrium";
  progress_.update("identify", -1, text);
}

// The most recent point is not solved again.
const std::optional<VectorXd>& Search::data(const VectorXd& x) {
  if (solved_.size() == x.size() && solved_ == x) return data_;
  data_ = model_.residuals(x);
  solved_ = x;
  tell(x, data_);
  if (!data_) refusals_.push_back(model_.reason());
  return data_;
}

std::optional<VectorXd> Search::residuals(const VectorXd& x) {
  const std::optional<VectorXd>& data = this->data(x);
  if (!data) return {};
  VectorXd all(data->size() + x.size());
  all << *data, whitening_ * x;
  return all;
}

MatrixXd Search::jacobian() const {
  const MatrixXd data = model_.jacobian();
  MatrixXd all(data.rows() + data.cols(), data.cols());
  all << data, whitening_;
  return all;
}

// The centre of the prior, or the next stiffer set that gives a stable body.
VectorXd Search::start() {
  VectorXd x = VectorXd::Zero(sought_.count());
  if (options_.start.size() == x.size()) x = options_.start;
  constexpr int most = 5;
  for (int i = 0; i < most; ++i) {
    if (data(x)) return x;
    x.head(sought_.materials()).array() += 0.4;
  }
  throw not_converged_error("there is no stable body at the starting point, nor with ",
                            std::exp(0.4 * (most - 1)), " times the stiffness of materials ",
                            options_.mechanics.materials.name, ": ", model_.reason());
}

void Search::judge(Identified& out) const {
  const Index materials = sought_.materials(), count = sought_.count();
  const MatrixXd& j = out.fit.jacobian;
  out.names = sought_.names;
  const MatrixXd data = j.topRows(j.rows() - count), identity = MatrixXd::Identity(count, count);
  const MatrixXd of_data = data.transpose() * data, of_prior = whitening_.transpose() * whitening_;
  const MatrixXd as_said = (of_data + of_prior).ldlt().solve(identity);
  const Observations& seen = model_.seen();
  out.surface_points = model_.surface_points();
  out.misfit = misfit_of(out.fit.residuals,
                         3 * seen.points.size() + out.surface_points + seen.forces.size());
  if (out.misfit.probability < misfit_level)
    out.discount = out.misfit.chi_squared / double(out.misfit.freedom);
  out.covariance = (of_data / out.discount + of_prior).ldlt().solve(identity);
  out.prior = prior_.topLeftCorner(materials, materials);
  out.motion = model_.motion(out.fit.x);
  out.second = model_.mesh();
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    const SeenPoint& point = seen.points[i];
    const Index first = 3 * Index(i);
    LandmarkFit fit{point.name};
    const Vec3 residual = point.deviation * out.fit.residuals.segment<3>(first);
    fit.predicted = point.seen + residual;
    fit.residual = residual.norm();
    const Vec3 left = left_out(out.fit.residuals, j, as_said, {first, first + 1, first + 2});
    fit.without = point.seen + point.deviation * left;
    fit.left_out = point.deviation * left.norm();
    fit.observer = point.deviation * std::sqrt(3.0);
    out.landmarks.push_back(fit);
  }
  const MechanicsOptions model = with_factors(options_.mechanics, sought_, out.fit.x);
  out.materials = model.materials;
  out.second.model = model_text(model);
}

// The parameters are x = x̂ + z d + z² a + z³ b with z standard normal, where d is one deviation of
// a direction left open, and a and b are the motion of the parameters with which the curved model
// still agrees with the data. Then E[(z² a)²] = 3 a², and the part of b that its linear part does
// not contain gives 6 b².
void Search::widen(Identified& out) {
  const Index materials = sought_.materials(), count = sought_.count(),
              data = out.fit.jacobian.rows() - count;
  const MatrixXd j = out.fit.jacobian.topRows(data), c = out.covariance;
  const MatrixXd own = c.topLeftCorner(materials, materials);
  const Eigen::SelfAdjointEigenSolver<MatrixXd> found(own);
  for (Index k = materials; k-- > 0;) {
    const double deviation = std::sqrt(found.eigenvalues()[k]);
    if (deviation < bends || model_.pairs() + 2 > options_.max_pairs) return;
    const VectorXd v = found.eigenvectors().col(k);
    const VectorXd d = c.leftCols(materials) * own.ldlt().solve(v) * deviation;
    std::vector<VectorXd> shift;  // change that compensates the curvature on either side
    for (const double side : {1.0, -1.0}) {
      const std::optional<VectorXd>& there = this->data(out.fit.x + side * d);
      if (!there) continue;
      const VectorXd bend = *there - out.fit.residuals.head(data) - side * j * d;
      shift.push_back(-c * (j.transpose() * bend) / out.discount);
    }
    if (shift.empty()) continue;
    const VectorXd a = 0.5 * (shift.front() + shift.back()),
                   b = shift.size() == 2 ? VectorXd(0.5 * (shift[0] - shift[1]))
                                         : VectorXd::Zero(count);
    out.covariance += 3 * a * a.transpose() + 6 * b * b.transpose();
  }
}

void Search::know(Identified& out) const {
  const Index materials = sought_.materials();
  const MatrixXd own = out.covariance.topLeftCorner(materials, materials);
  out.directions = directions_of(out.names, own, out.prior);
  out.decided = decided_by_data(own, out.prior);
  out.materials.uncertainty = {out.names, own};
  out.pairs = model_.pairs();
  out.refusals = refusals_;
}

Identified Search::run() {
  Identified out;
  LeastSquaresOptions region;
  region.unit = unit_;
  const VectorXd begin = start();
  region.max_evaluations = options_.max_pairs - model_.pairs() + 1;
  const LeastSquaresProblem problem{[&](const VectorXd& x) { return residuals(x); },
                                    [&] { return jacobian(); }};
  out.fit = least_squares(problem, begin, region);
  // The last trial point may have been refused or worse, so the state of the solution itself is
  // kept.
  if (solved_ != out.fit.x) residuals(out.fit.x);
  judge(out);
  if (options_.curvature) widen(out);
  know(out);
  return out;
}

}  // namespace

Identified identify(const HexMesh& mesh, const Observations& seen, const IdentifyOptions& options,
                    Progress& progress) {
  if (seen.count() == 0) {
    throw input_error(
        "there are no data of the second posture: give landmarks, the nipple, a surface or "
        "forces");
  }
  return Search(mesh, seen, options, progress).run();
}

}  // namespace breast
