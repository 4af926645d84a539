// SPDX-License-Identifier: GPL-3.0-or-later
#include "identification/calibration/softness.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"
#include "evaluation/posture_motion.hpp"
#include "material/set_parameter.hpp"
#include "mechanics/mechanics.hpp"
#include "mesh/part.hpp"
#include "mesh/surroundings.hpp"

namespace breast {

namespace {

const std::vector<std::string> of_laws{"low_order", "quadratic", "skin"};

bool has_quadratic(const MaterialSet& set, Tissue tissue) {
  const std::vector<LawConstant> list = constants_of(set, "quadratic");
  return std::any_of(list.begin(), list.end(),
                     [&](const LawConstant& at) { return at.tissue == tissue; });
}

}  // namespace

MechanicsOptions softened(const MaterialSet& base, const Softness& s,
                          std::optional<double> muscle) {
  MechanicsOptions model;
  model.materials = base;
  if (muscle) {
    model.materials.laws[std::size_t(Tissue::muscle)] =
        base.law(Tissue::fibroglandular).scaled(*muscle);
  }
  for (const Tissue tissue : {Tissue::fat, Tissue::fibroglandular}) {
    if (has_quadratic(base, tissue)) continue;
    throw input_error("materials ", base.name, ", tissue ", tissue_name(tissue), ": its law, ",
                      base.law(tissue).kind->name, ", has no quadratic terms to calibrate");
  }
  scale_model(model, "low_order", s.low_order);
  scale_model(model, "quadratic", s.quadratic);
  scale_model(model, "skin", s.skin);
  model.wall = wall_support(s.wall), model.cut = cut_support(s.cut);
  model.materials = set_with_supports(model);
  model.seek_remedy = false;  // the search tries sets without a stable solution and continues
  return model;
}

namespace {

MechanicsOptions scaled(const MechanicsOptions& model, const std::vector<std::string>& names,
                        const Eigen::VectorXd& x) {
  MechanicsOptions out = model;
  for (std::size_t k = 0; k < names.size(); ++k)
    scale_model(out, names[k], std::exp(x[Eigen::Index(k)]));
  return out;
}

// Gives the mesh its stress-free shape; returns false if there is none.
bool unload(HexMesh& mesh, const MechanicsOptions& options) {
  const Equilibrium found = solve_backward(mesh, posture_gravity(Posture::prone), options);
  if (found.converged()) store(found, mesh);
  return found.converged();
}

std::optional<std::vector<MotionQuantity>> motion_of(HexMesh mesh, const MechanicsOptions& options,
                                                     double muscle_mm) {
  if (!unload(mesh, options)) return {};
  const Equilibrium supine = solve_forward(mesh, posture_gravity(Posture::supine), options);
  if (!supine.converged()) return {};
  store(supine, mesh);
  return motion_quantities(posture_motion(mesh, muscle_mm));
}

std::optional<double> pressure_on(const PressedBreast& pressed, const MechanicsOptions& options) {
  HexMesh mesh = pressed.mesh;
  if (!unload(mesh, options)) return {};
  const CompressionResult found =
      compress(restricted(std::move(mesh), breast_elements), pressed.press, options);
  if (!found.converged()) return {};
  return found.contact->plates[0].mean_kPa;
}

// What the model predicts: every quantity of every breast, with its weight in the mean, and the pressure.
struct Prediction {
  Eigen::MatrixXd values, weights;  // quantities × breasts
  std::optional<double> pressure;

  Eigen::VectorXd means() const {
    return values.cwiseProduct(weights).rowwise().sum().cwiseQuotient(weights.rowwise().sum());
  }
  Prediction without(const std::vector<bool>& left_out) const {
    Prediction rest = *this;
    for (std::size_t k = 0; k < left_out.size(); ++k)
      if (left_out[k]) rest.weights.col(Eigen::Index(k)).setZero();
    return rest;
  }
};

const MotionQuantity& quantity(const std::vector<MotionQuantity>& list, const std::string& name) {
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const MotionQuantity& one) { return one.name == name; });
  if (found != list.end()) return *found;
  std::string names;
  for (const MotionQuantity& one : list) names += (names.empty() ? "" : ", ") + one.name;
  throw input_error("calibration: no quantity '", name, "' of a breast's motion; choose from ",
                    names);
}

