// SPDX-License-Identifier: GPL-3.0-or-later
// pairs: the page of the files that must belong together. Its rules are those by which the tools refuse a pair.
#include <algorithm>

#include "cli/declaration.hpp"
#include "cli/tool.hpp"
#include "core/error.hpp"
#include "lineage/pair_rules.hpp"

using namespace breast;

namespace {

// "" for the rules of all tools. Throws Error (input) for a tool that reads no pair.
std::string rules_of(const std::string& name) {
  std::vector<std::string> names{"all"};
  for (const PairRule& rule : pair_rules()) names.push_back(rule.tool);
  if (std::find(names.begin(), names.end(), name) != names.end()) return name == "all" ? "" : name;
  const std::string near = nearest(name, names);
  throw input_error("'", name, "' is no tool that reads a pair of files; ",
                    near.empty() ? "give all" : "did you mean '" + near + "'?");
}

}  // namespace

int main(int argc, char** argv) {
  std::string name;
  Tool tool("pairs", "which files must belong together");
  tool.describe(
      "Prints a page in Markdown: for each pair of files that meet in a tool, what must agree "
      "between them and what --accept-other lets differ.");
  tool.word(name, "all|TOOL", "the pairs of all tools, or of one");
  tool.example("pairs compress", "the pairs that compress checks");
  return tool.main(argc, argv, [&](Run& run) { run.print(pairs_page(rules_of(name))); });
}
