// SPDX-License-Identifier: GPL-3.0-or-later
// Text for make: the makefile calls the tool `cases` while it is read, and evaluates the answer as
// assignments.
#pragma once

#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// Replaces the line break in answers to make, because $(shell) turns line breaks into blanks
/// (pipelines/settings.mk). No name or value may contain this byte.
inline constexpr char make_line_end = '\x1e';

/// The text "NAME := VALUE", ended by make_line_end.
std::string make_assignment(const std::string& name, const std::string& value);
/// The text "NAME += VALUE", ended by make_line_end.
std::string make_addition(const std::string& name, const std::string& value);

/// Returns, for every row of a table, the assignments cell_COLUMN := CELL, empty without a value,
/// and an evaluation of the variable `name`, whose text refers to them. Throws Error (input),
/// naming the table, for a character that make would interpret as code.
std::string rows_for_make(const Table& table, const std::string& name);

/// The first character of `text` that a shell or make would interpret as code; "" if there is none.
std::string code_in(const std::string& text);

/// True if `text` has a control character, of which make_line_end is one.
bool has_control(const std::string& text);

/// The text "; did you mean X?" for the candidate X of which `word` is probably a misspelling;
/// upper and lower case are not distinguished. Returns "" if no candidate is near enough.
std::string suggestion(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace breast