double share_of_woman(const SoftnessData& data, std::size_t breast) {
  const auto hers = [&](const CohortBreast& one) { return one.woman == data.cohort[breast].woman; };
  return 1.0 / double(std::count_if(data.cohort.begin(), data.cohort.end(), hers));
}

std::optional<Prediction> predict(const MechanicsOptions& options, const SoftnessData& data,
                                  std::string& without_equilibrium) {
  Prediction out;
  out.values.resize(Eigen::Index(data.motion.size()), Eigen::Index(data.cohort.size()));
  out.weights = out.values;
  for (std::size_t k = 0; k < data.cohort.size(); ++k) {
    const auto motion = motion_of(data.cohort[k].mesh, options, data.muscle_mm);
    if (!motion) {
      without_equilibrium = data.cohort[k].name;
      return {};
    }
    for (std::size_t q = 0; q < data.motion.size(); ++q) {
      const MotionQuantity& one = quantity(*motion, data.motion[q].quantity);
      out.values(Eigen::Index(q), Eigen::Index(k)) = one.value;
      out.weights(Eigen::Index(q), Eigen::Index(k)) = one.weight * share_of_woman(data, k);
    }
  }
  if (!data.pressed) return out;
  out.pressure = pressure_on(*data.pressed, options);
  if (!out.pressure) {
    without_equilibrium = "the pressed breast";
    return {};
  }
  return out;
}

// Rounded, because the data determine no more digits and people read the set.
double rounded(double value, int digits = 3) {
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return parse_number(text.str(), "calibration");
}

// The values of the unknowns: on the laws, the factors by which the expected ones were multiplied.
std::vector<CalibratedParameter> values_of(const MechanicsOptions& model, const Softness& expected,
                                           const Eigen::VectorXd& x) {
  std::vector<CalibratedParameter> values{{"low_order", expected.low_order * std::exp(x[0])},
                                          {"quadratic", expected.quadratic * std::exp(x[1])},
                                          {"skin", expected.skin * std::exp(x[2])}};
  for (const SupportPtr& support : {model.wall, model.cut}) {
    for (const std::string& name : support->parameters()) {
      const auto number = std::find_if(support->numbers().begin(), support->numbers().end(),
                                       [&](const SupportNumber& n) { return n.parameter == name; });
      values.push_back({name, number->value});
    }
  }
  for (CalibratedParameter& one : values) one.value = rounded(one.value);
  return values;
}

MaterialSet rounded(MechanicsOptions model) {
  for (SupportPtr* support : {&model.wall, &model.cut}) {
    *support =
        (*support)->with_numbers([](const SupportNumber& number) { return rounded(number.value); });
  }
  MaterialSet set = set_with_supports(model);
  for (Law& law : set.laws)
    for (double& constant : law.constants) constant = rounded(constant, 5);
  return set;
}

Eigen::MatrixXd rounded(const Eigen::MatrixXd& covariance) {
  const Eigen::VectorXd sd =
      covariance.diagonal().cwiseSqrt().unaryExpr([](double x) { return rounded(x); });
  Eigen::MatrixXd out(covariance.rows(), covariance.cols());
  for (Eigen::Index i = 0; i < out.rows(); ++i)
    for (Eigen::Index j = 0; j < out.cols(); ++j) {
      const double r = covariance(i, j) / std::sqrt(covariance(i, i) * covariance(j, j));
      out(i, j) = sd[i] * sd[j] * (i == j ? 1 : std::round(1000 * r) / 1000);
    }
  return out;
}

