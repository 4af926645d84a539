// Libraries that a damaged file can crash, hang or make greedy do their work in a child process.
#pragma once

#include <functional>
#include <string>

namespace breast {

/// Runs `work` in a child process with limits on time and memory, its stderr silenced, and returns the
/// bytes it returned. An Error or lack of memory in the child is thrown here as Error (input), one
/// line as the child worded it; a child that dies or takes longer than `seconds` becomes Error (input)
/// beginning with `name`. Nothing else of what the child does reaches this process.
std::string in_guarded_child(const std::string& name, const std::function<std::string()>& work,
                             double seconds = 300);

}  // namespace breast
