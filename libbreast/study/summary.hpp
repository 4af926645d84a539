// SPDX-License-Identifier: GPL-3.0-or-later
// What a finished case says, as text for a terminal.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/stage_report.hpp"
#include "study/warnings.hpp"

namespace breast {

/// Where a mesh's tumour comes from, as hexmesh reports it: "none", "artificial" or "given".
std::string tumour_origin(const StageReport& mesh);

/// Tab-separated text as columns of equal width, two blanks before each; comments are left out.
std::string aligned(const std::string& tsv);
/// Lines of at most `width` bytes, broken after blanks where there are any.
std::string folded(const std::string& text, std::size_t width);

struct SummaryContext {
  std::vector<Advice> advice;
  std::filesystem::path phantom;  ///< its report, for the truth's own error; may be empty
  std::string
      calibration;  ///< a sentence beside the rows that were fitted to the paper's; may be empty
};
/// First what its stages warned of, each warning once, with what to do; then landmark displacements, errors against the truth when
/// there is one, compressions, the MLO curve, and where the pictures are.
std::string summary_text(const std::filesystem::path& run, const SummaryContext& context);

}  // namespace breast
