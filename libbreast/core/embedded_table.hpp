// SPDX-License-Identifier: GPL-3.0-or-later
// A table that is compiled into the program, so that no path is needed at run time (cmake/embedded.cmake).
#pragma once

#include <string_view>

namespace breast {

struct EmbeddedTable {
  std::string_view name, text;  ///< name of the file without its ending
};

}  // namespace breast
