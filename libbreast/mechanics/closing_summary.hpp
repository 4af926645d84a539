// The end of a mechanics run for people: its report in a few short lines.
#pragma once

#include <string>
#include <vector>

#include "core/progress.hpp"
#include "core/report.hpp"

namespace breast {

/// What was solved (elements, unknowns, law of every tissue), how it converged, what it cost and
/// how accurate it is, from a report filled by write_report. Phases with their seconds come from
/// `timer`. What to doubt is not among the lines.
std::vector<std::string> closing_summary(const Report& report, const Timer& timer);

/// Tells these lines as notes.
void tell_summary(const Report& report, const Timer& timer, Progress& progress);

}  // namespace breast
