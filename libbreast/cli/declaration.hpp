// SPDX-License-Identifier: GPL-3.0-or-later
// The declaration of a tool, from which its help and checks are derived. The pages of docs/tools and docs/man are
// made of that help (tests/tools/help_pages.py).
#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace breast {

enum class ArgumentKind { text, number, integer, numbers, choice, flag, input, output, folder };

struct Argument {
  ArgumentKind kind = ArgumentKind::text;
  std::vector<std::string> names;  ///< "-o", "--output"; empty for a positional
  std::string placeholder;         ///< unit or meta-variable shown in the help
  std::string help;
  std::string default_text;  ///< empty: none
  std::string topic;         ///< heading under which all options are listed; empty: the first
  bool basic = false;        ///< one of the few options that the short help lists
  std::vector<std::string> choices;
  std::vector<std::string> endings;  ///< output: of the names it may have; empty: any
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  int count = 1;  ///< numbers: how many
  bool repeatable = false, required = false, given = false;
  /// A flag with which only the first positional argument is needed, and no option: nothing is written.
  bool question = false;
  /// Stores the values (already checked in kind and range); for a flag `values` is empty.
  std::function<void(const std::vector<std::string>& values)> store;

  bool positional() const { return names.empty(); }
  /// Name used in messages: the longest name of an option, or the placeholder of a positional
  /// argument.
  const std::string& label() const { return positional() ? placeholder : names.back(); }
};

struct Declaration {
  struct Example {
    std::string command, explanation;
  };
  std::string name, summary, version;
  std::vector<std::string> paragraphs, citations;
  std::vector<Example> examples;
  std::vector<Argument> positionals, options, common;

  /// Whether the short help lists an option of this tool: one that is basic or required, and any
  /// if the tool marks none as basic.
  bool is_brief(const Argument& option) const;
  /// Topics of the options in the order of their first use.
  std::vector<std::string> topics() const;
  /// The options of a topic.
  std::vector<Argument> of_topic(const std::string& topic) const;
};

/// The one-line synopsis: "forward REFERENCE.vtkhdf DEFORMED.vtkhdf [options]".
std::string synopsis(const Declaration& tool);
/// A number as people write it, without an exponent where it has at most 15 digits: 100000, 0.0001.
std::string number_text(double value);
/// "number in mm from 0 to 40; default: 2": the remarks that the help adds to an argument's text.
std::string remarks(const Argument& argument);
/// "-o, --output FILE".
std::string usage(const Argument& argument);

/// The help of a terminal: with `all`, everything, the options by topic; otherwise the first
/// paragraph, the options that most people need, and what `all` has beyond them.
std::string help_text(const Declaration& tool, bool all);
/// For the completion in a shell: one line "--name<TAB>kind<TAB>choice choice" per long option,
/// where kind is flag, file or value.
std::string help_completion(const Declaration& tool);

/// The candidate with the smallest edit distance if it is small enough for a typing error,
/// otherwise empty.
std::string nearest(const std::string& given, const std::vector<std::string>& candidates);

}  // namespace breast
