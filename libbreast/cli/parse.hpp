// SPDX-License-Identifier: GPL-3.0-or-later
// Parsing of a command line into the declared arguments, with all checks that do not open a file.
#pragma once

#include <string>
#include <vector>

#include "cli/declaration.hpp"

namespace breast {

/// Raw values per argument: first the positionals in order, then options by name.
struct Tokens {
  std::vector<std::string> positionals;
  struct Option {
    std::string name;  ///< as declared (label)
    std::vector<std::string> values;
    int times = 0;
  };
  std::vector<Option> options;
  std::vector<std::string> unknown;  ///< undeclared options
  std::string problem;               ///< another error in the command line, empty if none
};
/// Splits the command line by the declared names (CLI11).
Tokens tokenize(const Declaration& tool, const std::vector<std::string>& arguments);

/// The option or common option of that name; null if it was not declared.
Argument* find_option(Declaration& tool, const std::string& label);

/// Checks kinds, ranges, choices and counts and stores the values; throws Error (input) that states
/// the given value and the valid ones.
void assign(Declaration& tool, const Tokens& tokens);

/// Checks that inputs exist, are files or folders and are readable, and that outputs have an
/// extension of their format and a writable folder, are not inputs (nor in an input folder, nor
/// named by another argument) and replace nothing but an older result of libbreast. Devices, pipes
/// and streams such as /dev/stdout are outputs of any format. Throws Error (input).
void check_paths(const Declaration& tool, const Tokens& tokens);

/// "tool arguments" with folders removed from every path and without the common options, as stored
/// in the history of an output.
std::string history_command(const Declaration& tool, const std::vector<std::string>& arguments);

}  // namespace breast
