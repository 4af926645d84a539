// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/commands.hpp"

#include <algorithm>

#include "command/request.hpp"

namespace breast {

namespace {

const std::vector<ToolEntry> commands = {
    {"run", "the whole chain on a breast MR scan"},
    {"demo", "the whole chain on a simulated breast whose truth is known"},
    {"cohort", "the whole chain on every case of a folder"},
    {"list", "list the tools, one per line"},
    {"help",
     "help on a command or a tool; `help settings` lists the targets and settings of "
     "the pipeline"}};

std::string aligned(const std::vector<ToolEntry>& entries, const std::string& indent) {
  std::size_t width = 0;
  for (const ToolEntry& entry : entries) width = std::max(width, entry.name.size());
  std::string text;
  for (const ToolEntry& entry : entries) {
    text += indent + entry.name;
    if (!entry.summary.empty())
      text += std::string(width - entry.name.size() + 2, ' ') + entry.summary;
    text += "\n";
  }
  return text;
}

Argument word(const std::string& placeholder, const std::string& help) {
  Argument argument;
  argument.placeholder = placeholder;
  argument.help = help;
  return argument;
}

}  // namespace

std::vector<std::string> command_names() {
  std::vector<std::string> names;
  for (const ToolEntry& command : commands) names.push_back(command.name);
  return names;
}

bool is_pipeline_command(const std::string& name) {
  return name == "run" || name == "demo" || name == "cohort";
}

Declaration breast_declaration() {
  Declaration d;
  d.name = "breast";
  d.summary =
      "from a breast MR scan to a mechanical model: all tools and the pipeline under one name";
  d.version = BREAST_VERSION;
  d.paragraphs = {
      "`breast TOOL` runs a tool of libbreast with its arguments, as in `breast segment "
      "scan.nrrd labels.vtkhdf --side left`. Each tool has a manual page, breast-TOOL. `breast "
      "list` lists them, `breast help TOOL` prints the help of one.",
      "`breast run SCAN --side left|right [SETTING=value]...` runs the whole chain on a scan, "
      "`breast demo` on a simulated breast, `breast cohort DIR` on every case file of a folder. "
      "They work from any folder; results are written to ./runs or to the folder given by "
      "--runs."};
  d.positionals = {word("COMMAND", "run, demo, cohort, list, help, or the name of a tool"),
                   word("ARGUMENT", "arguments of the command")};
  d.positionals.back().repeatable = true;
  d.options = pipeline_command("run").options;
  for (const Argument& option : pipeline_command("cohort").options) {
    const bool known = std::any_of(d.options.begin(), d.options.end(), [&](const Argument& other) {
      return other.names == option.names;
    });
    if (!known) d.options.push_back(option);
  }
  for (Argument& option : d.options) option.required = false;
  for (const std::string name : {"--help", "--version"}) {
    Argument flag;
    flag.kind = ArgumentKind::flag;
    flag.names = {name};
    flag.help = name == "--help" ? "the commands and tools" : "name and version";
    d.options.push_back(flag);
  }
  d.examples = {{"breast demo", "the whole chain on a simulated breast; results in ./runs/average"},
                {"breast run scan.nrrd --side left",
                 "the whole chain on a scan; results in ./runs/scan-left"},
                {"breast help compress", "the help of a tool"}};
  return d;
}

std::string tool_list(const Installation& installation) {
  return aligned(installation.tools, "");
}

std::string overview(const Installation& installation) {
  return "breast - " + breast_declaration().summary +
         "\n\nUsage: breast COMMAND|TOOL [ARGUMENT]...\n\nCommands:\n" + aligned(commands, "  ") +
         "\nTools:\n" + aligned(installation.tools, "  ") +
         "\nThe chain, which `run` makes: segment, fit-hermite, hexmesh, backward, forward, compress (CC, MLO), project-mammogram, cc2mlo.\n"
         "\nExamples:\n  breast demo\n  breast run scan.nrrd --side left TUMOUR=-60,-40,12\n  breast help compress\n"
         "\nDocumentation: " +
         installation.documentation().string() +
         "; manual pages: man breast, man breast-compress\n";
}

std::string unknown_command(const Installation& installation, const std::string& given) {
  std::vector<std::string> names = command_names();
  for (const std::string& tool : installation.tool_names()) names.push_back(tool);
  std::string near;
  for (int i = 0; i < 3; ++i) {
    const std::string best = nearest(given, names);
    if (best.empty()) break;
    near += (near.empty() ? "" : " or ") + ("'" + best + "'");
    std::erase(names, best);
  }
  return "'" + given + "' is neither a command nor a tool" +
         (near.empty() ? "; `breast help` lists them" : "; did you mean " + near + "?");
}

}  // namespace breast
