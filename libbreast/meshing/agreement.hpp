// SPDX-License-Identifier: GPL-3.0-or-later
// Check that a geometry and labels describe the same body.
#pragma once

#include <optional>
#include <string>

#include "meshing/body_mesh.hpp"
#include "meshing/tissue.hpp"

namespace breast {

/// What is wrong where the body between the sheets and the breast of the labels differ by more than
/// 2 % in volume, or more than 5 % of that breast lies outside: one sentence, else nothing. What the
/// flat faces of a coarse mesh cut off is not counted; too_coarse() reports it.
std::optional<std::string> mismatch(const BodyMeshReport& body, const TissueReport& tissue);

/// A warning where the mesh's flat faces lose more than 2 % of the volume between the sheets.
std::optional<std::string> too_coarse(const BodyMeshReport& body);

}  // namespace breast
