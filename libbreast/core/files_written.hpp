// SPDX-License-Identifier: GPL-3.0-or-later
// What this process has written, for a tool that fails after some of its outputs.
#pragma once

#include <filesystem>
#include <vector>

namespace breast {

/// The targets that write_bytes has replaced in this process, in their order; streams are none.
std::vector<std::filesystem::path> files_written();

}  // namespace breast
