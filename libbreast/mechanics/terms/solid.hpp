// SPDX-License-Identifier: GPL-3.0-or-later
// The tissues of a breast as a term: hexahedra of incompressible hyperelastic laws. Quantities of
// the imaged shape (volumes, masses, pressure basis) are computed only once.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "mechanics/options.hpp"
#include "mesh/hex_mesh.hpp"
#include "mesh/nodal.hpp"
#include "solve/discretisation.hpp"
#include "solve/saddle.hpp"
#include "solve/term.hpp"

namespace breast {

class Solid : public Term {
 public:
  std::string name() const override { return "solid"; }
  std::vector<int> nodes() const override;
  int folded_element(const State& state) const override;

  /// Mean pressure (Pa) and mean det F per element.
  virtual std::vector<double> mean_pressure(const Eigen::VectorXd& p) const = 0;
  virtual std::vector<double> mean_det_f(const Eigen::VectorXd& reference,
                                         const Eigen::VectorXd& deformed) const = 0;

  const std::shared_ptr<const Discretisation>& space() const { return space_; }
  /// The linear solver for which matrices are made: multigrid if the options say so, otherwise
  /// direct.
  LinearSolver solver() const { return solver_; }
  /// Mass of each node, g: ∫ρN dv on the imaged shape, once and for all.
  const Eigen::VectorXd& nodal_mass() const { return nodal_mass_; }
  /// Pressure that balances the law at rest (plain invariants), zero for isochoric ones.
  const Eigen::VectorXd& rest_pressure() const { return rest_pressure_; }

 protected:
  int order_ = 1;
  LinearSolver solver_ = LinearSolver::direct;
  std::shared_ptr<const Discretisation> space_;
  Eigen::VectorXd nodal_mass_, rest_pressure_;
};

/// Storage of tangents: assembled, for a factorisation or multigrid, or packed by cells, which
/// avoids the pattern of a large matrix.
enum class TangentStorage { assembled, packed };

/// Throws Error (input) if mesh and options do not agree (element order, folded imaged element).
std::shared_ptr<const Solid> make_solid(const HexMesh& mesh, const MechanicsOptions& options,
                                        TangentStorage storage = TangentStorage::assembled);

}  // namespace breast
