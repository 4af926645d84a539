// MatchLookup -> HDF5 file (schema "lookup/1"). HDF5 only.
#pragma once

#include <filesystem>

#include "matching/lookup.hpp"

namespace breast {

void write_lookup(const std::filesystem::path& file, const MatchLookup& lookup);

}  // namespace breast
