// SPDX-License-Identifier: GPL-3.0-or-later
#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/parse.hpp"

namespace breast {

Tokens tokenize(const Declaration& tool, const std::vector<std::string>& arguments) {
  CLI::App app;
  app.set_help_flag();
  app.allow_extras();
  std::vector<const Argument*> all;
  for (const Argument& argument : tool.options) all.push_back(&argument);
  for (const Argument& argument : tool.common) all.push_back(&argument);
  std::vector<CLI::Option*> declared;
  for (const Argument* argument : all) {
    std::string names;
    for (const std::string& name : argument->names) names += (names.empty() ? "" : ",") + name;
    if (argument->kind == ArgumentKind::flag) {
      declared.push_back(app.add_flag(names));
    } else {
      declared.push_back(
          app.add_option(names)->multi_option_policy(CLI::MultiOptionPolicy::TakeAll));
      declared.back()->type_size(1)->expected(1)->allow_extra_args(false);
    }
  }
  Tokens tokens;
  // Whatever follows a bare "--" is positional.
  const auto marker = std::find(arguments.begin(), arguments.end(), "--");
  std::vector<std::string> parsed(arguments.begin(), marker);
  std::reverse(parsed.begin(), parsed.end());  // CLI11 wants the last first
  try {
    app.parse(parsed);
  } catch (const CLI::ArgumentMismatch& error) {
    // CLI11 says "--gravity: 1 required ... missing".
    const std::string what = error.what();
    tokens.problem = what.substr(0, what.find(':')) + " needs a value";
    return tokens;
  } catch (const CLI::ParseError& error) {
    tokens.problem = error.what();
    return tokens;
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    const int times = int(declared[i]->count());
    if (times == 0) continue;
    const bool flag = all[i]->kind == ArgumentKind::flag;
    tokens.options.push_back(
        {all[i]->label(), flag ? std::vector<std::string>{} : declared[i]->results(), times});
  }
  for (const std::string& extra : app.remaining()) {
    const bool number = extra.size() > 1 && extra[1] >= '0' && extra[1] <= '9';
    const bool option = extra.size() > 1 && extra[0] == '-' && !number;
    (option ? tokens.unknown : tokens.positionals).push_back(extra);
  }
  if (marker != arguments.end()) {
    tokens.positionals.insert(tokens.positionals.end(), marker + 1, arguments.end());
  }
  return tokens;
}

}  // namespace breast
