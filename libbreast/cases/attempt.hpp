// SPDX-License-Identifier: GPL-3.0-or-later
// Execution of a stage of a variant, which may have no solution.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

/// Runs `command`, which computes a stage and writes its report, STAGE.json, and files of the same
/// name. Such files of an earlier run are removed first. A solve that does not converge (exit code
/// 3) is a valid result: its report states the reason. If one of `inputs` does not exist because an
/// earlier stage did not converge, the command is not run, and the report of that input is copied
/// to `report`. Throws Error (failed) if the command ends with any other exit code, or with 3 and
/// without a report.
void attempt(const std::filesystem::path& report, const std::vector<std::filesystem::path>& inputs,
             const std::vector<std::string>& command);

}  // namespace breast
