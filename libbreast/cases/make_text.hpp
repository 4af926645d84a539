// SPDX-License-Identifier: GPL-3.0-or-later
// Lines for make: what the makefile asks for while it is read, it takes as assignments.
#pragma once

#include <string>
#include <vector>

namespace breast {

/// $(shell) turns line breaks into blanks: this byte, which no name or value may hold, stands for them
/// (pipelines/check-settings.mk).
inline constexpr char make_line_end = '\x1e';

/// "NAME := VALUE", ended.
std::string make_assignment(const std::string& name, const std::string& value);
/// "NAME += VALUE", ended.
std::string make_addition(const std::string& name, const std::string& value);

/// The first character of `text` that is code to a shell or to make; "" without one.
std::string code_in(const std::string& text);

/// "; did you mean X?" for the candidate that a slip of the fingers turned into `word`, whatever the letters' case; "" without one.
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace breast
