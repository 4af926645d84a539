// SPDX-License-Identifier: GPL-3.0-or-later
// Springs at the cut through the tissue around the breast: skin and fascia are attached to the
// sternum, whereas the tissue around the rest of the breast is loose.
#pragma once

#include <memory>

#include "mechanics/wall_option.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// Springs of the stiffness k(1 − t²) + s t² per area, where t = max(0, n·m) for the outward normal
/// n of an imaged face and the direction m to the sternum; k and s are CutOption::stiffness and
/// sternal. They are two terms, so that either stiffness can be a parameter.
struct CutSprings {
  std::shared_ptr<const ElasticSupport> around;   ///< k(1 − t²), or k if there is no s
  std::shared_ptr<const ElasticSupport> sternal;  ///< s t², or null
};

/// Null pointers for an option other than Cut::spring and for a mesh without cut faces.
CutSprings springs_at_cut(const HexMesh& mesh, const CutOption& cut);

}  // namespace breast
