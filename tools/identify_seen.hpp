// SPDX-License-Identifier: GPL-3.0-or-later
// What identify is shown of the second posture, brought into the frame of the mesh.
#pragma once

#include <optional>

#include "identification/identify.hpp"
#include "identification/wall_alignment.hpp"
#include "identify_options.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

struct SecondScan {
  Observations seen;
  std::vector<SeenPoint> judged;      ///< not fitted
  std::optional<WallAlignment> ribs;  ///< of the scans
  TriMesh surface;                    ///< as read, in the frame of the mesh
};

/// Reads and checks all that was given. Throws Error (input).
SecondScan read_second_scan(const IdentifyChoices& choices, const HexMesh& mesh);

/// The surface in the frame of the answer: moved by what was left of the rib cage's motion too.
TriMesh seen_beside(const SecondScan& scan, const Identified& found);

}  // namespace breast
