// SPDX-License-Identifier: GPL-3.0-or-later
#include "calibration/softness.hpp"

#include <cmath>
#include <iomanip>
#include <sstream>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"
#include "evaluation/posture_motion.hpp"
#include "mechanics/mechanics.hpp"
#include "mechanics/set_supports.hpp"
#include "mesh/surroundings.hpp"

namespace breast {

std::vector<std::string> Softness::names() const {
  std::vector<std::string> list{"low_order", "quadratic", "skin", "wall", "cut"};
  if (sternum) list.push_back("sternum");
  return list;
}

std::vector<double> Softness::values() const {
  std::vector<double> list{low_order, quadratic, skin, wall, cut};
  if (sternum) list.push_back(*sternum);
  return list;
}

Eigen::VectorXd Softness::logarithms() const {
  const std::vector<double> all = values();
  return Eigen::Map<const Eigen::VectorXd>(all.data(), Eigen::Index(all.size())).array().log();
}

Softness Softness::from_logarithms(const Eigen::VectorXd& x) {
  Softness s{std::exp(x[0]), std::exp(x[1]), std::exp(x[2]), std::exp(x[3]), std::exp(x[4])};
  if (x.size() > 5) s.sternum = std::exp(x[5]);
  return s;
}

MaterialSet softened(const MaterialSet& base, const Softness& s, std::optional<double> muscle) {
  MaterialSet set = base;
  if (muscle) {
    set.laws[std::size_t(Tissue::muscle)] = base.law(Tissue::fibroglandular).scaled(*muscle);
  }
  for (const Tissue tissue :
       {Tissue::fat, Tissue::fibroglandular, Tissue::tumour, Tissue::muscle, Tissue::other}) {
    Law& law = set.laws[std::size_t(tissue)];
    if (law.kind != LawKind::polynomial) {
      throw input_error("materials ", base.name, ", tissue ", tissue_name(tissue),
                        ": a polynomial law with linear and quadratic terms is needed");
    }
    for (std::size_t k = 0; k < law.constants.size(); ++k)
      law.constants[k] *= k < 2 ? s.low_order : s.quadratic;
  }
  Law& skin = set.laws[std::size_t(Tissue::skin)];
  skin = skin.scaled(s.skin);
  set.wall_support = s.wall;
  set.cut_support = s.cut;
  set.sternum_support = s.sternum;
  return set;
}

namespace {

MechanicsOptions options_with(const MaterialSet& materials) {
  MechanicsOptions options;
  options.materials = materials;
  take_supports_of_set(options);
  options.seek_remedy = false;  // the search tries sets without a stable solution and continues
  return options;
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
std::optional<std::vector<double>> model(const MaterialSet& materials, const SoftnessData& data) {
  const MechanicsOptions options = options_with(materials);
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

Softness rounded(const Softness& s) {
  Softness out{rounded(s.low_order), rounded(s.quadratic), rounded(s.skin), rounded(s.wall),
               rounded(s.cut)};
  if (s.sternum) out.sternum = rounded(*s.sternum);
  return out;
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
  const Eigen::VectorXd expected = data.expected.logarithms();
  int evaluations = 0;
  LeastSquaresProblem problem;
  problem.residuals = [&](const Eigen::VectorXd& x) -> std::optional<Eigen::VectorXd> {
    const Softness s = Softness::from_logarithms(x);
    const std::optional<std::vector<double>> values =
        model(softened(base, s, data.muscle_stiffness), data);
    std::string said = message("low order ", s.low_order, ", quadratic ", s.quadratic, ", skin ",
                               s.skin, ", wall ", s.wall, ", cut ", s.cut);
    if (s.sternum) said += message(", sternum ", *s.sternum);
    said += ":";
    if (!values) said += " no equilibrium";
    Eigen::VectorXd r(Eigen::Index(out.wanted.size()) + x.size());
    for (std::size_t k = 0; values && k < out.wanted.size(); ++k) {
      r[Eigen::Index(k)] = ((*values)[k] - out.wanted[k].mean) / out.wanted[k].sd;
      said += message(" ", out.wanted[k].quantity, " ", (*values)[k]);
    }
    progress.update("calibrate", -1, message(++evaluations, ". ", said));
    if (!values) return {};
    r.tail(x.size()) = (x - expected) / data.expected_ln_sd;
    return r;
  };
  LeastSquaresOptions search;
  search.max_evaluations = 100;
  out.fit = least_squares(problem, expected, search);
  out.softness = rounded(Softness::from_logarithms(out.fit.x));
  for (std::size_t k = 0; k < out.wanted.size(); ++k)
    out.found.push_back(out.wanted[k].mean + out.fit.residuals[Eigen::Index(k)] * out.wanted[k].sd);
  out.materials = softened(base, out.softness, data.muscle_stiffness);
  for (Law& law : out.materials.laws)
    for (double& constant : law.constants) constant = rounded(constant, 5);
  out.materials.uncertainty.parameters = out.softness.names();
  out.materials.uncertainty.covariance = rounded(out.fit.covariance());
  return out;
}

}  // namespace breast
