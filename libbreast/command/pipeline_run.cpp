// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/pipeline_run.hpp"

#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <sstream>

#include "command/child.hpp"
#include "command/make_name.hpp"
#include "command/request.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text/words.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

// Settings that may name a file or folder of the caller's.
const std::set<std::string> path_settings = {
    "CHEST_WALL", "MATERIALS", "TUMOUR",  "CASE_FILE", "STUDY",   "SEGMENT", "FIT_HERMITE",
    "HEXMESH",    "BACKWARD",  "FORWARD", "COMPRESS",  "PROJECT", "CC2MLO"};

// The folder of all runs under a name that make can handle.
std::string runs_for_make(const std::string& runs) {
  const fs::path whole = fs::weakly_canonical(fs::absolute(runs));
  std::string name;
  for (const std::string& way :
       {runs, whole.lexically_proximate(fs::current_path()).string(), whole.string()}) {
    if (name.empty() && plain_for_make(way) && way != ".") name = way;
  }
  if (name.empty())
    throw input_error(
        "--runs '", runs,
        "': make cannot write to a folder with such a name; start from the folder above it, or "
        "give a name without blanks, quotes and brackets");
  std::error_code problem;
  fs::create_directories(name, problem);
  if (!fs::is_directory(name))
    throw input_error("--runs '", runs, "': is not a folder and cannot be created");
  // Tested by writing rather than by permissions, because root has all permissions and still cannot
  // write to /proc.
  const fs::path links = fs::path(name) / ".names";
  if (!fs::is_directory(links)) {
    if (!fs::create_directory(links, problem))
      throw input_error("--runs '", runs, "': is not writable");
    fs::remove(links, problem);
  }
  return name;
}

// Every setting in the form that make accepts, with links where the name of a file needs one.
std::vector<std::string> settings_for_make(const PipelineRequest& r, const std::string& runs) {
  const fs::path links = fs::path(runs) / ".names";
  std::vector<std::string> words{"RUNS=" + runs};
  if (!r.scan.empty())
    words.push_back((r.command == "cohort" ? "COHORT=" : "MR=") + name_for_make(r.scan, links));
  if (!r.side.empty() && r.settings.count("SIDE") == 0) words.push_back("SIDE=" + r.side);
  // The report of the demonstration is that of its own phantom; make's default for a report is the paper's, with its tables.
  if (r.command == "demo" && r.target == "report" &&
      r.settings.count("PRESET") + r.settings.count("PAPER") == 0)
    words.push_back("PRESET=average");
  for (const auto& [name, value] : r.settings) {
    std::error_code none;
    const bool file = path_settings.count(name) != 0 && fs::exists(value, none);
    words.push_back(name + "=" + (file ? name_for_make(value, links) : value));
  }
  return words;
}

// Shortens "pipelines/check-settings.mk:47: *** SIDES: no such setting. Stop." to the message
// without make's additions.
std::string refusal(const Captured& made) {
  std::istringstream lines(made.err);
  std::string line, last;
  while (std::getline(lines, line)) {
    if (line.empty()) continue;
    last = line;
    if (line.find("*** ") != std::string::npos) break;
  }
  const std::size_t stars = last.find("*** ");
  if (stars != std::string::npos) last = last.substr(stars + 4);
  const std::size_t stop = last.rfind(".  Stop.");
  if (stop != std::string::npos) last.resize(stop);
  const std::string help = "`make -f Makefile.pipeline help`";
  const std::size_t at = last.find(help);
  if (at != std::string::npos) last.replace(at, help.size(), "`breast help settings`");
  const std::string no_rule = "No rule to make target '";
  if (!last.starts_with(no_rule)) return last;
  const std::string name =
      last.substr(no_rule.size(), last.find('\'', no_rule.size()) - no_rule.size());
  if (last.find(", needed by ") != std::string::npos)
    return "'" + name + "', which is named in a setting, does not exist";
  return "'" + name +
         "' is not a target of the pipeline; `breast help settings` lists the "
         "targets";
}

