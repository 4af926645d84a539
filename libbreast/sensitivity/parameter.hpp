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
  density,         ///< of all tissues, relative
  tissue_density,  ///< of one tissue, relative
  gravity,         ///< of the state, turned towards an axis, degrees
  imaged_gravity,  ///< of the scan, likewise
  skin_thickness,  ///< of a membrane, relative
  wall_support,    ///< stiffness of the springs along or under the chest wall, relative
  cut_support,     ///< of those at the cut, relative
  together,        ///< `members` by one factor, relative
  thickness,       ///< between the plates, mm; they close on their mid-plane
  standoff,        ///< both plates' edges moved away from the chest wall, mm
  detector,        ///< height of both plates, raised along the beam, mm
  angle,           ///< of the beam, plates turned about their anterior mid-line, degrees
};

struct Parameter {
  std::string name;  ///< "fat", "fat.a10", "gravity_x", ...
  ParameterKind kind = ParameterKind::scale;
  Tissue tissue = Tissue::fat;
  std::size_t constant = 0;  ///< index into Law::constants
  int axis = 0;              ///< gravity: the patient axis it turns to
  double value = 1;          ///< of a constant: its present value
  std::vector<Parameter> members = {};  ///< of together

  /// "1" for a relative change (derivatives are by the logarithm), "degree" or "mm".
  std::string per() const;
  bool relative() const;
  /// True when it acts on the plates only.
  bool of_plates() const;
};

/// Every parameter this state depends on: single constants that are not zero, and what the two
/// directions of gravity, skin and plates add; where the material set has an uncertainty, also what
/// that is about (material/set_parameter.hpp). The relative ones come first.
std::vector<Parameter> all_parameters(const HexMesh& state, const MechanicsOptions& options,
                                      const Vec3& imaged_gravity);

/// A factor on part of the material set (material/set_parameter.hpp) as a parameter of this state;
/// without members where nothing of the mesh depends on it. Throws Error (input) for an unknown name.
Parameter set_parameter(const HexMesh& state, const MaterialSet& set, const std::string& name);

/// "main" (all but single constants and single densities), "all", or names and those words
/// separated by commas. Throws Error (input) naming the choices.
std::vector<Parameter> pick_parameters(const std::vector<Parameter>& all, const std::string& list);

/// d gravity / d angle (mm/s² per degree) when `gravity` turns towards patient axis `axis`.
Vec3 turned_gravity(const Vec3& gravity, int axis);

}  // namespace breast
