// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <sstream>

#include "cli/declaration.hpp"
#include "core/table.hpp"
#include "core/text/lists.hpp"

namespace breast {

namespace {

struct ExitCode {
  const char *code, *meaning;
};
constexpr ExitCode exit_codes[] = {{"0", "done"},
                                   {"1", "failed (disk, memory, library)"},
                                   {"2", "bad usage or bad input; nothing written"},
                                   {"3", "not converged; nothing written unless asked for"}};

// Words of `text` in lines of at most `width` columns, each line after the first indented.
std::string wrap(const std::string& text, std::size_t indent, std::size_t width = 88) {
  std::istringstream words(text);
  std::string out, word;
  std::size_t column = indent;
  while (words >> word) {
    const bool first = column == indent;
    if (!first && column + 1 + word.size() > width) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!first) {
      out += ' ';
      ++column;
    }
    out += word;
    column += word.size();
  }
  return out;
}

std::string with_remarks(const Argument& argument) {
  const std::string extra = remarks(argument);
  return extra.empty() ? argument.help : argument.help + " (" + extra + ")";
}

void list_text(std::ostringstream& out, const std::string& title,
               const std::vector<Argument>& list) {
  if (list.empty()) return;
  out << "\n" << title << ":\n";
  for (const Argument& argument : list) {
    out << "  " << usage(argument) << "\n      " << wrap(with_remarks(argument), 6) << "\n";
  }
}

// An installed tool lies in libexec/breast, where no shell finds it: it is called through the command `breast`.
std::string call_prefix() {
  std::error_code unknown;
  const std::filesystem::path folder =
      std::filesystem::read_symlink("/proc/self/exe", unknown).parent_path();
  return folder.filename() == "breast" && folder.parent_path().filename() == "libexec" ? "breast "
                                                                                       : "";
}

std::string topic_title(const std::string& topic) {
  return topic.empty() ? "Options" : "Options: " + topic;
}

void examples_text(std::ostringstream& out, const Declaration& tool) {
  const std::string prefix = call_prefix();
  if (!tool.examples.empty()) out << "\nExamples:\n";
  for (const auto& example : tool.examples) {
    const bool of_this = example.command.rfind(tool.name + " ", 0) == 0;
    out << "  " << (of_this ? prefix : "") << example.command << "\n      "
        << wrap(example.explanation, 6) << "\n";
  }
}

// What --help-all has beyond --help.
std::string further(const Declaration& tool) {
  std::vector<std::string> topics;
  std::size_t number = 0;
  for (const Argument& argument : tool.options) {
    if (tool.is_brief(argument)) continue;
    ++number;
    if (!argument.topic.empty() &&
        std::find(topics.begin(), topics.end(), argument.topic) == topics.end())
      topics.push_back(argument.topic);
  }
  if (number == 0) return "also explains the common options and the exit codes";
  return "shows " + std::to_string(number) + " further option" + (number > 1 ? "s" : "") +
         (topics.empty() ? "" : " by topic: " + join(topics, ", "));
}

void brief_text(std::ostringstream& out, const Declaration& tool) {
  if (!tool.paragraphs.empty()) out << "\n" << wrap(tool.paragraphs.front(), 0) << "\n";
  list_text(out, "Arguments", tool.positionals);
  std::vector<Argument> options;
  std::copy_if(tool.options.begin(), tool.options.end(), std::back_inserter(options),
               [&](const Argument& argument) { return tool.is_brief(argument); });
  list_text(out, "Options", options);
  std::vector<std::string> common;
  for (const Argument& argument : tool.common) common.push_back(usage(argument));
  out << "\n" << wrap("Common options: " + join(common, ", "), 2) << "\n";
  examples_text(out, tool);
  out << "\n" << wrap(call_prefix() + tool.name + " --help-all " + further(tool), 2) << "\n";
}

}  // namespace

bool Declaration::is_brief(const Argument& option) const {
  const bool any =
      std::any_of(options.begin(), options.end(), [](const Argument& a) { return a.basic; });
  return !any || option.basic || option.required;
}

std::vector<std::string> Declaration::topics() const {
  std::vector<std::string> names;
  for (const Argument& argument : options)
    if (std::find(names.begin(), names.end(), argument.topic) == names.end())
      names.push_back(argument.topic);
  return names;
}

std::vector<Argument> Declaration::of_topic(const std::string& topic) const {
  std::vector<Argument> list;
  std::copy_if(options.begin(), options.end(), std::back_inserter(list),
               [&](const Argument& argument) { return argument.topic == topic; });
  return list;
}

