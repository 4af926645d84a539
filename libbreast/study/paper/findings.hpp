// SPDX-License-Identifier: GPL-3.0-or-later
// How far numerical choices move the paper's figures, and which of ours were fitted to the paper's.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// A row for the paper, the case as solved and every variant of RUN/studies/findings (study/places.hpp) (the last one is the finest): displacements
/// of nipple and tumour from the imaged place, stress-free and supine, mm; the supine ones against the finest, per cent; the
/// solve's own error estimate of the supine landmarks, mm; slopes by fat.
Table findings_table(const std::filesystem::path& run, const std::vector<std::string>& variants);

/// A sentence for a phantom whose preset was fitted to the answer of the chain; "" for any other. `truth`: report of phantom.
std::string calibration_note(const std::filesystem::path& truth, const std::string& side);
/// Motions from the prone shape, mm: the paper, as printed, as solved, the truth (`landmarks`: the phantom's table).
Table calibration_table(const std::filesystem::path& run, const std::filesystem::path& truth,
                        const std::string& side, const Table& landmarks);

}  // namespace breast
