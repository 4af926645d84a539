// SPDX-License-Identifier: GPL-3.0-or-later
// The data of the second posture for identify, transformed into the frame of the mesh.
#pragma once

#include <optional>

#include "identification/identify.hpp"
#include "identification/wall_alignment.hpp"
#include "identify_options.hpp"
#include "surface/tri_mesh.hpp"
#include "tool_pairs.hpp"

namespace breast {

struct SecondScan {
  Observations seen;
  std::vector<SeenPoint> judged;      ///< landmarks that are compared but not fitted
  std::optional<WallAlignment> ribs;  ///< registration of the two scans by their chest walls
  TriMesh surface;                    ///< the surface as read, in the frame of the mesh
};

/// Reads and checks all given data. Throws Error (input).
SecondScan read_second_scan(const IdentifyChoices& choices, const HexMesh& mesh, Pairs& pairs);

/// The surface in the frame of the solution, that is, also moved by the remaining motion of the rib
/// cage.
TriMesh seen_beside(const SecondScan& scan, const Identified& found);

}  // namespace breast
