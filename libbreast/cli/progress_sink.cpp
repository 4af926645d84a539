// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/progress_sink.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "cli/library_words.hpp"
#include "core/table.hpp"

namespace breast {

namespace {
constexpr double quiet_start_s = 2;     // nothing before this
constexpr double line_interval_s = 10;  // a line this often within one stage
constexpr double redraw_interval_s = 0.1;

std::size_t terminal_width() {
  winsize size{};
  return ioctl(message_descriptor(), TIOCGWINSZ, &size) == 0 && size.ws_col > 20 ? size.ws_col : 80;
}
}  // namespace

StderrProgress::StderrProgress(std::string tool, bool quiet)
    : tool_(std::move(tool)), quiet_(quiet), terminal_(isatty(message_descriptor()) != 0) {}

double StderrProgress::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

void StderrProgress::update(std::string_view stage, double fraction, std::string_view detail) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  const double now = seconds();
  const bool new_stage = stage != stage_;
  const std::optional<double> left = left_.update(stage, fraction, now);
  if (terminal_) {
    if (!new_stage && now - last_line_ < redraw_interval_s) return;
    draw_bar(stage, fraction, left, detail);
  } else {
    if (now < quiet_start_s) return;
    if (now - last_line_ < (new_stage ? 1.0 : line_interval_s)) return;
    show_notes();
    std::string line = tool_ + ": " + std::string(stage);
    if (fraction >= 0) line += " " + format_fixed(100 * std::min(fraction, 1.0), 0) + " %";
    if (left) line += ", " + time_left_text(*left);
    if (!detail.empty()) line += ", " + std::string(detail);
    dprintf(message_descriptor(), "%s\n", line.c_str());
  }
  stage_ = stage;
  last_line_ = now;
}

void StderrProgress::draw_bar(std::string_view stage, double fraction, std::optional<double> left,
                              std::string_view detail) {
  std::string line = std::string(stage) + " ";
  if (fraction >= 0) {
    constexpr int width = 24;
    const int full = int(std::min(fraction, 1.0) * width);
    line = "[" + std::string(full, '#') + std::string(width - full, ' ') + "] " + line;
  }
  if (left) line += time_left_text(*left) + (detail.empty() ? "" : ", ");
  line += detail;
  line.resize(std::min(line.size(), terminal_width() - 1));
  dprintf(message_descriptor(), "\r\033[K%s", line.c_str());
  bar_shown_ = true;
}

void StderrProgress::clear_bar() {
  if (bar_shown_) dprintf(message_descriptor(), "\r\033[K");
  bar_shown_ = false;
}

void StderrProgress::note(std::string_view text) {
  if (quiet_) return;
  const std::lock_guard lock(mutex_);
  held_.emplace_back(text);
  if (seconds() < quiet_start_s) return;
  clear_bar();
  show_notes();
}

void StderrProgress::show_notes() {
  for (const std::string& text : held_)
    dprintf(message_descriptor(), "%s: %s\n", tool_.c_str(), text.c_str());
  held_.clear();
}

void StderrProgress::finish(bool success) {
  const std::lock_guard lock(mutex_);
  clear_bar();
  if (success) show_notes();
  held_.clear();
}

}  // namespace breast
