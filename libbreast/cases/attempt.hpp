// SPDX-License-Identifier: GPL-3.0-or-later
// A stage of a variant, which may have no solution.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

/// Runs the stage `command`, which writes the report STAGE.json and the files of that name. Where it does not converge (exit 3)
/// its report says why and is the result; where one of `inputs` was not found for such a reason, that input's report becomes this
/// one's. Either way nothing else of the stage is left. Throws Error (failed) for any other failure.
void attempt(const std::filesystem::path& report, const std::vector<std::filesystem::path>& inputs,
             const std::vector<std::string>& command);

}  // namespace breast
