// SPDX-License-Identifier: GPL-3.0-or-later
// Material sets with the changes that the studies make.
#pragma once

#include <string>

#include "core/table.hpp"

namespace breast {

/// A copy of `set` with one change. `fat-only`: fibroglandular tissue has the law of fat.
/// `columns`: the three columns of second-order constants in Table II, a20, a02 and a11, are taken
/// for a11, a20 and a02, as Samani and Plewes are sometimes quoted. Throws Error (input) for any
/// other change, and if the set lacks a row or column that the change needs.
Table changed_set(const Table& set, const std::string& change);

}  // namespace breast
