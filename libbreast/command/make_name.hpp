// SPDX-License-Identifier: GPL-3.0-or-later
// File names for make and its shell: those that can be used directly, and substitutes for the
// others.
#pragma once

#include <filesystem>
#include <string>

namespace breast {

/// True for a path that make and a shell read as a plain name: no blank, no control character, none
/// of the characters that `cases settings` refuses in names, no dash in front, and valid UTF-8.
bool plain_for_make(const std::string& path);

/// `name` with every character that is not plain replaced by an underscore.
std::string plain_name(const std::string& name);

/// A path of `given` for make, run in the present folder. It is `given` itself, or relative to that
/// folder, if that is plain; otherwise it is a link in `links`, which is created. If a file or
/// folder has a plain name of its own, the folder above it is linked (so that a detached header
/// keeps its data beside it). A folder that contains a file with a name that is not plain (slices
/// of a scan) is linked file by file. The link is the same whenever the file is. Throws Error
/// (input) for a detached header with a name that is not plain, and if `given` does not exist.
std::string name_for_make(const std::filesystem::path& given, const std::filesystem::path& links);

}  // namespace breast
