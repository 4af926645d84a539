// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/parse.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/text/lists.hpp"

namespace breast {

namespace {

std::string suggestion(const std::string& given, const std::vector<std::string>& candidates) {
  const std::string best = nearest(given, candidates);
  return best.empty() ? "" : "; did you mean '" + best + "'?";
}

void check_range(const Argument& argument, double value) {
  if (value >= argument.low && value <= argument.high) return;
  throw input_error(argument.label(), " ", number_text(value), ": must be ", remarks([&] {
                      Argument bare = argument;  // only the range is wanted
                      bare.default_text.clear();
                      bare.required = bare.repeatable = false;
                      return bare;
                    }()));
}

void check_value(const Argument& argument, const std::string& value) {
  if (argument.kind == ArgumentKind::number)
    check_range(argument, parse_number(value, argument.label()));
  if (argument.kind == ArgumentKind::integer) {
    const double number = parse_number(value, argument.label());
    if (number != std::floor(number)) {
      throw input_error(argument.label(), ": '", value, "' is not a whole number");
    }
    check_range(argument, number);
  }
  if (argument.kind == ArgumentKind::numbers) {
    const std::vector<std::string> parts = split(value, ',');
    if (int(parts.size()) != argument.count) {
      throw input_error(argument.label(), ": '", value, "' has ", parts.size(), " numbers; give ",
                        argument.count, " as ", argument.placeholder);
    }
    for (const std::string& part : parts) parse_number(part, argument.label());
  }
  const auto& choices = argument.choices;
  if (argument.kind == ArgumentKind::choice &&
      std::find(choices.begin(), choices.end(), value) == choices.end()) {
    throw input_error(argument.label(), ": '", value, "' is none of ", join(choices, ", "),
                      suggestion(value, choices));
  }
  if (value.empty()) throw input_error(argument.label(), ": is empty");
}

void store(Argument& argument, const std::vector<std::string>& values) {
  for (const std::string& value : values) check_value(argument, value);
  argument.given = true;
  argument.store(values);
}

void assign_positionals(Declaration& tool, const std::vector<std::string>& values, bool asked) {
  auto& wanted = tool.positionals;
  if (values.size() < wanted.size() && !(asked && !values.empty())) {
    throw input_error(wanted[values.size()].label(), " is missing; usage: ", synopsis(tool));
  }
  const bool open_end = !wanted.empty() && wanted.back().repeatable;
  if (values.size() > wanted.size() && !open_end) {
    throw input_error("'", values[wanted.size()],
                      "' is one argument too many; usage: ", synopsis(tool));
  }
  for (std::size_t i = 0; i < std::min(wanted.size(), values.size()); ++i) {
    const bool rest = wanted[i].repeatable;
    store(wanted[i],
          {values.begin() + long(i), rest ? values.end() : values.begin() + long(i) + 1});
  }
}

}  // namespace

Argument* find_option(Declaration& tool, const std::string& label) {
  for (auto* list : {&tool.options, &tool.common}) {
    for (Argument& argument : *list) {
      if (argument.label() == label) return &argument;
    }
  }
  return nullptr;
}

void assign(Declaration& tool, const Tokens& tokens) {
  for (const Tokens::Option& option : tokens.options) {  // known even when something else is wrong
    if (option.name == "--report" && option.values.size() == 1) {
      store(*find_option(tool, option.name), option.values);
    }
  }
  if (!tokens.problem.empty()) throw input_error(tokens.problem, "; usage: ", synopsis(tool));
  if (!tokens.unknown.empty()) {
    std::vector<std::string> names;
    for (const auto* list : {&tool.options, &tool.common}) {
      for (const Argument& argument : *list) {
        names.insert(names.end(), argument.names.begin(), argument.names.end());
      }
    }
    const std::string given = tokens.unknown[0].substr(0, tokens.unknown[0].find('='));
    std::string hint = suggestion(given, names);
    if (hint.empty()) hint = "; see " + tool.name + " --help-all";
    throw input_error("unknown option '", given, "'", hint);
  }
  for (const Tokens::Option& option : tokens.options) {
    Argument* argument = find_option(tool, option.name);
    if (option.times > 1 && !argument->repeatable && argument->kind != ArgumentKind::flag) {
      throw input_error(option.name, " is given ", option.times, " times; give it once");
    }
    store(*argument, option.values);
  }
  const bool asked =
      std::any_of(tool.options.begin(), tool.options.end(),
                  [](const Argument& argument) { return argument.question && argument.given; });
  assign_positionals(tool, tokens.positionals, asked);
  for (const Argument& argument : tool.options) {
    if (!asked && argument.required && !argument.given) {
      throw input_error(usage(argument), " is missing; usage: ", synopsis(tool));
    }
  }
}

std::string history_command(const Declaration& tool, const std::vector<std::string>& arguments) {
  std::string command = tool.name;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    const std::size_t equals = argument.starts_with("--") ? argument.find('=') : std::string::npos;
    const std::string name = argument.substr(0, equals);
    const auto common =
        std::find_if(tool.common.begin(), tool.common.end(), [&](const Argument& a) {
          return std::find(a.names.begin(), a.names.end(), name) != a.names.end();
        });
    if (common != tool.common.end()) {  // how it was run, not what was done
      if (common->kind != ArgumentKind::flag && equals == std::string::npos) ++i;
      continue;
    }
    std::string prefix, value = argument;
    if (equals != std::string::npos) {
      prefix = argument.substr(0, equals + 1);
      value = argument.substr(equals + 1);
    }
    while (value.size() > 1 && value.back() == '/') value.pop_back();
    const std::size_t slash = value.rfind('/');
    if (slash != std::string::npos) value = value.substr(slash + 1);
    command += " " + prefix + value;
  }
  return command;
}

}  // namespace breast
