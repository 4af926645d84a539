// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/completion.hpp"

#include <cctype>
#include <sstream>

#include "cli/declaration.hpp"
#include "command/child.hpp"
#include "command/commands.hpp"
#include "command/pipeline_run.hpp"
#include "command/request.hpp"

namespace breast {

namespace {

// The options of a tool or command as help_completion lists them.
std::string options_of(const Installation& installation, const std::string& command) {
  if (is_pipeline_command(command)) return help_completion(pipeline_command(command));
  if (installation.has(command))
    return capture_child({installation.tool(command).string(), "--help-completion"}).out;
  return "";
}

struct Options {
  std::vector<std::string> names;
  std::vector<std::string> choices;  // of the option asked for
  bool wants_value = false;          // the option asked for takes one
};

// Lines "--name<TAB>kind<TAB>choice choice".
Options read_options(const std::string& text, const std::string& asked) {
  Options options;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::string name, kind;
    fields >> name >> kind;
    options.names.push_back(name);
    if (name != asked || kind == "flag") continue;
    options.wants_value = true;
    for (std::string choice; fields >> choice;) options.choices.push_back(choice);
  }
  return options;
}

}  // namespace

std::vector<std::string> completions(const Installation& installation,
                                     const std::vector<std::string>& words) {
  if (words.size() < 2) {
    std::vector<std::string> names = command_names();
    for (const std::string& tool : installation.tool_names()) names.push_back(tool);
    return names;
  }
  const std::string& command = words.front();
  if (command == "help") {
    std::vector<std::string> names = completions(installation, {""});
    names.push_back("settings");
    return words.size() == 2 ? names : std::vector<std::string>{};
  }
  // bash splits "--element=q1p0" at the equals sign.
  std::size_t before = words.size() - 2;
  if (words.back() == "=" || words[before] == "=")
    before -= words[before] == "=" && before > 0 ? 1 : 0;
  Options options = read_options(options_of(installation, command), words[before]);
  if (options.wants_value) return options.choices;
  if (words.back().starts_with("-")) return options.names;
  // A setting begins with a capital; anything else is a file.
  if (!is_pipeline_command(command) || !std::isupper((unsigned char)(words.back() + " ")[0]))
    return {};
  std::vector<std::string> settings = pipeline_settings(installation);
  for (std::string& setting : settings) setting += "=";
  return settings;
}

}  // namespace breast
