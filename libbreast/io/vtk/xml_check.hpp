// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of VTK XML files that VTK's readers omit before they follow null pointers.
#pragma once

#include <filesystem>
#include <string>

namespace breast {

/// Throws Error (input) when the file is absent, cut, not a VTK XML file of `type` ("PolyData",
/// "ImageData"), or has attributes the readers of VTK 9.1 do not survive. Needs VtkMessages alive.
void check_xml(const std::filesystem::path& file, const std::string& type);

/// What VTK wrote, with a comment holding the SHA-256 of all before it in its last lines; check_xml
/// refuses a file that no longer fits it.
std::string sealed_xml(std::string text);

}  // namespace breast
