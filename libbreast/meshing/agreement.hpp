// SPDX-License-Identifier: GPL-3.0-or-later
// Check that a geometry and labels describe the same body.
#pragma once

#include <optional>
#include <string>

#include "meshing/body_mesh.hpp"
#include "meshing/tissue.hpp"

namespace breast {

/// One sentence if the body between the sheets and the labelled breast differ by more than 2 % in
/// volume, or if more than 5 % of that breast lies outside; otherwise no value. The volume lost by
/// the flat faces of a coarse mesh is not included; too_coarse() reports it.
std::optional<std::string> mismatch(const BodyMeshReport& body, const TissueReport& tissue);

/// A warning if the mesh's flat faces lose more than 2 % of the volume between the sheets.
std::optional<std::string> too_coarse(const BodyMeshReport& body);

}  // namespace breast
