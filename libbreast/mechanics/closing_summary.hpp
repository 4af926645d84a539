// SPDX-License-Identifier: GPL-3.0-or-later
// The closing summary of a mechanics run: its report in a few short lines.
#pragma once

#include <string>
#include <vector>

#include "core/progress.hpp"
#include "core/report.hpp"

namespace breast {

/// What was solved (elements, unknowns, law of every tissue), how it converged, what it cost and
/// how accurate it is, from a report filled by write_report. Phases with their seconds come from
/// `timer`; `results` are further lines from the tool, such as the plates' forces. Doubts are not
/// included.
std::vector<std::string> closing_summary(const Report& report, const Timer& timer,
                                         const std::vector<std::string>& results = {});

/// Sends these lines to `progress` as notes.
void tell_summary(const Report& report, const Timer& timer, Progress& progress,
                  const std::vector<std::string>& results = {});

}  // namespace breast
