// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of VTK XML files that VTK's readers omit before they follow null pointers.
#pragma once

#include <filesystem>
#include <string>

namespace breast {

/// Throws Error (input) if the file is absent, truncated, not a VTK XML file of `type` ("PolyData",
/// "ImageData"), or has attributes with which the readers of VTK 9.1 crash. Needs an existing
/// VtkMessages.
void check_xml(const std::filesystem::path& file, const std::string& type);

/// The text written by VTK, with a comment near its end that contains the SHA-256 of everything
/// before it; check_xml refuses a file that no longer agrees with it.
std::string sealed_xml(std::string text);

}  // namespace breast
