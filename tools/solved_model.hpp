// SPDX-License-Identifier: GPL-3.0-or-later
// The model with which a mechanics tool solves: that of its input file, with the options given.
#pragma once

#include <filesystem>

#include "cli/mechanics_options.hpp"
#include "cli/tool.hpp"
#include "mechanics/options.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// What `choices` give, over the model that `mesh`, read from `file`, states. One warning names every
/// part that differs from the stated model. Throws Error (input) if the file states none and `choices`
/// name no material set.
MechanicsOptions model_for(const MechanicsChoices& choices, const std::filesystem::path& file,
                           const HexMesh& mesh, Run& run);

/// Warns of every part in which the model that `mesh` states differs from `used`.
void warn_of_differences(const MechanicsOptions& used, const std::filesystem::path& file,
                         const HexMesh& mesh, Run& run);

}  // namespace breast
