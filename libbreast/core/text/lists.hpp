// SPDX-License-Identifier: GPL-3.0-or-later
// Lists as one text: their elements with a separator between them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace breast {

/// The parts of the text between the separators; an empty text has one empty part.
std::vector<std::string> split(std::string_view text, char separator);
/// The elements of `parts`, separated by `between`.
std::string join(const std::vector<std::string>& parts, const std::string& between);

}  // namespace breast
