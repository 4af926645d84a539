// SPDX-License-Identifier: GPL-3.0-or-later
#include "identification/second_posture.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mesh/part.hpp"
#include "mesh/surroundings.hpp"

namespace breast {

namespace {

constexpr double sample_spacing_mm = 12;

// Derivatives of the elastic parameters, as columns of nodal fields.
std::vector<Response> responses(const HexMesh& imaged, const HexMesh& state,
                                const std::vector<double>& imaged_pressure,
                                const Vec3& imaged_gravity, const MechanicsOptions& options,
                                const std::vector<std::string>& names) {
  std::vector<Parameter> parameters;
  for (const std::string& name : names) parameters.push_back(set_parameter(imaged, options, name));
  return SensitivityChain(imaged, state, imaged_pressure, imaged_gravity, options)
      .tangent(parameters);
}

}  // namespace

double coordinate_deviation(double rms_mm) {
  return rms_mm / std::sqrt(3.0);
}

MechanicsOptions with_factors(const MechanicsOptions& options, const Sought& sought,
                              const Eigen::VectorXd& x) {
  MechanicsOptions out = options;
  for (Eigen::Index k = 0; k < sought.materials(); ++k)
    scale_model(out, sought.names[std::size_t(k)], std::exp(x[k]));
  out.materials = set_with_supports(out);
  return out;
}

SecondPosture::SecondPosture(HexMesh mesh, const MechanicsOptions& options,
                             const Vec3& imaged_gravity, const Vec3& gravity, Observations seen,
                             Sought sought)
    : mesh_(std::move(mesh)),
      base_(options),
      imaged_gravity_(imaged_gravity),
      gravity_(gravity),
      seen_(std::move(seen)),
      sought_(std::move(sought)),
      centre_(Vec3::Zero()) {
  base_.seek_remedy = false;  // the search tries bodies that do not exist and continues
  base_.estimate = Estimate::none;
  if (seen_.surface) samples_ = skin_samples(mesh_, sample_spacing_mm);
  const std::vector<int> wall = nodes_of(mesh_, mesh_.pectoral_faces);
  for (const int node : wall) centre_ += mesh_.imaged[std::size_t(node)] / double(wall.size());
}

RigidMotion SecondPosture::motion(const Eigen::VectorXd& x) const {
  RigidMotion motion;
  motion.centre = centre_;
  if (sought_.align) motion.shift = x.segment<3>(sought_.materials()), motion.turn = x.tail<3>();
  return motion;
}

bool SecondPosture::solve(const Eigen::VectorXd& x) {
  const MechanicsOptions options = with_factors(base_, sought_, x);
  HexMesh trial = mesh_;
  ++pairs_;
  const Equilibrium free = solve_backward(trial, imaged_gravity_, options);
  if (!free.converged()) return reason_ = "stress-free: " + free.record.reason, false;
  store(free, trial);
  std::vector<double> pressure = trial.pressure;
  const Equilibrium second = solve_forward(trial, gravity_, options);
  if (!second.converged()) return reason_ = "second posture: " + second.record.reason, false;
  store(second, trial);
  std::swap(mesh_, trial);
  if (!press(options)) return std::swap(mesh_, trial), false;
  imaged_pressure_ = std::move(pressure);
  options_ = options;
  x_ = x;
  return true;
}

bool SecondPosture::press(const MechanicsOptions& options) {
  std::vector<HexMesh> pressed;
  for (const SeenForce& seen : seen_.forces) {
    CompressionOptions press = seen_.press;
    press.stops = {{StopAt::thickness, seen.thickness}};
    press.must_grip = false;  // the mammogram that was seen says how the breast was pressed
    HexMesh state = restricted(mesh_, breast_elements);
    const CompressionResult found = compress(state, press, options);
    if (!found.converged()) return reason_ = "compression: " + found.record.reason, false;
    store(found, state);
    pressed.push_back(std::move(state));
  }
  pressed_ = std::move(pressed);
  return true;
}

std::optional<Eigen::VectorXd> SecondPosture::residuals(const Eigen::VectorXd& x) {
  if (!solve(x)) return {};
  const RigidMotion moved = motion(x);
  Eigen::VectorXd r(3 * seen_.points.size() + samples_.size() + seen_.forces.size());
  Eigen::Index at = 0;
  for (const SeenPoint& point : seen_.points) {
    r.segment<3>(at) = (moved(place(point.at)) - point.seen) / point.deviation;
    at += 3;
  }
  distances_.clear();
  surface_points_ = 0;
  for (const Location& sample : samples_) {
    distances_.push_back(distance_to(*seen_.surface, moved(place(sample))));
    surface_points_ += distances_.back().has_value();
    r[at++] = distances_.back() ? distances_.back()->value / seen_.surface->deviation : 0;
  }
  for (std::size_t k = 0; k < seen_.forces.size(); ++k) {
    const SeenForce& force = seen_.forces[k];
    r[at++] = (pressed_[k].contact->plates[0].force_N - force.force) / force.deviation;
  }
  return r;
}

Eigen::MatrixXd SecondPosture::jacobian() const {
  const std::vector<Response> by =
      responses(mesh_, mesh_, imaged_pressure_, imaged_gravity_, options_, sought_.names);
  const RigidMotion moved = motion(x_);
  const Mat3 rotation = moved.rotation();
  const Eigen::Index materials = sought_.materials();
  // Derivatives of the position of a material point, mm.
  const auto slopes = [&](const Location& at) {
    Eigen::MatrixXd out(3, sought_.count());
    for (Eigen::Index k = 0; k < materials; ++k) {
      out.col(k) =
          rotation * element_position(mesh_, by[std::size_t(k)].position, at.element, at.local);
    }
    if (sought_.align) {
      out.middleCols<3>(materials) = Mat3::Identity();
      out.rightCols<3>() = moved.by_turn(place(at));
    }
    return out;
  };
  Eigen::MatrixXd j = Eigen::MatrixXd::Zero(
      Eigen::Index(3 * seen_.points.size() + samples_.size() + seen_.forces.size()),
      sought_.count());
  Eigen::Index at = 0;
  for (const SeenPoint& point : seen_.points) {
    j.middleRows<3>(at) = slopes(point.at) / point.deviation;
    at += 3;
  }
  for (std::size_t k = 0; k < samples_.size(); ++k, ++at) {
    if (!distances_[k]) continue;
    j.row(at) = distances_[k]->normal.transpose() * slopes(samples_[k]) / seen_.surface->deviation;
  }
  for (std::size_t k = 0; k < seen_.forces.size(); ++k, ++at) {
    const std::vector<Response> pressed =
        responses(mesh_, pressed_[k], imaged_pressure_, imaged_gravity_, options_, sought_.names);
    for (Eigen::Index i = 0; i < materials; ++i)
      j(at, i) = pressed[std::size_t(i)].paddle_force_N / seen_.forces[k].deviation;
  }
  return j;
}

}  // namespace breast
