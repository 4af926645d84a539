// SPDX-License-Identifier: GPL-3.0-or-later
#include "command/request.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "cli/parse.hpp"
#include "core/error.hpp"

namespace breast {

namespace {

bool is_setting(const std::string& word) {
  const std::size_t equals = word.find('=');
  return equals != std::string::npos && equals > 0 &&
         std::all_of(word.begin(), word.begin() + long(equals), [](unsigned char c) {
           return std::isupper(c) || c == '_' || std::isdigit(c);
         });
}

Argument option(ArgumentKind kind, const std::string& name, const std::string& placeholder,
                const std::string& help, std::function<void(const std::string&)> store) {
  Argument argument;
  argument.kind = kind;
  argument.names = {name};
  argument.placeholder = placeholder;
  argument.help = help;
  argument.store = [store](const std::vector<std::string>& given) {
    store(given.empty() ? "" : given.front());
  };
  return argument;
}

Argument positional(const std::string& placeholder, const std::string& help, std::string& value) {
  Argument argument;
  argument.kind = ArgumentKind::text;
  argument.placeholder = placeholder;
  argument.help = help;
  argument.required = true;
  argument.store = [&value](const std::vector<std::string>& given) { value = given.front(); };
  return argument;
}

void declare_options(Declaration& d, PipelineRequest& r, const std::string& jobs_help) {
  Argument runs =
      option(ArgumentKind::text, "--runs", "DIR",
             "folder in which every run has a folder of its own; it is created if it does not "
             "exist",
             [&r](const std::string& value) { r.runs = value; });
  runs.default_text = r.runs;
  d.options.push_back(runs);
  Argument jobs = option(ArgumentKind::integer, "--jobs", "N", jobs_help,
                         [&r](const std::string& value) { r.jobs = std::stoi(value); });
  jobs.names = {"-j", "--jobs"};
  jobs.low = 1;
  jobs.high = 64;
  jobs.default_text = std::to_string(r.jobs);
  d.options.push_back(jobs);
  d.options.push_back(option(ArgumentKind::flag, "--dry-run", "",
                             "print the commands without running them",
                             [&r](const std::string&) { r.plan = true; }));
}

void declare_target(Declaration& d, PipelineRequest& r) {
  Argument target = option(ArgumentKind::text, "--target", "NAME",
                           "target to make: chain, figures, summary, page, report or another "
                           "target of the pipeline (breast help settings)",
                           [&r](const std::string& value) { r.target = value; });
  target.default_text = r.target;
  d.options.push_back(target);
}

// Of one case, two stages can run side by side most of the time, such as the compressions in both views.
void declare_case_options(Declaration& d, PipelineRequest& r) {
  r.jobs = 2;
  declare_options(d, r, "number of stages that may run at the same time; they share the cores");
}

void declare_run(Declaration& d, PipelineRequest& r) {
  d.summary = "the whole chain on a breast MR scan";
  d.paragraphs = {
      "Runs the pipeline on a scan: segment, fit-hermite, hexmesh, backward, forward, compress in both views, project-mammogram, the "
      "matching of both views, and the figures. Stages whose inputs and settings are unchanged are not run again.",
      "Settings of the form SETTING=value may follow the scan, such as TUMOUR=x,y,z, "
      "REDUCTION=40, CHEST_WALL=labels.nrrd or MATERIALS=wellman; `breast help settings` lists "
      "them. File names are relative to the current folder. A scan, or a file in a setting, "
      "whose name make cannot handle (blanks, quotes, brackets, ...) is accessed through a link "
      "with a plain name in DIR/.names; the name of the run's folder has underscores in place "
      "of such characters."};
  d.positionals.push_back(positional(
      "SCAN",
      "T1-weighted MR without fat saturation, patient prone: NRRD, NIfTI, MetaImage or a DICOM folder",
      r.scan));
  Argument side =
      option(ArgumentKind::choice, "--side", "NAME", "breast to model: the patient's left or right",
             [&r](const std::string& value) { r.side = value; });
  side.choices = {"left", "right"};
  d.options.push_back(side);
  declare_case_options(d, r);
  declare_target(d, r);
  d.examples = {{"breast run scan.nrrd --side left", "results in ./runs/scan-left"},
                {"breast run 'my scans/patient 1' --side right TUMOUR=-60,-40,12 --runs /data/runs",
                 "a DICOM folder, and a tumour to follow"}};
}

void declare_demo(Declaration& d, PipelineRequest& r) {
  d.summary = "the whole chain on a simulated breast whose truth is known";
  d.paragraphs = {
      "Simulates the MR scan of a phantom of average size, runs the pipeline on it, and shows "
      "the table of landmark displacements, the errors against the phantom's truth, and where "
      "the pictures are. SETTING=value changes a setting that `breast help settings` lists, "
      "such as PRESET=paper."};
  declare_case_options(d, r);
  declare_target(d, r);
  d.examples = {{"breast demo", "results in ./runs/average"},
                {"breast demo PRESET=small ELEMENTS=6 'PHANTOM_OPTIONS=--coarse 2'",
                 "a tiny breast, in about a minute"}};
}

// The resources that a job requests from the cluster, each as a setting of the pipeline.
void declare_request(Declaration& d, PipelineRequest& r, const std::string& name,
                     const std::string& placeholder, const std::string& help) {
  std::string setting = "CLUSTER_";
  for (const char c : name.substr(2)) setting += char(std::toupper(static_cast<unsigned char>(c)));
  d.options.push_back(option(ArgumentKind::text, name, placeholder, help,
                             [&r, name, setting](const std::string& value) {
                               if (!r.settings.emplace(setting, value).second)
                                 throw input_error(name, " and ", setting, "= are both given");
                             }));
}

void declare_cluster(Declaration& d, PipelineRequest& r) {
  d.options.push_back(option(ArgumentKind::flag, "--slurm", "",
                             "submit the cases to Slurm as one job array, followed by a job "
                             "that makes the table; --dry-run prints the script",
                             [&r](const std::string&) { r.slurm = true; }));
  d.options.push_back(option(ArgumentKind::flag, "--local", "",
                             "run the cases as processes on this machine (the default)",
                             [&r](const std::string&) { r.local = true; }));
  d.options.push_back(option(ArgumentKind::flag, "--resume", "",
                             "with --slurm, submit only the cases that are missing or out of "
                             "date; runs on this machine always do so",
                             [&r](const std::string&) { r.settings["RESUME"] = "1"; }));
  declare_request(d, r, "--partition", "NAME", "with --slurm, the partition");
  declare_request(d, r, "--account", "NAME", "with --slurm, the account");
  declare_request(d, r, "--time", "T",
                  "with --slurm, the time limit of a case in the format of sbatch, such as 45 "
                  "(minutes) or 2:00:00 (default: estimated from measured cost)");
  declare_request(d, r, "--memory", "MB",
                  "with --slurm, the memory of a case (default: estimated from measured cost)");
  declare_request(d, r, "--cores", "N", "with --slurm, the number of cores of a case (default: 1)");
}

void declare_cohort(Declaration& d, PipelineRequest& r) {
  d.summary = "the whole chain on every case of a folder";
  d.paragraphs = {
      "Runs the pipeline on every case file of DIR (*.case, */case.txt, with one KEY = VALUE "
      "per line, where MR or PRESET names the scan). It continues after a case that fails, and "
      "ends with one table of all cases (cohort.tsv, cohort.html) and the contours of every "
      "segmentation (contours.html). File names in a case file are relative to the current "
      "folder. SETTING=value applies to all cases and overrides their files."};
  d.positionals.push_back(positional("DIR", "folder of case files", r.scan));
  declare_options(d, r, "number of cases that may run at the same time; they share the cores");
  declare_cluster(d, r);
  d.examples = {{"breast cohort patients --jobs 4", "results in ./runs/cohort-patients"},
                {"breast cohort patients --slurm --partition long --resume",
                 "a job array of the cases that are missing or out of date"}};
}

Declaration declare(const std::string& name, PipelineRequest& r) {
  Declaration d;
  d.name = "breast " + name;
  d.version = BREAST_VERSION;
  if (name == "run")
    declare_run(d, r);
  else if (name == "demo")
    declare_demo(d, r);
  else if (name == "cohort")
    declare_cohort(d, r);
  else
    throw failed_error("no command ", name);
  return d;
}

// Removes SETTING=value words from the tokens. The first word may be SCAN or DIR, whatever its
// name.
void take_settings(Tokens& tokens, bool scan_first, std::map<std::string, std::string>& settings) {
  std::vector<std::string> rest;
  for (const std::string& word : tokens.positionals) {
    const bool scan = scan_first && rest.empty() && std::filesystem::exists(word);
    if (!is_setting(word) || scan) {
      rest.push_back(word);
      continue;
    }
    const std::string name = word.substr(0, word.find('='));
    if (!settings.emplace(name, word.substr(name.size() + 1)).second)
      throw input_error(name, " is given twice");
  }
  tokens.positionals = rest;
}

void check_request(const PipelineRequest& r) {
  for (const char* name : {"RUNS", "RUN"}) {
    if (r.settings.count(name)) throw input_error(name, " is not a setting here: give --runs DIR");
  }
  const char* scan = r.command == "cohort" ? "COHORT" : "MR";
  if (r.settings.count(scan))
    throw input_error(
        scan, " is not a setting here: ",
        r.command == "demo" ? "breast run SCAN is for scans" : "it is the first argument");
  const auto side = r.settings.find("SIDE");
  if (r.command == "run" && r.side.empty() && side == r.settings.end())
    throw input_error("--side left|right is missing: which breast of the patient is it?");
  if (!r.side.empty() && side != r.settings.end() && side->second != r.side)
    throw input_error("--side ", r.side, " and SIDE=", side->second, " contradict each other");
  if (r.slurm && r.local) throw input_error("--slurm and --local contradict each other");
  if (!r.slurm) {
    for (const auto& [name, value] : r.settings) {
      if (name.starts_with("CLUSTER_"))
        throw input_error(name, ": is a request to Slurm; give --slurm");
    }
  }
  if (r.slurm && r.jobs != 1)
    throw input_error("--jobs: is for runs on this machine; with --slurm give --cores");
  const bool word = std::all_of(r.target.begin(), r.target.end(),
                                [](unsigned char c) { return std::isalnum(c) || c == '-'; });
  if (!word || r.target.front() == '-')
    throw input_error("--target '", r.target, "': is not the name of a target");
}

}  // namespace

Declaration pipeline_command(const std::string& name) {
  PipelineRequest defaults;
  Declaration d = declare(name, defaults);
  Argument settings;
  settings.placeholder = "[SETTING=value]";
  settings.help = "a setting of the pipeline: `breast help settings` lists them";
  settings.repeatable = true;
  d.positionals.push_back(settings);
  for (auto* list : {&d.options, &d.positionals}) {
    for (Argument& argument : *list) argument.store = nullptr;
  }
  return d;
}

PipelineRequest parse_request(const std::string& command,
                              const std::vector<std::string>& arguments) {
  PipelineRequest r;
  r.command = command;
  if (command == "cohort") r.target = "cohort";
  Declaration d = declare(command, r);
  Tokens tokens = tokenize(d, arguments);
  take_settings(tokens, !d.positionals.empty(), r.settings);
  assign(d, tokens);
  check_request(r);
  if (r.slurm) r.settings["CLUSTER"] = "slurm";
  return r;
}

}  // namespace breast
