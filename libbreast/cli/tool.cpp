// SPDX-License-Identifier: GPL-3.0-or-later
#include "cli/tool.hpp"

#include <sstream>

#include "cli/tool_impl.hpp"
#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

namespace {

std::vector<std::string> split_names(const std::string& names) {
  const std::size_t comma = names.find(',');
  if (comma == std::string::npos) return {names};
  return {names.substr(0, comma), names.substr(comma + 1)};
}

// "OUT.inp|OUT.feb": .inp and .feb.
std::vector<std::string> endings_of(const std::string& placeholder) {
  std::vector<std::string> endings;
  std::istringstream names(placeholder);
  for (std::string name; std::getline(names, name, '|');) {
    const std::size_t dot = name.find('.');
    if (dot != std::string::npos) endings.push_back(name.substr(dot));
  }
  return endings;
}

Argument option(ArgumentKind kind, const std::string& names, const std::string& placeholder,
                const std::string& help) {
  Argument argument;
  argument.kind = kind;
  argument.names = split_names(names);
  argument.placeholder = placeholder;
  argument.help = help;
  return argument;
}

Argument positional(ArgumentKind kind, const std::string& placeholder, const std::string& help) {
  Argument argument;
  argument.kind = kind;
  argument.placeholder = placeholder;
  argument.help = help;
  argument.required = true;
  return argument;
}

std::function<void(const std::vector<std::string>&)> into(std::filesystem::path& value) {
  return [&value](const std::vector<std::string>& given) { value = given.front(); };
}

}  // namespace

Tool::Tool(std::string name, std::string summary) : impl_(std::make_unique<Impl>()) {
  impl_->declaration.name = std::move(name);
  impl_->declaration.summary = std::move(summary);
  impl_->declaration.version = BREAST_VERSION;
  impl_->declare_common();
}
Tool::~Tool() = default;

Tool& Tool::describe(const std::string& paragraph) {
  impl_->declaration.paragraphs.push_back(paragraph);
  return *this;
}
Tool& Tool::cite(const std::string& reference) {
  impl_->declaration.citations.push_back(reference);
  return *this;
}
Tool& Tool::example(const std::string& command, const std::string& explanation) {
  impl_->declaration.examples.push_back({command, explanation});
  return *this;
}

Tool& Tool::input(std::filesystem::path& value, const std::string& placeholder,
                  const std::string& help) {
  impl_->add_positional(positional(ArgumentKind::input, placeholder, help)).store = into(value);
  return *this;
}

Tool& Tool::inputs(std::vector<std::filesystem::path>& values, const std::string& placeholder,
                   const std::string& help) {
  Argument& argument = impl_->add_positional(positional(ArgumentKind::input, placeholder, help));
  argument.repeatable = true;
  argument.store = [&values](const std::vector<std::string>& given) {
    values.assign(given.begin(), given.end());
  };
  return *this;
}

Tool& Tool::word(std::string& value, const std::string& placeholder, const std::string& help) {
  Argument& argument = impl_->add_positional(positional(ArgumentKind::text, placeholder, help));
  argument.store = [&value](const std::vector<std::string>& given) { value = given.front(); };
  return *this;
}

Tool& Tool::words(std::vector<std::string>& values, const std::string& placeholder,
                  const std::string& help) {
  Argument& argument = impl_->add_positional(positional(ArgumentKind::text, placeholder, help));
  argument.repeatable = true;
  argument.store = [&values](const std::vector<std::string>& given) { values = given; };
  return *this;
}

Tool& Tool::output(std::filesystem::path& value, const std::string& placeholder,
                   const std::string& help, const std::vector<std::string>& more_endings) {
  Argument& argument = impl_->add_positional(positional(ArgumentKind::output, placeholder, help));
  argument.store = into(value);
  argument.endings = endings_of(placeholder);
  argument.endings.insert(argument.endings.end(), more_endings.begin(), more_endings.end());
  return *this;
}

Tool& Tool::number(double& value, const std::string& name, const std::string& unit,
                   const std::string& help, double low, double high) {
  Argument& argument = impl_->add(option(ArgumentKind::number, name, unit, help));
  argument.low = low;
  argument.high = high;
  argument.default_text = number_text(value);
  argument.store = [&value, where = argument.label()](const std::vector<std::string>& given) {
    value = parse_number(given.front(), where);
  };
  return *this;
}

Tool& Tool::number(std::optional<double>& value, const std::string& name, const std::string& unit,
                   const std::string& help, double low, double high) {
  Argument& argument = impl_->add(option(ArgumentKind::number, name, unit, help));
  argument.low = low;
  argument.high = high;
  if (value) argument.default_text = number_text(*value);
  argument.store = [&value, where = argument.label()](const std::vector<std::string>& given) {
    value = parse_number(given.front(), where);
  };
  return *this;
}

