// SPDX-License-Identifier: GPL-3.0-or-later
// The effect of numerical choices on the paper's results, and the comparison with results to which
// the phantom was fitted.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// One row for the paper, the case as solved, and every variant of RUN/studies/findings, of which
/// the last has the finest mesh. Columns: displacements of nipple and tumour from the imaged
/// position, stress-free and supine, mm; the difference of the supine displacements from the
/// finest, per cent; the solver's own error estimate at the supine landmarks, mm; slopes with
/// respect to fat.
Table findings_table(const std::filesystem::path& run, const std::vector<std::string>& variants);

/// A sentence for a phantom with a preset that was fitted to results of the chain; "" for any other
/// phantom. `truth` is the report of phantom.
std::string calibration_note(const std::filesystem::path& truth, const std::string& side);
/// Motion from the prone shape in mm: in the paper, with the model as printed, as solved, and in
/// the truth (`landmarks`, the phantom's table).
Table calibration_table(const std::filesystem::path& run, const std::filesystem::path& truth,
                        const std::string& side, const Table& landmarks);

}  // namespace breast
