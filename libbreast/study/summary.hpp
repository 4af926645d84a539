// SPDX-License-Identifier: GPL-3.0-or-later
// The results of a finished case as text for a terminal.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/stage_report.hpp"
#include "study/warnings.hpp"

namespace breast {

/// The origin of a mesh's tumour as reported by hexmesh: "none", "artificial" or "given".
std::string tumour_origin(const StageReport& mesh);

/// Tab-separated text as columns of equal width, each preceded by two blanks; comments are omitted.
std::string aligned(const std::string& tsv);
/// The text in lines of at most `width` bytes, broken at blanks if there are any.
std::string folded(const std::string& text, std::size_t width);

struct SummaryContext {
  std::vector<Advice> advice;
  /// Report of the phantom, for the error of the truth; may be empty.
  std::filesystem::path phantom;
  std::string
      calibration;  ///< a sentence beside the rows that were fitted to the paper's; may be empty
};
/// The warnings of the stages, each once and with advice; then landmark displacements, errors
/// against the truth if there is one, compressions, the MLO curve, and the locations of the
/// pictures.
std::string summary_text(const std::filesystem::path& run, const SummaryContext& context);

}  // namespace breast
