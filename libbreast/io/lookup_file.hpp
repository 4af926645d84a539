// SPDX-License-Identifier: GPL-3.0-or-later
// Writing of a MatchLookup as an HDF5 file (schema "lookup/1"), with HDF5 only.
#pragma once

#include <filesystem>

#include "matching/lookup.hpp"

namespace breast {

/// `back`, the points of the second image, is written to a group of its own.
void write_lookup(const std::filesystem::path& file, const MatchLookup& lookup,
                  const MatchLookup* back = nullptr);

}  // namespace breast
