// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/error.hpp"

namespace breast {

std::string joined(std::initializer_list<Piece> pieces) {
  std::ostringstream out;
  for (const Piece& piece : pieces) piece.print(out);
  return out.str();
}

}  // namespace breast
