// SPDX-License-Identifier: GPL-3.0-or-later
// Command line of a benchmark: options with a value each, and numbers of elements along an edge.
#pragma once

#include <cstdlib>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace breast {

/// The value, where it is one of the choices; else throws Error (input) naming the option.
inline std::string one_of(const std::string& name, const std::string& value,
                          const std::vector<std::string>& choices) {
  for (const std::string& choice : choices) {
    if (choice == value) return value;
  }
  throw input_error(name, " '", value, "' is unknown");
}

/// What each option does with its value.
using BenchOptions = std::map<std::string, std::function<void(const std::string& value)>>;

/// Hands every option its value and returns the numbers of elements, `otherwise` without any; sees
/// to it that threads wait as in the tools.
/// Throws Error (input) on what is neither an option nor a number from `least` to 128.
inline std::vector<int> read_command_line(int argc, char** argv, const BenchOptions& options,
                                          int least, const std::vector<int>& otherwise) {
  sleep_when_waiting(argv);
  std::vector<int> sizes;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    const auto option = options.find(word);
    if (option != options.end()) {
      if (++i == argc) throw input_error(word, " needs a value");
      option->second(argv[i]);
      continue;
    }
    const int size = std::atoi(word.c_str());
    if (size < least || size > 128) {
      throw input_error("'", word, "' is neither an option nor a number of elements from ", least,
                        " to 128");
    }
    sizes.push_back(size);
  }
  return sizes.empty() ? otherwise : sizes;
}

}  // namespace breast
