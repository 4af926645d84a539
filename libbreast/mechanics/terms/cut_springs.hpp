// SPDX-License-Identifier: GPL-3.0-or-later
// Springs at the cut through the tissue around the breast: skin and fascia are attached to the
// sternum, whereas the tissue around the rest of the breast is loose.
#pragma once

#include <memory>

#include "mechanics/terms/attachment.hpp"
#include "mechanics/wall_option.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// Springs of the stiffness k per area in all directions, and an attachment to the sternum with the
/// stiffness s t², where t = max(0, n·m) for the outward normal n of an imaged face and the direction m
/// to the sternum; k and s are CutOption::stiffness and sternal.
struct CutSprings {
  std::shared_ptr<const NodeSprings> around;
  std::shared_ptr<const NodeSprings> sternal;  ///< null if there is no s
};

/// Null pointers for an option without springs and for a mesh without cut faces.
CutSprings springs_at_cut(const HexMesh& mesh, const CutOption& cut);

}  // namespace breast
