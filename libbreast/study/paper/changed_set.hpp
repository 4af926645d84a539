// SPDX-License-Identifier: GPL-3.0-or-later
// Material sets as the studies change them.
#pragma once

#include <string>

#include "core/table.hpp"

namespace breast {

/// `fat-only`: the fibroglandular law is fat's. `columns`: Table II's second-order constants as Samani and Plewes are sometimes
/// quoted, its three columns standing for a11, a20, a02 instead of a20, a02, a11. Throws Error (input) for any other name, and where
/// the set has no such row or column.
Table changed_set(const Table& set, const std::string& change);

}  // namespace breast
