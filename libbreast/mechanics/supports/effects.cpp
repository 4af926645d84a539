// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/supports/effects.hpp"

#include "mechanics/options.hpp"

namespace breast {

namespace {

double power_of(const ParameterPowers& powers, const std::string& parameter) {
  double power = 0;
  for (const auto& [name, exponent] : powers) power += name == parameter ? exponent : 0;
  return power;
}

}  // namespace

void SupportLoad::add(const Vec3& gravity, Eigen::VectorXd& force) const {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    force.segment<3>(3L * nodes[i]) += mass[i] * gravity;
}

Vec3 SupportEffects::force_of_springs(const State& state) const {
  Vec3 sum = Vec3::Zero();
  for (const Springs& one : springs) sum += one.term->force_on_body(state);
  return sum;
}

void SupportEffects::add_loads(const Vec3& gravity, Eigen::VectorXd& force) const {
  for (const SupportLoad& load : loads) load.add(gravity, force);
}

Eigen::VectorXd SupportEffects::slope(const std::string& parameter, const State& state,
                                      const Vec3& gravity) const {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(state.x.size());
  for (const Springs& one : springs) {
    const double power = power_of(one.powers, parameter);
    if (power != 0) sum += power * one.term->forces(state);
  }
  for (const SupportLoad& load : loads) {
    const double power = power_of(load.powers, parameter);
    if (power != 0) load.add(-power * gravity, sum);
  }
  return sum;
}

SupportEffects attach_supports(const HexMesh& mesh, std::shared_ptr<const LevelSurface> surface,
                               const MechanicsOptions& options) {
  const SupportSite site{mesh, std::move(surface), *options.wall,
                         options.materials.density[std::size_t(Tissue::fat)]};
  SupportEffects effects;
  for (const SupportPtr& support : {options.wall, options.cut}) {
    if (!faces_at(mesh, support->place()).empty()) support->attach(site, effects);
  }
  return effects;
}

}  // namespace breast
