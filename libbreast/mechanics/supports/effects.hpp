// SPDX-License-Identifier: GPL-3.0-or-later
// What supports add to the problem of a body, with the derivatives by their parameters.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "mechanics/supports/support.hpp"
#include "mechanics/terms/node_springs.hpp"
#include "surface/level_surface.hpp"

namespace breast {

struct MechanicsOptions;

/// Where a support is attached.
struct SupportSite {
  const HexMesh& mesh;
  std::shared_ptr<const LevelSurface> surface;  ///< of the chest wall; null: the mesh has none
  const BodySupport& wall;                      ///< the support there
  double density = 0;                           ///< of fat, g/mm³
};

/// The forces of a term or load are proportional to products of powers of parameters.
using ParameterPowers = std::vector<std::pair<std::string, double>>;

/// Masses that hang on nodes, with the density of fat; a mass may act in some directions only.
struct SupportLoad {
  std::vector<int> nodes;
  std::vector<Mat3> mass;  ///< g: what each node carries
  ParameterPowers powers;

  /// Adds its forces under gravity (mm/s²) to nodal forces (µN, 3 per node).
  void add(const Vec3& gravity, Eigen::VectorXd& force) const;
};

struct SupportEffects {
  struct Springs {
    std::shared_ptr<const NodeSprings> term;
    ParameterPowers powers;
  };
  std::vector<Springs> springs;
  std::vector<SupportLoad> loads;

  /// Force of all springs on the body, µN.
  Vec3 force_of_springs(const State& state) const;
  /// Adds the forces of the loads under gravity (mm/s²), µN, 3 per node.
  void add_loads(const Vec3& gravity, Eigen::VectorXd& force) const;
  /// Derivative of the residual with respect to the logarithm of a parameter, µN (3 per node), under
  /// gravity in mm/s²; zero for a parameter that no support has.
  Eigen::VectorXd slope(const std::string& parameter, const State& state,
                        const Vec3& gravity) const;
};

/// The effects of all supports of a mesh whose chest wall is `surface` (null: it has none). Throws Error
/// (input) if a support cannot stand there.
SupportEffects attach_supports(const HexMesh& mesh, std::shared_ptr<const LevelSurface> surface,
                               const MechanicsOptions& options);

}  // namespace breast
