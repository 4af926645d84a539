// SPDX-License-Identifier: GPL-3.0-or-later
// Display of progress on stderr: a bar on a terminal, occasional lines otherwise, nothing with
// --quiet.
#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "cli/time_left.hpp"
#include "core/progress.hpp"

namespace breast {

/// Delays notes and lines for the first seconds, so that a run that fails at once because of bad
/// input prints only one line, the error.
class StderrProgress final : public Progress {
 public:
  StderrProgress(std::string tool, bool quiet);
  void update(std::string_view stage, double fraction, std::string_view detail) override;
  void note(std::string_view text) override;
  /// Shows the delayed notes after success, discards them after failure, and clears the bar.
  void finish(bool success);

 private:
  void draw_bar(std::string_view stage, double fraction, std::optional<double> left,
                std::string_view detail);
  void clear_bar();
  void show_notes();
  double seconds() const;

  std::string tool_, stage_;
  bool quiet_, terminal_, bar_shown_ = false;
  double last_line_ = -1e9;
  std::vector<std::string> held_;
  TimeLeft left_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
};

}  // namespace breast
