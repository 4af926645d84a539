// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/tool.hpp"

#include <ctime>

namespace breast {

namespace {

/// Now, in universal time: "2008-10-31T09:30:00Z".
std::string date_and_time() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace

Run::Run(std::string tool, std::string command, Progress& progress)
    : tool_(std::move(tool)),
      command_(std::move(command)),
      progress_(progress),
      start_(std::chrono::steady_clock::now()) {
  report_.set("tool", tool_);
  report_.set("version", BREAST_VERSION);
  report_.set("command", command_);
  report_.set("inputs", std::vector<std::string>{});
  report_.set("date", date_and_time());
  report_.set("status", "ok");
  report_.set("reason", "");
}

History Run::history(const std::vector<Input>& inputs) const {
  HistoryEntry entry{tool_, BREAST_VERSION, command_, {}};
  std::vector<const History*> earlier;
  for (const Input& input : inputs) {
    std::filesystem::path name = input.file;
    if (!name.has_filename()) name = name.parent_path();  // a DICOM folder given as "scan/"
    entry.inputs.push_back({name.filename().string(), input.sha256});
    if (input.history) earlier.push_back(input.history);
  }
  return extend_history(earlier, entry);
}

void Run::warn(const std::string& text) {
  report_.append("warnings", text);
  progress_.note("warning: " + text);
}

void Run::remark(const std::string& text) {
  report_.append("remarks", text);
  progress_.note(text);
}

void Run::print(const std::string& text) {
  printed_ += text;
}

double Run::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

}  // namespace breast