// The output of make for `words`; throws if make refuses.
std::string ask(const std::vector<std::string>& words) {
  const Captured made = capture_child(words);
  if (made.exit_code != 0) throw input_error(refusal(made));
  return made.out;
}

std::string make_file(const Installation& installation) {
  const fs::path& file = installation.pipeline;
  if (!fs::exists(file))
    throw failed_error(file.string(), " does not exist: the pipeline is not installed");
  // In the source tree it is called as in the README, so that both ways share their runs.
  std::error_code none;
  const std::string name = fs::equivalent(file.parent_path(), fs::current_path(), none)
                               ? file.filename().string()
                               : file.string();
  if (!plain_for_make(name))
    throw failed_error("make cannot use the pipeline at '", name,
                       "'; install libbreast in a folder without blanks, quotes and brackets");
  return name;
}

std::optional<fs::file_time_type> written(const fs::path& file) {
  std::error_code missing;
  const auto time = fs::last_write_time(file, missing);
  return missing ? std::nullopt : std::optional(time);
}

void print(const std::string& text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size() || std::fflush(stdout) != 0)
    throw failed_error("stdout cannot be written");
}

// Runs the stages. A new summary is printed when it is made; one that was up to date is printed
// here.
int make_and_show(const std::vector<std::string>& words, const std::string& run) {
  const fs::path table = fs::path(run) / "summary.txt";
  const auto before = written(table);
  const int code = run_child(words);
  if (code != 0) {
    std::fprintf(stderr,
                 "breast: stopped; finished results are in %s, and the same command continues from "
                 "there\n",
                 run.c_str());
    return code > 128 ? code : 1;
  }
  if (words.back() == "summary" && before && before == written(table)) print(read_text(table));
  print("Results: " + run + "\n");
  if (words.back() == "summary") {
    print(
        "More: the same command with --target report (one page for reading and printing), page (both views, interactive) or slicer\n");
  }
  return 0;
}

}  // namespace

std::vector<std::string> pipeline_settings(const Installation& installation) {
  const Captured made = capture_child({"make", "-s", "-f", make_file(installation), "settings"});
  return made.exit_code == 0 ? words_of(made.out) : std::vector<std::string>{};
}

// The help of the makefile, in an installation without what needs the source tree, and with the command that is called there.
std::string settings_help(const Installation& installation) {
  std::istringstream lines(read_text(installation.pipeline.parent_path() / "pipelines/help.txt"));
  if (!installation.is_package()) return lines.str();
  std::string text =
      "breast run SCAN --side left|right [--target TARGET] [SETTING=VALUE]...\n"
      "breast demo [--target TARGET] [SETTING=VALUE]...                minutes are for 2 cores\n";
  bool source = false;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    if (line.starts_with("targets that need the source tree")) source = true;
    if (!source) text += line + "\n";
    if (line.empty()) source = false;
  }
  return text;
}

int run_pipeline(const Installation& installation, const std::string& command,
                 const std::vector<std::string>& arguments) {
  const PipelineRequest request = parse_request(command, arguments);
  if (!request.scan.empty() && !fs::exists(request.scan))
    throw input_error("'", request.scan, "' does not exist");
  std::vector<std::string> words{"make", "-f", make_file(installation)};
  const std::vector<std::string> settings = settings_for_make(request, runs_for_make(request.runs));
  words.insert(words.end(), settings.begin(), settings.end());
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return more;
  };

  std::string run = ask(with({"-s", "where"}));
  if (!run.empty()) run.pop_back();  // the end of its line
  const std::string plan = ask(with({"-n", request.target}));
  if (request.plan) {
    print(request.slurm ? ask(with({"-s", "cohort-script"})) : plan);
    return 0;
  }
  if (request.slurm) return run_child(with({"-s", request.target})) == 0 ? 0 : 1;
  return make_and_show(with({"-j" + std::to_string(request.jobs), request.target}), run);
}

}  // namespace breast
