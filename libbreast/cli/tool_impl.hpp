// SPDX-License-Identifier: GPL-3.0-or-later
// Private part of Tool: its declaration, rules and common options.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "cli/declaration.hpp"
#include "cli/tool.hpp"
#include "core/error.hpp"

namespace breast {

struct Tool::Impl {
  Declaration declaration;
  std::vector<std::function<void()>> rules;
  std::filesystem::path report_file;
  int threads = 0;
  bool quiet = false;

  Argument& add(Argument argument) {
    declaration.options.push_back(std::move(argument));
    return declaration.options.back();
  }
  Argument& add_positional(Argument argument) {
    declaration.positionals.push_back(std::move(argument));
    return declaration.positionals.back();
  }
  /// The option of that name; a tool that never declared it is wrong.
  Argument& declared(const std::string& name) {
    for (Argument& argument : declaration.options)
      if (argument.label() == name) return argument;
    throw failed_error("tool ", declaration.name, " names ", name, ", which it never declared");
  }
  void declare_common();
  /// Answers --help, --help-all, --version and the hidden --help-completion; true if one of them was given.
  bool answer_questions(const std::vector<std::string>& arguments) const;
};

}  // namespace breast
