// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/attempt.hpp"

#include "cli/library_words.hpp"
#include "command/child.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "study/stage_report.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

fs::path with_ending(fs::path file, const char* ending) {
  return file.replace_extension(ending);
}

}  // namespace

void attempt(const fs::path& report, const std::vector<fs::path>& inputs,
             const std::vector<std::string>& command) {
  for (const char* ending : {".vtkhdf", ".vtp", ".tsv", ".json"})
    fs::remove(with_ending(report, ending));
  for (const fs::path& input : inputs) {
    if (fs::exists(input)) continue;
    fs::copy_file(with_ending(input, ".json"), report);
    return;
  }
  constexpr int not_converged = 3;
  const int code = run_child_to(command, -1, message_descriptor());
  // A program that is not part of libbreast may write no report.
  if (code == 0 && !has_something(report)) write_text(report, "{\n  \"status\": \"ok\"\n}\n");
  if (code != 0 && !(code == not_converged && has_something(report)))
    throw failed_error(command.front(), " ended with exit code ", code);
}

}  // namespace breast