std::vector<std::string> women_of(const SoftnessData& data) {
  std::vector<std::string> names;
  for (const CohortBreast& one : data.cohort) {
    if (std::find(names.begin(), names.end(), one.woman) == names.end()) names.push_back(one.woman);
  }
  return names;
}

// The targets, with the standard deviations that weight them for a cohort of n women.
std::vector<Observed> weighted(const SoftnessData& data, std::size_t n) {
  const double spread = std::sqrt(1.0 / data.women + 1.0 / double(n));
  std::vector<Observed> wanted = data.motion;
  for (Observed& one : wanted) one.sd = std::hypot(one.sd * spread, one.unmodelled);
  if (data.pressed) wanted.push_back(data.pressed->pressure);
  return wanted;
}

Eigen::VectorXd deviations(const Prediction& prediction, const std::vector<Observed>& wanted) {
  Eigen::VectorXd r(Eigen::Index(wanted.size()));
  const Eigen::VectorXd means = prediction.means();
  for (Eigen::Index q = 0; q < r.size(); ++q) {
    const Observed& target = wanted[std::size_t(q)];
    r[q] = ((q < means.size() ? means[q] : *prediction.pressure) - target.mean) / target.sd;
  }
  return r;
}

// The fit of a softness to the data, with all that was predicted on its way.
class Calibration {
 public:
  Calibration(const MaterialSet& base, const SoftnessData& data, Progress& progress)
      : data_(data),
        progress_(progress),
        expected_(softened(base, data.expected, data.muscle_stiffness)),
        names_(of_laws),
        wanted_(weighted(data, women_of(data).size())) {
    for (const SupportPtr& support : {expected_.wall, expected_.cut})
      for (const std::string& name : support->parameters()) names_.push_back(name);
    prior_sd_ = Eigen::VectorXd::Constant(Eigen::Index(names_.size()), data.expected_ln_sd);
    prior_sd_.head(2).setConstant(data.law_ln_sd);
  }

  SoftnessFound run();

 private:
  std::optional<Prediction> predict_at(const Eigen::VectorXd& x);
  std::vector<Prediction> neighbours(const Eigen::VectorXd& x);
  std::vector<WithoutWoman> leave_out(const Eigen::VectorXd& x, const Prediction& here);

  const SoftnessData& data_;
  Progress& progress_;
  const MechanicsOptions expected_;
  std::vector<std::string> names_;
  const std::vector<Observed> wanted_;
  Eigen::VectorXd prior_sd_;
  int evaluations_ = 0;
};

std::optional<Prediction> Calibration::predict_at(const Eigen::VectorXd& x) {
  const MechanicsOptions tried = scaled(expected_, names_, x);
  std::string said, failed;
  const std::optional<Prediction> found = predict(tried, data_, failed);
  for (const CalibratedParameter& one : values_of(tried, data_.expected, x))
    said += message(said.empty() ? "" : ", ", one.name, " ", one.value);
  said += ":";
  if (!found) said += " no equilibrium of " + failed;
  for (std::size_t q = 0; found && q < data_.motion.size(); ++q) {
    said += message(" ", data_.motion[q].quantity, " ", rounded(found->means()[Eigen::Index(q)]));
  }
  if (found && found->pressure) said += message(" pressure_kPa ", *found->pressure);
  progress_.update("calibrate", -1, message(++evaluations_, ". ", said));
  return found;
}

// For the fits without one woman: what is predicted where one parameter is larger than at x.
constexpr double neighbour_step = 0.1;
std::vector<Prediction> Calibration::neighbours(const Eigen::VectorXd& x) {
  std::vector<Prediction> list;
  for (Eigen::Index k = 0; k < x.size(); ++k) {
    Eigen::VectorXd moved = x;
    moved[k] += neighbour_step;
    const std::optional<Prediction> found = predict_at(moved);
    if (!found) return {};
    list.push_back(*found);
  }
  return list;
}

