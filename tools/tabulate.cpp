// SPDX-License-Identifier: GPL-3.0-or-later
// tabulate: tables, verdicts and pages of runs, out of their reports, tables and shapes.
#include <algorithm>
#include <cstdlib>

#include "cli/declaration.hpp"
#include "cli/tool.hpp"
#include "core/error.hpp"
#include "tabulate_kinds.hpp"

using namespace breast;

namespace {

std::vector<TabulateKind> all_kinds() {
  std::vector<TabulateKind> kinds = page_kinds();
  for (const auto& more : {table_kinds(), cohort_kinds()})
    kinds.insert(kinds.end(), more.begin(), more.end());
  return kinds;
}

const TabulateKind& kind_called(const std::vector<TabulateKind>& kinds, const std::string& name) {
  const auto found = std::find_if(kinds.begin(), kinds.end(),
                                  [&](const TabulateKind& kind) { return kind.name == name; });
  if (found != kinds.end()) return *found;
  std::vector<std::string> names;
  for (const TabulateKind& kind : kinds) names.push_back(kind.name);
  const std::string near = nearest(name, names);
  throw input_error(
      "'", name, "' is nothing that can be made",
      near.empty() ? "; tabulate --help lists what can" : "; did you mean '" + near + "'?");
}

void check_count(const TabulateKind& kind, std::size_t count) {
  if (count < kind.least)
    throw input_error(kind.name, ": has ", count, " arguments and needs ", kind.least,
                      "; usage: tabulate ", kind.name, " ", kind.arguments);
  if (count > kind.most)
    throw input_error(kind.name, ": has ", count, " arguments and takes ", kind.most,
                      "; usage: tabulate ", kind.name, " ", kind.arguments);
}

// CALIBRATED="REPORT SIDE", which the makefile exports for a phantom whose preset was fitted to the chain.
void read_calibrated(TabulateRequest& request) {
  const char* given = std::getenv("CALIBRATED");
  const std::string text = given == nullptr ? "" : given;
  const std::size_t blank = text.rfind(' ');
  if (text.find_first_not_of(' ') == std::string::npos) return;
  if (blank == std::string::npos)
    throw input_error("CALIBRATED='", text, "': is not REPORT.json SIDE");
  request.calibrated = text.substr(0, blank);
  request.side = text.substr(blank + 1);
}

void declare(Tool& tool, const std::vector<TabulateKind>& kinds) {
  tool.describe(
      "Reads the JSON reports, TSV tables and shapes of finished runs and prints one table or page to stdout: tab-separated text whose first "
      "line is the header, or HTML. It solves nothing. The pipeline makes all its tables and pages with it; each kind can be asked for by hand.");
  for (const TabulateKind& kind : kinds)
    tool.describe(kind.name + " " + kind.arguments + ": " + kind.help + ".");
  tool.describe(
      "In the environment, CALIBRATED=\"REPORT.json SIDE\" names the report of a phantom whose preset was fitted to the answer of the chain: the "
      "rows it was fitted to say so.");
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<TabulateKind> kinds = all_kinds();
  std::string name;
  TabulateRequest request;
  request.pipelines = "pipelines";
  std::string pipelines = request.pipelines;
  Tool tool("tabulate", "tables, verdicts and pages of finished runs");
  declare(tool, kinds);
  tool.word(name, "KIND", "what to make, from the list above");
  tool.words(request.words, "ARGUMENT", "of that kind: files, folders and names");
  tool.text(pipelines, "--pipelines", "FOLDER",
            "the pipeline's own tables: advice.tsv, limits.txt, paper/, invivo/");
  tool.check([&] { check_count(kind_called(kinds, name), request.words.size()); });
  tool.example("tabulate summary runs/average", "what a finished case says, its warnings first");
  tool.example(
      "tabulate slopes runs/paper/supine.json runs/paper/scaled runs/paper/base-slopes.tsv runs/paper/scaled/tumour-100-slopes.tsv",
      "every slope from one solve against solving again");
  return tool.main(argc, argv, [&](Run& run) {
    request.pipelines = pipelines;
    read_calibrated(request);
    run.report().set("kind", name);
    run.print(kind_called(kinds, name).make(request));
  });
}
