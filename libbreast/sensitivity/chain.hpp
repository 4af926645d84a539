// SPDX-License-Identifier: GPL-3.0-or-later
// Derivatives of a deformed breast through the chain backward → forward or compress: the
// stress-free shape changes with every parameter so that the imaged shape remains the same. See
// docs/methods.md.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "contact/terms/friction.hpp"
#include "contact/terms/surface_pressure.hpp"
#include "core/progress.hpp"
#include "mesh/part.hpp"
#include "sensitivity/linearised_state.hpp"

namespace breast {

/// Response of a state to one parameter, per unit of it.
struct Response {
  Parameter parameter;
  std::vector<Vec3> position, reference;  ///< dx/dm and dX/dm, mm
  double paddle_force_N = 0;              ///< d(paddle force)/dm; not for the angle
  double seconds = 0;
};

/// Derivatives of one landmark with respect to many parameters, from three adjoint solves.
struct LandmarkGradient {
  std::string name;
  std::vector<Vec3> by_parameter;  ///< mm, in the parameters' order
  /// Derivative of the distance from the imaged point with respect to ln(stiffness of the element),
  /// mm.
  std::vector<double> by_element;
  double seconds = 0;
};

class SensitivityChain {
 public:
  /// `state` is a converged result of forward or compress with its reference (order 1, or 2 for
  /// q2p1); `imaged_pressure` contains the mean pressures (Pa) found by backward. The set of
  /// touching nodes is fixed: where it is about to change, derivatives are one-sided. `state` must
  /// outlive this object.
  SensitivityChain(const HexMesh& state, const std::vector<double>& imaged_pressure,
                   const Vec3& imaged_gravity, const MechanicsOptions& options);
  /// With the mesh of backward, of which `state` may be a part, and which must outlive this object,
  /// too. Throws Error (input) if `state` is no part of it.
  SensitivityChain(const HexMesh& imaged, const HexMesh& state,
                   const std::vector<double>& imaged_pressure, const Vec3& imaged_gravity,
                   const MechanicsOptions& options);

  /// Tangent-linear method: two solves per parameter.
  std::vector<Response> tangent(const std::vector<Parameter>& parameters,
                                Progress& progress = no_progress()) const;
  /// Adjoint method: six solves per landmark, for any number of parameters.
  LandmarkGradient adjoint(const Landmark& landmark,
                           const std::vector<Parameter>& parameters) const;

  const LinearisedState& imaged() const { return imaged_; }
  const LinearisedState& deformed() const { return deformed_; }
  /// Number of nodes held by plates.
  std::size_t contacts() const { return deformed_.contacts().size(); }
  /// Whether plates touch the deformed state.
  bool pressed() const { return pressure_ != nullptr || !deformed_.contacts().empty(); }

 private:
  struct Rights;
  Rights rights(const std::vector<Parameter>& parameters) const;
  /// Rates of change of the plates' gaps with a parameter, which must outlive the result.
  std::function<GapSlope(int, const Gap&, const Vec3&)> slope_of(const Parameter& parameter) const;
  /// Velocities of points fixed to the plates with a parameter, which must outlive the result.
  std::function<Vec3(int, const Vec3&)> velocity_of(const Parameter& parameter) const;
  double paddle_force(const Parameter& parameter, const Imbalance& along,
                      const Direction& moved) const;

  const HexMesh& mesh_;
  std::shared_ptr<const Scene> scene_,
      imaged_scene_;  // of the state and of the scan: one if it is all of it
  PartIndices part_;  // the elements and nodes of the state in the scan's mesh
  PlatePair plates_;
  std::shared_ptr<SurfacePressure> pressure_;  // where plates press on faces
  LinearisedState imaged_;
  std::shared_ptr<FrictionTerm> friction_;
  LinearisedState deformed_;
};

/// Derivative of ln|u|, where u is a landmark's displacement from its imaged position, per unit of
/// a parameter with respect to which the position has the derivative `slope` (mm).
double displacement_elasticity(const HexMesh& mesh, const Landmark& landmark, const Vec3& slope);

}  // namespace breast
