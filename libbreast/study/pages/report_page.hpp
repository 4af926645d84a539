// SPDX-License-Identifier: GPL-3.0-or-later
// One self-contained HTML page of a finished case; its pictures are inline, so that the page can be sent.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "study/warnings.hpp"

namespace breast {

struct ReportContext {
  std::filesystem::path runs;  ///< beside the case: stability/, compare/
  std::vector<Advice> advice;
  std::vector<std::string> limits;  ///< what is not reproduced, and why, a paragraph each
  std::string calibration;  ///< said beside the rows that were fitted to the paper's; may be empty
  std::string made;         ///< when, by which version, on which machine
};
/// Every text of reports, tables and settings is escaped, no folder is named. Throws Error (input) naming a report that is none.
std::string report_page(const std::filesystem::path& run, const ReportContext& context);

}  // namespace breast
