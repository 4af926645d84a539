// SPDX-License-Identifier: GPL-3.0-or-later
// File names for make and its shell: those that can be used directly, and substitutes for the
// others.
#pragma once

#include <filesystem>
#include <string>

namespace breast {

/// True for a path that make and a shell read as a plain name: no blank, no control character, none
/// of the characters that pipelines/check-settings.mk refuses, no dash in front, and valid UTF-8.
bool plain_for_make(const std::string& path);

/// `name` with every character that is not plain replaced by an underscore.
std::string plain_name(const std::string& name);

/// A path of `given` for make, run in the present folder: as given, or relative to that folder, where that is plain; else a link in
/// `links`, which is created: of a file or folder whose own name is plain the folder above it is linked (a detached header
/// keeps its data beside it). A folder with a file whose name is not plain (slices of a scan) is linked file by file. The link is the
/// same whenever the file is. Throws Error (input) for a detached header whose own name is not plain, and where `given` does not exist.
std::string name_for_make(const std::filesystem::path& given, const std::filesystem::path& links);

}  // namespace breast
