// A choice on a benchmark's command line.
#pragma once

#include <string>
#include <vector>

#include "core/error.hpp"

namespace breast {

/// The value, where it is one of the choices; else throws Error (input) naming the option.
inline std::string one_of(const std::string& name, const std::string& value,
                   const std::vector<std::string>& choices) {
  for (const std::string& choice : choices) {
    if (choice == value) return value;
  }
  throw input_error(name, " '", value, "' is unknown");
}

}  // namespace breast
