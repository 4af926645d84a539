// SPDX-License-Identifier: GPL-3.0-or-later
// cases: reading and checking of cases before anything runs, and running of a cohort's cases.
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <functional>

#include "cases/attempt.hpp"
#include "cases/case_file.hpp"
#include "cases/case_run.hpp"
#include "cases/cohort_files.hpp"
#include "cases/ladder.hpp"
#include "cases/make_text.hpp"
#include "cases/scan_identity.hpp"
#include "cases/settings.hpp"
#include "cases/slurm.hpp"
#include "cases/variants.hpp"
#include "cli/declaration.hpp"
#include "cli/library_words.hpp"
#include "cli/tool.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "core/text/lists.hpp"
#include "study/cells.hpp"

using namespace breast;

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

struct Kind {
  std::string name, arguments, help;
  std::size_t least;
  std::function<std::string(const Words&)> make;
};

Words rest(const Words& words, std::size_t first) {
  return {words.begin() + long(first), words.end()};
}

// Kinds in the order of their use: reading, refusing, running.

std::string cohort(const Words& words) {
  std::string text;
  for (const CohortEntry& one : cohort_entries(words[0], rest(words, 1)))
    text += make_addition("COHORT_CASES", one.name) +
            make_assignment("file_" + one.name, one.file) +
            make_assignment("kind_" + one.name, one.phantom ? "phantom" : "scan");
  return text;
}

std::string list(const Words& words) {
  std::string text;
  for (const CohortEntry& one : cohort_entries(words[0], rest(words, 1)))
    text += one.name + "\t" + one.file + "\t" + (one.phantom ? "phantom" : "scan") + "\n";
  return text;
}

std::string record(const Words& words) {
  remember_scan(words[0], words[1], words[2]);
  return "";
}

// NAME=VALUE after a mark: "@hexmesh=--elements 8".
std::pair<std::string, std::string> named_value(const std::string& word, std::size_t from) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos) throw input_error("'", word, "' is not NAME=VALUE");
  return {word.substr(from, equals - from), word.substr(equals + 1)};
}

std::string settings(const Words& words) {
  SettingsRequest request;
  request.pipelines = words[0];
  request.programs = words[1];
  request.installed = words[2] == "installed";
  for (const std::string& goal : split(words[3], ' '))
    if (!goal.empty()) request.goals.push_back(goal);
  for (const std::string& word : rest(words, 4)) request.command_line.insert(named_value(word, 0));
  for (char** word = environ; *word != nullptr; ++word)
    if (std::strchr(*word, '=') != nullptr) request.environment.insert(named_value(*word, 0));
  return settings_for_make(request);
}

std::string rows(const Words& words) {
  return rows_for_make(read_table(words[0]), words[1]);
}

std::string variants(const Words& words) {
  StudyBase base;
  base.run = words[0];
  base.stages = split(words[1], ' ');
  base.ends_at = words[2];
  Words tables;
  for (const std::string& word : rest(words, 3)) {
    if (word.starts_with('@')) {
      const auto [name, value] = named_value(word, 1);
      base.attributes.push_back(name);
      base.of_case[name] = value;
    } else if (word.starts_with('{')) {
      const auto [name, value] = named_value(word, 1);
      base.placeholders[name] = value;
    } else {
      tables.push_back(word);
    }
  }
  Studies studies(base);
  for (const std::string& word : tables) {
    const auto [name, value] = named_value(word, 0);
    const std::size_t at = value.find('@');
    const std::string file = value.substr(0, at);
    studies.add(name, read_text(file), file, at == std::string::npos ? "" : value.substr(at + 1));
  }
  return studies.text();
}

std::string run(const Words& words) {
  if (!run_case({words[0], words[1], words[2] == "phantom", rest(words, 3)}))
    throw failed_error(words[0], ": stopped by a signal");
  return "";
}

std::string attempt_stage(const Words& words) {
  std::vector<fs::path> inputs;
  for (const std::string& input : split(words[1], ' '))
    if (!input.empty()) inputs.push_back(input);
  attempt(words[0], inputs, rest(words, 2));
  return "";
}

std::string ladder(const Words& words) {
  dprintf(message_descriptor(), "%s",
          climb({words[0], words[1], split(words[2], ' '), split(words[3], ' '), rest(words, 4)})
              .c_str());
  return "";
}

std::string any_done(const Words& words) {
  const Table table = read_table(words[0]);
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    if (table.cell(r, "status") == "done") return "";
  throw failed_error("every case failed: see ", words[0]);
}

std::string task(const Words& words) {
  return run_slurm_task(words[0], int(parse_number(words[1], "task: OFFSET")));
}

std::string table(const Words& words) {
  const int code = run_slurm_table(words[0], words[1]);
  if (code != 0) throw failed_error("the table could not be made: make ended with ", code);
  return "";
}

