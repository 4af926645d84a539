// SPDX-License-Identifier: GPL-3.0-or-later
// breast: all tools and the pipeline under one name.
#include <cstdio>
#include <filesystem>
#include <new>

#include "breast_tools.hpp"
#include "command/child.hpp"
#include "command/commands.hpp"
#include "command/completion.hpp"
#include "command/pipeline_run.hpp"
#include "command/request.hpp"
#include "core/error.hpp"

using namespace breast;

namespace {

std::string lines_of(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += word + "\n";
  return text;
}

int print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw failed_error("stdout cannot be written");
  return 0;
}

int help(const Installation& installation, const std::vector<std::string>& rest) {
  if (rest.empty()) return print(overview(installation));
  if (is_pipeline_command(rest[0])) return print(help_text(pipeline_command(rest[0])));
  if (rest[0] == "settings") return print(settings_help(installation));
  if (installation.has(rest[0])) become(installation.tool(rest[0]), {"--help"});
  if (rest[0] == "help" || rest[0] == "list") return print(overview(installation));
  throw input_error(unknown_command(installation, rest[0]));
}

int run(const Installation& installation, const std::string& command,
        std::vector<std::string> rest) {
  if (command == "--help" || command == "-h" || command == "help") return help(installation, rest);
  if (command == "--version")
    return print(std::string("breast (libbreast) ") + BREAST_VERSION + "\n");
  if (command == "list") return print(tool_list(installation));
  if (command == "--help-man") return print(help_man(breast_declaration()));
  if (command == "--help-markdown") return print(help_markdown(breast_declaration()));
  if (command == "--completions") return print(lines_of(completions(installation, rest)));
  if (installation.has(command)) become(installation.tool(command), rest);
  if (!is_pipeline_command(command)) throw input_error(unknown_command(installation, command));
  for (const std::string& word : rest) {
    if (word == "--help") return help(installation, {command});
  }
  return run_pipeline(installation, command, rest);
}

}  // namespace

int main(int argc, char** argv) {
  std::string who = "breast";
  try {
    const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
    const Installation installation =
        find_installation(std::filesystem::read_symlink("/proc/self/exe"), built_tools());
    if (words.empty()) throw input_error("give a command or a tool; `breast help` lists them");
    if (is_pipeline_command(words.front())) who += " " + words.front();
    return run(installation, words.front(), {words.begin() + 1, words.end()});
  } catch (const Error& error) {
    std::fprintf(stderr, "%s: %s\n", who.c_str(), error.what());
    return error.exit_code();
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "%s: out of memory\n", who.c_str());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", who.c_str(), error.what());
    return 1;
  }
}