std::vector<WithoutWoman> Calibration::leave_out(const Eigen::VectorXd& x, const Prediction& here) {
  const std::vector<std::string> women = women_of(data_);
  if (women.size() < 2) return {};
  const std::vector<Prediction> beside = neighbours(x);
  if (beside.empty()) return {};
  const std::vector<Observed> wanted = weighted(data_, women.size() - 1);
  const Eigen::Index n = x.size(), rows = Eigen::Index(wanted.size());
  std::vector<WithoutWoman> list;
  for (const std::string& woman : women) {
    std::vector<bool> hers;
    for (const CohortBreast& one : data_.cohort) hers.push_back(one.woman == woman);
    Eigen::VectorXd r(rows + n);
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows + n, n);
    r << deviations(here.without(hers), wanted), x.cwiseQuotient(prior_sd_);
    for (Eigen::Index k = 0; k < n; ++k) {
      const Eigen::VectorXd moved = deviations(beside[std::size_t(k)].without(hers), wanted);
      jacobian.col(k).head(rows) = (moved - r.head(rows)) / neighbour_step;
      jacobian(rows + k, k) = 1 / prior_sd_[k];
    }
    const Eigen::VectorXd step = -jacobian.colPivHouseholderQr().solve(r);
    Eigen::MatrixXd own = here.values;
    for (Eigen::Index k = 0; k < n; ++k)
      own += step[k] / neighbour_step * (beside[std::size_t(k)].values - here.values);
    WithoutWoman out{woman, {}, {}};
    for (Eigen::Index k = 0; k < n; ++k) out.factors.push_back(std::exp(step[k]));
    for (Eigen::Index q = 0; q < own.rows(); ++q) {
      double sum = 0, count = 0;
      for (std::size_t b = 0; b < hers.size(); ++b)
        if (hers[b]) sum += own(q, Eigen::Index(b)), ++count;
      out.predicted.push_back(sum / count);
    }
    list.push_back(out);
  }
  return list;
}

SoftnessFound Calibration::run() {
  SoftnessFound out;
  out.wanted = wanted_;
  LeastSquaresProblem problem;
  problem.residuals = [&](const Eigen::VectorXd& x) -> std::optional<Eigen::VectorXd> {
    const std::optional<Prediction> found = predict_at(x);
    if (!found) return {};
    Eigen::VectorXd r(Eigen::Index(wanted_.size()) + x.size());
    r << deviations(*found, wanted_), x.cwiseQuotient(prior_sd_);
    return r;
  };
  LeastSquaresOptions search;
  search.max_evaluations = 100;
  out.fit = least_squares(problem, Eigen::VectorXd::Zero(Eigen::Index(names_.size())), search);
  const MechanicsOptions found = scaled(expected_, names_, out.fit.x);
  out.parameters = values_of(found, data_.expected, out.fit.x);
  for (std::size_t k = 0; k < out.wanted.size(); ++k)
    out.found.push_back(out.wanted[k].mean + out.fit.residuals[Eigen::Index(k)] * out.wanted[k].sd);
  if (const std::optional<Prediction> here = predict_at(out.fit.x)) {
    for (Eigen::Index b = 0; b < here->values.cols(); ++b)
      out.of_breast.emplace_back(here->values.col(b).begin(), here->values.col(b).end());
    out.without = leave_out(out.fit.x, *here);
  }
  out.materials = rounded(found);
  out.materials.uncertainty.parameters = names_;
  out.materials.uncertainty.covariance = rounded(out.fit.covariance());
  return out;
}

}  // namespace

SoftnessFound calibrate_softness(const MaterialSet& base, const SoftnessData& data,
                                 Progress& progress) {
  if (data.cohort.empty()) throw input_error("calibration: the cohort is empty");
  if (data.motion.empty()) throw input_error("calibration: no quantity of motion to fit");
  return Calibration(base, data, progress).run();
}

}  // namespace breast
