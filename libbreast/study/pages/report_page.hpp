// SPDX-License-Identifier: GPL-3.0-or-later
// The report of a finished case as one self-contained HTML page; its pictures are inline, so that
// the page can be sent.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/warnings.hpp"

namespace breast {

struct ReportContext {
  std::filesystem::path runs;  ///< folder of all runs, with stability/ and compare/
  std::vector<Advice> advice;
  std::vector<std::string> limits;  ///< what is not reproduced, and why, one paragraph each
  /// Sentence beside the rows that were fitted to the paper; may be empty.
  std::string calibration;
  std::string made;  ///< time, version and machine of the run
};
/// All text from reports, tables and settings is escaped, and no folder is named. Throws Error
/// (input) naming a file that is not a report.
std::string report_page(const std::filesystem::path& run, const ReportContext& context);

}  // namespace breast
