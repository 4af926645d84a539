// SPDX-License-Identifier: GPL-3.0-or-later
// Weight of the tissue beyond the cut, which hangs on the body.
//
// A layer of the thickness h rests on the wall's supports of the stiffness KT per area. Far from the cut,
// gravity g moves it along the wall by ρ h g_t / KT, where g_t is the part of g along the wall. Springs of
// the stiffness KC per area at the cut pull the body towards the place to which the layer would move by
// itself, not to its stress-free place, so that they exert the additional traction
//
//     KC ρ h g_t / KT
//
// on the cut: the weight of a layer of the length KC h / KT. It does not depend on the deformed shape. h is
// a property of the body, not of the place of the cut, so that a cut farther out carries the same.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "core/types.hpp"
#include "mechanics/options.hpp"
#include "mesh/hex_mesh.hpp"
#include "surface/level_surface.hpp"

namespace breast {

/// Thickness h of the tissue around a breast, mm.
inline constexpr double thickness_beyond = 20;

class TissueBeyond {
 public:
  /// The weight of tissue of `density` (g/mm³) and `length` (mm) on the cut faces of the mesh. Throws Error
  /// (input) without a surface and for a node of the cut that is beyond it.
  TissueBeyond(const HexMesh& mesh, const LevelSurface* wall, double density, double length);

  /// Adds its forces under gravity (mm/s²) to nodal forces (µN, 3 per node).
  void add(const Vec3& gravity, Eigen::VectorXd& force) const;

 private:
  std::vector<int> nodes_;
  std::vector<Mat3> mass_;  // g: the mass that each node carries, projected onto the wall
};

/// That of the options; absent if they give it no weight or the mesh has no cut. `wall`: chest-wall
/// surface of the mesh, null if it has none. Throws Error (input) as the constructor does, and if the
/// breast does not slide or rest on springs with KT above 0.
std::optional<TissueBeyond> tissue_at_cut(const HexMesh& mesh, const LevelSurface* wall,
                                          const MechanicsOptions& options);

}  // namespace breast
