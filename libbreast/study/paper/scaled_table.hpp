// SPDX-License-Identifier: GPL-3.0-or-later
// Tables II to VI of Pathmanathan et al. (2008), with our results beside the paper's.
#pragma once

#include <filesystem>
#include <string>

#include "core/table.hpp"
#include "study/shape.hpp"

namespace breast {

/// One of Tables III to VI. The rows are the stiffnesses (per cent) of the paper's table; our
/// results are read from PREFIX-PERCENT-supine.vtkhdf, and from `base` for 100. Columns, for the
/// displacement and for its difference from the base, in mm: ours, the paper's, the difference; the
/// solver's own estimate of its discretisation error; remark: `calibrated` in the row of 100. "-":
/// the material has no solution (PREFIX-PERCENT failed). Throws Error (failed) naming a file that
/// is missing.
Table scaled_table(const Table& paper, const std::filesystem::path& prefix,
                   const std::filesystem::path& base, const ShapeReader& read,
                   const std::string& calibrated);

/// Table II: the polynomial constants of a material set beside the paper's, Pa.
Table constants_table(const Table& paper, const Table& materials);

}  // namespace breast