std::vector<Kind> kinds_for(SlurmRequest& slurm) {
  const auto of_cluster = [&slurm](auto make) {
    return [&slurm, make](const Words& words) {
      slurm.runs = words[0];
      slurm.cohort = words[1];
      slurm.command = rest(words, 2);
      slurm.program = fs::read_symlink("/proc/self/exe");
      return make(slurm);
    };
  };
  return {
      {"settings", "PIPELINES PROGRAMS installed|built 'GOAL...' NAME=VALUE...",
       "prints all settings as assignments for make, completed from the case file, the environment and the defaults; "
       "fails if a setting, a value, a target or the scan of the folder RUN is refused",
       4, settings},
      {"rows", "TABLE.tsv TEMPLATE",
       "prints, for every row, its cells as variables of make cell_COLUMN, and evaluates the variable TEMPLATE",
       2, rows},
      {"cohort", "COHORT KEY...", "prints the case files of a folder as assignments for make", 1,
       cohort},
      {"list", "COHORT KEY...",
       "prints one line per case file of a folder: CASE, FILE and KIND (scan or phantom)", 1, list},
      {"variants", "RUN STAGES ENDS_AT @ATTRIBUTE=VALUE... {NAME=VALUE... STUDY=FILE.tsv[@ROW]...",
       "prints the rows of studies as assignments for make (docs/file-formats.md)", 3, variants},
      {"nearest", "WORD CANDIDATE...",
       "prints the candidate that is most similar to WORD, for messages about typing errors", 2,
       [](const Words& words) { return suggestion(words[0], rest(words, 1)); }},
      {"record", "RUN SIDE SCAN", "records scan and side in RUN/.scan", 3, record},
      {"attempt", "STAGE.json 'INPUT...' -- COMMAND...",
       "runs a stage of a variant; if it has no solution, the report gives the reason", 3,
       attempt_stage},
      {"ladder", "RUN MM 'POINT...' 'TABULATE...' -- MAKE...",
       "solves points of the study `cost` until the estimated error is below MM, and writes RUN/accuracy.mk",
       5, ladder},
      {"run", "STATUS LOG KIND -- COMMAND...",
       "runs a case of a cohort and writes its outcome to the file STATUS", 4, run},
      {"any-done", "TABLE.tsv", "fails if no case in the table of a cohort was completed", 1,
       any_done},
      {"script", "RUNS COHORT -- MAKE...",
       "prints the script of the job array that `submit` would submit", 2, of_cluster(slurm_plan)},
      {"submit", "RUNS COHORT -- MAKE...",
       "submits to Slurm the cases in RUNS/.cases, each as a run of the command MAKE, and a job that makes their table",
       2, of_cluster(submit_to_slurm)},
      {"task", "FOLDER OFFSET", "runs the case of one task; called by the job array", 2, task},
      {"table", "FOLDER COHORT", "makes the table; called by the last job", 2, table},
  };
}

const Kind& kind_called(const std::vector<Kind>& kinds, const std::string& name) {
  Words names;
  for (const Kind& kind : kinds) {
    if (kind.name == name) return kind;
    names.push_back(kind.name);
  }
  throw input_error("'", name, "' is not an action of cases", suggestion(name, names));
}

void declare_slurm(Tool& tool, SlurmRequest& slurm, std::string& cost) {
  tool.text(slurm.partition, "--partition", "NAME", "partition of the cluster");
  tool.text(slurm.account, "--account", "NAME", "account to be charged");
  tool.text(
      slurm.time, "--time", "TIME",
      "time limit of a case, in minutes or as sbatch accepts it (default: from the measured cost)");
  tool.text(slurm.memory, "--memory", "MB", "memory of a case (default: from the measured cost)");
  tool.integer(slurm.cores, "--cores", "N", "cores of a case", 1, 1024);
  tool.text(slurm.options, "--options", "OPTIONS",
            "further options of sbatch, passed on unchanged");
  tool.flag(slurm.resume, "--resume", "submit only the cases that are missing or out of date");
  tool.number(
      slurm.elements, "--elements", "N",
      "number of elements along an edge (ELEMENTS) of the cases whose files do not ask for more");
  tool.text(slurm.element, "--element", "NAME", "element (ELEMENT) of every case, q1p0 or q2p1");
  tool.text(cost, "--cost", "FILE.tsv",
            "table of the cost of a case, used until cases of this cohort have been measured");
}

}  // namespace

int main(int argc, char** argv) {
  SlurmRequest slurm;
  const std::vector<Kind> kinds = kinds_for(slurm);
  std::string name, cost = "pipelines/cohort-cost.tsv";
  Words words;
  Tool tool("cases",
            "reading, checking and running of cases, cohorts and studies for the pipeline");
  tool.describe(
      "Performs the work of Makefile.pipeline that is not a matter of make: it reads case files and studies as data, refuses "
      "a scan in a folder that belongs to another one, runs the cases of a cohort, and submits them to Slurm. It is called "
      "by the makefile and is not meant to be called by hand.");
  for (const Kind& kind : kinds)
    tool.describe(kind.name + " " + kind.arguments + ": " + kind.help + ".");
  tool.word(name, "KIND", "action, from the list above");
  tool.words(words, "ARGUMENT", "arguments of the action: files, folders and names");
  declare_slurm(tool, slurm, cost);
  tool.check([&] {
    const Kind& kind = kind_called(kinds, name);
    if (words.size() < kind.least)
      throw input_error(name, ": has ", words.size(), " arguments and needs ", kind.least,
                        "; usage: cases ", name, " ", kind.arguments);
  });
  tool.example("cases list patients MR SIDE PRESET", "list the cases of a cohort");
  tool.example("cases record runs/scan-left left scan.nrrd",
               "record that this folder was made from this scan");
  return tool.main(argc, argv, [&](Run& run) {
    slurm.cost = cost;
    run.report().set("kind", name);
    run.print(kind_called(kinds, name).make(words));
  });
}
