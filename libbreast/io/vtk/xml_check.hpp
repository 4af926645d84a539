// The checks VTK's XML readers do not make before they follow null pointers.
#pragma once

#include <filesystem>
#include <string>

namespace breast {

/// Throws Error (input) when the file is absent, cut, not a VTK XML file of `type` ("PolyData",
/// "ImageData"), or has attributes the readers of VTK 9.1 do not survive. Needs VtkMessages alive.
void check_xml(const std::filesystem::path& file, const std::string& type);

/// Puts a comment with the SHA-256 of all before it into the last lines of a file VTK wrote;
/// check_xml refuses a file that no longer fits it.
void seal_xml(const std::filesystem::path& file);

}  // namespace breast