Tool& Tool::integer(int& value, const std::string& name, const std::string& unit,
                    const std::string& help, int low, int high) {
  Argument& argument = impl_->add(option(ArgumentKind::integer, name, unit, help));
  argument.low = low;
  argument.high = high;
  argument.default_text = std::to_string(value);
  argument.store = [&value, where = argument.label()](const std::vector<std::string>& given) {
    value = int(parse_number(given.front(), where));
  };
  return *this;
}

Tool& Tool::text(std::string& value, const std::string& name, const std::string& placeholder,
                 const std::string& help) {
  Argument& argument = impl_->add(option(ArgumentKind::text, name, placeholder, help));
  argument.default_text = value;
  argument.store = [&value](const std::vector<std::string>& given) { value = given.front(); };
  return *this;
}

Tool& Tool::texts(std::vector<std::string>& values, const std::string& name,
                  const std::string& placeholder, const std::string& help) {
  Argument& argument = impl_->add(option(ArgumentKind::text, name, placeholder, help));
  argument.repeatable = true;
  argument.store = [&values](const std::vector<std::string>& given) { values = given; };
  return *this;
}

Tool& Tool::choice(std::string& value, const std::string& name,
                   const std::vector<std::string>& choices, const std::string& help) {
  Argument& argument = impl_->add(option(ArgumentKind::choice, name, "NAME", help));
  argument.choices = choices;
  argument.default_text = value;
  argument.store = [&value](const std::vector<std::string>& given) { value = given.front(); };
  return *this;
}

Tool& Tool::numbers(std::vector<double>& values, const std::string& name,
                    const std::string& placeholder, int count, const std::string& help) {
  Argument& argument = impl_->add(option(ArgumentKind::numbers, name, placeholder, help));
  argument.count = count;
  for (const double x : values) {
    argument.default_text += (argument.default_text.empty() ? "" : ",") + number_text(x);
  }
  argument.store = [&values, where = argument.label()](const std::vector<std::string>& given) {
    values.clear();
    std::size_t start = 0;
    while (start <= given.front().size()) {
      const std::size_t comma = std::min(given.front().find(',', start), given.front().size());
      values.push_back(parse_number(given.front().substr(start, comma - start), where));
      start = comma + 1;
    }
  };
  return *this;
}

Tool& Tool::flag(bool& value, const std::string& name, const std::string& help) {
  Argument& argument = impl_->add(option(ArgumentKind::flag, name, "", help));
  argument.store = [&value](const std::vector<std::string>&) { value = true; };
  return *this;
}

Tool& Tool::question(bool& value, const std::string& name, const std::string& help) {
  Argument& argument = impl_->add(option(ArgumentKind::flag, name, "", help));
  argument.question = true;
  argument.store = [&value](const std::vector<std::string>&) { value = true; };
  return *this;
}

Tool& Tool::input_file(std::filesystem::path& value, const std::string& name,
                       const std::string& placeholder, const std::string& help) {
  impl_->add(option(ArgumentKind::input, name, placeholder, help)).store = into(value);
  return *this;
}
Tool& Tool::output_file(std::filesystem::path& value, const std::string& name,
                        const std::string& placeholder, const std::string& help) {
  Argument& argument = impl_->add(option(ArgumentKind::output, name, placeholder, help));
  argument.store = into(value);
  argument.endings = endings_of(placeholder);
  return *this;
}
Tool& Tool::output_folder(std::filesystem::path& value, const std::string& name,
                          const std::string& placeholder, const std::string& help) {
  impl_->add(option(ArgumentKind::folder, name, placeholder, help)).store = into(value);
  return *this;
}

Tool& Tool::required(const std::string& name) {
  impl_->declared(name).required = true;
  return *this;
}

Tool& Tool::topic(const std::string& name, const std::vector<std::string>& options) {
  for (const std::string& option : options) {
    std::string& topic = impl_->declared(option).topic;
    if (!topic.empty())
      throw failed_error("tool ", impl_->declaration.name, " lists ", option, " under ", topic,
                         " and under ", name);
    topic = name;
  }
  return *this;
}

Tool& Tool::basic(const std::vector<std::string>& options) {
  for (const std::string& option : options) impl_->declared(option).basic = true;
  return *this;
}

Tool& Tool::check(std::function<void()> rule) {
  impl_->rules.push_back(std::move(rule));
  return *this;
}

}  // namespace breast
