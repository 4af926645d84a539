// SPDX-License-Identifier: GPL-3.0-or-later
// tabulate: tables, verdicts and pages of runs, from their reports, tables and shapes.
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
      "'", name, "' is not a kind of table or page",
      near.empty() ? "; tabulate --help lists all kinds" : "; did you mean '" + near + "'?");
}

void check_count(const TabulateKind& kind, std::size_t count) {
  if (count < kind.least)
    throw input_error(kind.name, ": has ", count, " arguments and needs ", kind.least,
                      "; usage: tabulate ", kind.name, " ", kind.arguments);
  if (count > kind.most)
    throw input_error(kind.name, ": has ", count, " arguments and takes ", kind.most,
                      "; usage: tabulate ", kind.name, " ", kind.arguments);
}

// Reads CALIBRATED="REPORT SIDE", which the makefile exports for a phantom with a preset fitted to
// the chain.
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
      "Reads the JSON reports, TSV tables and shapes of finished runs and prints one table or "
      "page to stdout, either as tab-separated text with a header line or as HTML. It runs no "
      "simulation. The pipeline makes all its tables and pages with this tool, and each kind can also "
      "be made by hand. The kinds are:");
  for (const TabulateKind& kind : kinds)
    tool.describe(kind.name + " " + kind.arguments + ": " + kind.help + ".");
  tool.describe(
      "If a phantom's preset was fitted to results of the chain, the environment variable "
      "CALIBRATED=\"REPORT.json SIDE\" names the phantom's report and side, and the rows to which "
      "it was fitted are marked.");
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
  tool.word(name, "KIND", "kind of table or page, from the list above");
  tool.words(request.words, "ARGUMENT", "arguments of that kind: files, folders and names");
  tool.text(pipelines, "--pipelines", "FOLDER",
            "folder with the pipeline's own tables: advice.tsv, limits.txt, paper/, invivo/");
  tool.check([&] { check_count(kind_called(kinds, name), request.words.size()); });
  tool.example("tabulate summary runs/average",
               "the results of a finished case, preceded by its warnings");
  tool.example(
      "tabulate slopes runs/paper/supine.json runs/paper/studies/scaled runs/paper/slopes.tsv "
      "runs/paper/studies/scaled/tumour-100/slopes.tsv",
      "every slope from one solve, compared with solving again");
  return tool.main(argc, argv, [&](Run& run) {
    request.pipelines = pipelines;
    read_calibrated(request);
    run.report().set("kind", name);
    run.print(kind_called(kinds, name).make(request));
  });
}
