// SPDX-License-Identifier: GPL-3.0-or-later
// The plates of a compressed state as recorded in its file, and their motion with a parameter.
#pragma once

#include <vector>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"
#include "sensitivity/parameter.hpp"

namespace breast {

/// Paddle and detector of mesh.contact. Their far and lateral edges, which touch nothing, are
/// assumed at infinity. Throws Error (input) if there is no record.
PlatePair recorded_plates(const HexMesh& mesh);

/// A skin node held by a plate.
struct PlateContact {
  int node = 0, plate = 0;
  Gap gap;           ///< at the node
  double force = 0;  ///< µN along the normal

  Vec3 normal() const { return gap.gradient; }
};

/// Skin nodes that carry contact pressure, each with the plate it rests on.
std::vector<PlateContact> recorded_contacts(const HexMesh& mesh, const PlatePair& plates);

/// Velocity of a point fixed to a plate, mm per unit of the parameter; zero for parameters that move no
/// plate.
Vec3 plate_velocity(const PlatePair& plates, int plate, const Vec3& x, const Parameter& parameter,
                    Side side);
/// Effect of a parameter on one contact at a fixed point: ∂g/∂m and ∂∇g/∂m. The plates move as
/// rigid bodies. They close by their shares of the thickness (one half each, or the paddle alone if
/// the detector has reached its highest position); or both move along the anterior axis or against
/// the beam; or both rotate about their common anterior mid-line.
GapSlope gap_slope(const PlatePair& plates, const PlateContact& contact, const Vec3& x,
                   const Parameter& parameter, Side side);

}  // namespace breast
