// SPDX-License-Identifier: GPL-3.0-or-later
// The parameters on which a prediction depends: material constants, weight, gravity, skin, plates.
#pragma once

#include <string>
#include <vector>

#include "mechanics/mechanics.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

enum class ParameterKind {
  scale,           ///< all stiffness constants of a tissue, relative
  constant,        ///< one constant of a tissue's law, relative
  density,         ///< density of all tissues, relative
  tissue_density,  ///< density of one tissue, relative
  gravity,         ///< direction of the state's gravity, turned towards an axis, degrees
  imaged_gravity,  ///< direction of the scan's gravity, turned towards an axis, degrees
  skin_thickness,  ///< thickness of a membrane skin, relative
  support,         ///< a parameter of a support (mechanics/supports), by its name, relative
  together,        ///< a common factor on all `members`, relative
  thickness,       ///< distance between the plates, which close on their mid-plane, mm
  standoff,        ///< both plates' edges moved away from the chest wall, mm
  detector,        ///< height of both plates, raised along the beam, mm
  angle,           ///< angle of the beam; the plates turn about their anterior mid-line, degrees
};

struct Parameter {
  std::string name;  ///< "fat", "fat.a10", "gravity_x", ...
  ParameterKind kind = ParameterKind::scale;
  Tissue tissue = Tissue::fat;
  std::size_t constant = 0;  ///< index into Law::constants
  int axis = 0;              ///< for gravity: the patient axis towards which it is turned
  double value = 1;          ///< present value of a constant
  std::vector<Parameter> members = {};  ///< the members of `together`

  /// Unit of the parameter: "1" for a relative change (derivative with respect to the logarithm),
  /// "degree" or "mm".
  std::string per() const;
  /// Whether it acts on the plates only.
  bool of_plates() const;
};

/// All parameters on which this state depends: single constants that are not zero, the two
/// directions of gravity, skin and plates, and the parameters of the material set's uncertainty, if
/// it has one. Relative parameters come first.
std::vector<Parameter> all_parameters(const HexMesh& state, const MechanicsOptions& options,
                                      const Vec3& imaged_gravity);
/// With the mesh of the scan, which may have tissue around the breast that `state` lacks.
std::vector<Parameter> all_parameters(const HexMesh& imaged, const HexMesh& state,
                                      const MechanicsOptions& options, const Vec3& imaged_gravity);

/// A factor on part of the model (model_parameters in mechanics/options.hpp) as a parameter of this state;
/// without members if nothing in the mesh depends on it. Throws Error (input) for an unknown name.
Parameter set_parameter(const HexMesh& state, const MechanicsOptions& options,
                        const std::string& name);

/// Parses "main" (all except single constants and single densities), "all", or names and those
/// words separated by commas. Throws Error (input) naming the choices.
std::vector<Parameter> pick_parameters(const std::vector<Parameter>& all, const std::string& list);

/// Derivative of gravity with respect to the angle (mm/s² per degree) when `gravity` rotates
/// towards the patient axis `axis`.
Vec3 turned_gravity(const Vec3& gravity, int axis);

}  // namespace breast
