// SPDX-License-Identifier: GPL-3.0-or-later
// The plates of a compressed state as recorded in its file, and their motion with a parameter.
#pragma once

#include <vector>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"
#include "sensitivity/parameter.hpp"

namespace breast {

/// Paddle and detector of mesh.contact. Their far and lateral edges, which nothing touches, are
/// taken to be at infinity. Throws Error (input) when there is no record.
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
/// What a parameter does to one contact at a fixed point: ∂g/∂m and ∂∇g/∂m. Plates move as rigid bodies: closing by their shares of the thickness (a half each, or the paddle
/// alone where the detector has risen as far as it may), both along the anterior axis, both against the beam, or about
/// their common anterior mid-line.
GapSlope gap_slope(const PlatePair& plates, const PlateContact& contact, const Vec3& x,
                   const Parameter& parameter, Side side);

}  // namespace breast