std::string synopsis(const Declaration& tool) {
  std::string line = call_prefix() + tool.name;
  for (const Argument& argument : tool.positionals) line += " " + usage(argument);
  for (const Argument& argument : tool.options) {
    if (argument.required) line += " " + usage(argument);
  }
  return line + " [options]";
}

std::string usage(const Argument& argument) {
  if (argument.positional()) return argument.placeholder + (argument.repeatable ? "..." : "");
  std::string text;
  for (const std::string& name : argument.names) text += (text.empty() ? "" : ", ") + name;
  if (argument.kind == ArgumentKind::choice) {
    std::string list;
    for (const std::string& c : argument.choices) list += (list.empty() ? "" : "|") + c;
    return text + " " + list;
  }
  return argument.kind == ArgumentKind::flag ? text : text + " " + argument.placeholder;
}

std::string number_text(double value) {
  const double size = std::abs(value);
  if (!(value == 0 || (size >= 1e-5 && size < 1e15))) return format_number(value);
  char buffer[64];
  const auto end = std::to_chars(buffer, buffer + sizeof buffer, value, std::chars_format::fixed);
  return {buffer, end.ptr};
}

std::string remarks(const Argument& argument) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : "; ") + part; };
  const bool above = argument.low > -std::numeric_limits<double>::infinity();
  const bool below = argument.high < std::numeric_limits<double>::infinity();
  if (argument.kind == ArgumentKind::number || argument.kind == ArgumentKind::integer) {
    if (above && below) {
      add(number_text(argument.low) + " to " + number_text(argument.high));
    } else if (above) {
      add("at least " + number_text(argument.low));
    } else if (below) {
      add("at most " + number_text(argument.high));
    }
  }
  if (argument.required && !argument.positional()) add("required");
  if (argument.repeatable && !argument.positional()) add("may be repeated");
  if (!argument.required && !argument.default_text.empty()) {
    add("default: " + argument.default_text);
  }
  return text;
}

std::string help_text(const Declaration& tool, bool all) {
  std::ostringstream out;
  out << call_prefix() << tool.name << " - " << tool.summary << "\n\nUsage: " << synopsis(tool)
      << "\n";
  if (!all) {
    brief_text(out, tool);
    return out.str();
  }
  for (const std::string& paragraph : tool.paragraphs) out << "\n" << wrap(paragraph, 0) << "\n";
  list_text(out, "Arguments", tool.positionals);
  for (const std::string& topic : tool.topics())
    list_text(out, topic_title(topic), tool.of_topic(topic));
  list_text(out, "Common options", tool.common);
  examples_text(out, tool);
  out << "\nExit codes:\n";
  for (const ExitCode& exit : exit_codes) out << "  " << exit.code << "  " << exit.meaning << "\n";
  if (!tool.citations.empty()) out << "\nCitation:\n";
  for (const std::string& citation : tool.citations) out << "  " << wrap(citation, 4) << "\n";
  return out.str();
}

std::string help_completion(const Declaration& tool) {
  std::string text;
  for (const auto* list : {&tool.options, &tool.common}) {
    for (const Argument& argument : *list) {
      const bool file = argument.kind == ArgumentKind::input ||
                        argument.kind == ArgumentKind::output ||
                        argument.kind == ArgumentKind::folder;
      text += argument.label() + (argument.kind == ArgumentKind::flag ? "\tflag\t"
                                  : file                              ? "\tfile\t"
                                                                      : "\tvalue\t");
      for (const std::string& choice : argument.choices)
        text += (text.back() == '\t' ? "" : " ") + choice;
      text += "\n";
    }
  }
  return text;
}

std::string nearest(const std::string& given, const std::vector<std::string>& candidates) {
  const auto distance = [](const std::string& a, const std::string& b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i;
      for (std::size_t j = 1; j <= b.size(); ++j) {
        const std::size_t above = row[j];
        row[j] = std::min({above + 1, row[j - 1] + 1, diagonal + (a[i - 1] == b[j - 1] ? 0 : 1)});
        diagonal = above;
      }
    }
    return row[b.size()];
  };
  std::string best;
  std::size_t least = std::max<std::size_t>(2, given.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    std::size_t d = distance(given, candidate);
    // An abbreviation is a slip too: "--post" for "--posture".
    if (given.size() >= 4 && candidate.starts_with(given)) d = 1;
    if (d < least) {
      least = d;
      best = candidate;
    }
  }
  return best;
}

}  // namespace breast
