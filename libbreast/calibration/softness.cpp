// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/softness.hpp"

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

std::optional<PostureMotion> motion_of(HexMesh mesh, const MechanicsOptions& options,
                                       double muscle_mm) {
  if (!unload(mesh, options)) return {};
  const Equilibrium supine = solve_forward(mesh, posture_gravity(Posture::supine), options);
  if (!supine.converged()) return {};
  store(supine, mesh);
  return posture_motion(mesh, muscle_mm);
}

std::optional<double> pressure_on(HexMesh mesh, const MechanicsOptions& options,
                                  const SoftnessData& data) {
  if (!unload(mesh, options)) return {};
  const CompressionResult found = compress(breast_alone(std::move(mesh)), data.press, options);
  if (!found.converged()) return {};
  return found.contact->plates[0].mean_kPa;
}

// The means of lateral, posterior and rib motion over the cohort, and the pressure.
std::optional<std::vector<double>> model(const MechanicsOptions& options,
                                         const SoftnessData& data) {
  std::vector<double> sum(3, 0.0);
  for (const HexMesh& mesh : data.cohort) {
    const std::optional<PostureMotion> motion = motion_of(mesh, options, data.muscle_mm);
    if (!motion) return {};
    sum[0] += motion->nipple_lateral;
    sum[1] += motion->nipple_posterior;
    sum[2] += motion->ribs_after - motion->ribs_before;
  }
  for (double& value : sum) value /= double(data.cohort.size());
  const std::optional<double> pressure = pressure_on(data.pressed, options, data);
  if (!pressure) return {};
  sum.push_back(*pressure);
  return sum;
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

std::vector<Observed> weighted(const SoftnessData& data) {
  const double spread = std::sqrt(1.0 / data.women + 1.0 / double(data.cohort.size()));
  std::vector<Observed> wanted{data.lateral, data.posterior, data.ribs_change};
  for (Observed& one : wanted) one.sd *= spread;
  wanted.push_back(data.pressure);
  return wanted;
}

}  // namespace

SoftnessFound calibrate_softness(const MaterialSet& base, const SoftnessData& data,
                                 Progress& progress) {
  if (data.cohort.empty()) throw input_error("calibration: the cohort is empty");
  SoftnessFound out;
  out.wanted = weighted(data);
  const MechanicsOptions expected = softened(base, data.expected, data.muscle_stiffness);
  std::vector<std::string> names = of_laws;
  for (const SupportPtr& support : {expected.wall, expected.cut}) {
    for (const std::string& name : support->parameters()) names.push_back(name);
  }
  int evaluations = 0;
  LeastSquaresProblem problem;
  problem.residuals = [&](const Eigen::VectorXd& x) -> std::optional<Eigen::VectorXd> {
    const MechanicsOptions tried = scaled(expected, names, x);
    const std::optional<std::vector<double>> values = model(tried, data);
    std::string said;
    for (const CalibratedParameter& one : values_of(tried, data.expected, x))
      said += message(said.empty() ? "" : ", ", one.name, " ", one.value);
    said += ":";
    if (!values) said += " no equilibrium";
    Eigen::VectorXd r(Eigen::Index(out.wanted.size()) + x.size());
    for (std::size_t k = 0; values && k < out.wanted.size(); ++k) {
      r[Eigen::Index(k)] = ((*values)[k] - out.wanted[k].mean) / out.wanted[k].sd;
      said += message(" ", out.wanted[k].quantity, " ", (*values)[k]);
    }
    progress.update("calibrate", -1, message(++evaluations, ". ", said));
    if (!values) return {};
    r.tail(x.size()) = x / data.expected_ln_sd;
    return r;
  };
  LeastSquaresOptions search;
  search.max_evaluations = 100;
  out.fit = least_squares(problem, Eigen::VectorXd::Zero(Eigen::Index(names.size())), search);
  const MechanicsOptions found = scaled(expected, names, out.fit.x);
  out.parameters = values_of(found, data.expected, out.fit.x);
  for (std::size_t k = 0; k < out.wanted.size(); ++k)
    out.found.push_back(out.wanted[k].mean + out.fit.residuals[Eigen::Index(k)] * out.wanted[k].sd);
  out.materials = rounded(found);
  out.materials.uncertainty.parameters = names;
  out.materials.uncertainty.covariance = rounded(out.fit.covariance());
  return out;
}

}  // namespace breast
