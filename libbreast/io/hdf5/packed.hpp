// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of a Document to bytes, for the transfer from a reading child process to its parent;
// private to io/hdf5.
#pragma once

#include <string>
#include <string_view>

#include "io/hdf5/document.hpp"

namespace breast {

std::string packed(const Document& document);
/// Throws Error (failed) for bytes that packed() did not make.
Document unpacked(std::string_view bytes);

}  // namespace breast
