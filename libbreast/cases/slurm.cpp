// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/slurm.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <regex>
#include <sstream>

#include "cases/case_file.hpp"
#include "cases/case_run.hpp"
#include "command/child.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "core/text/lists.hpp"
#include "core/text/one_line.hpp"
#include "study/cells.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

// A word quoted for a shell, whatever characters it contains.
std::string quoted(const std::string& word) {
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

Words lines_of(const fs::path& file) {
  std::istringstream in(read_text(file));
  Words lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

std::string text_of(const std::vector<SlurmCase>& cases) {
  std::string text;
  for (const SlurmCase& one : cases) text += one.name + "\t" + one.file + "\t" + one.kind + "\n";
  return text;
}

// The make command of the pipeline with CLUSTER empty: within a job, make runs the case itself
// instead of submitting it to Slurm.
Words command_of(Words words, const Words& more) {
  words.push_back("CLUSTER=");
  words.insert(words.end(), more.begin(), more.end());
  return words;
}
Words case_command(const Words& make, const fs::path& runs, const SlurmCase& one) {
  return command_of(make, {"COHORT=", "RUNS=" + runs.string(), "CASE_FILE=" + one.file,
                           "CASE=" + one.name, "summary"});
}

// A make started here must not act as a sub-make of the make that started this program.
void leave_make() {
  for (const char* name : {"MAKEFLAGS", "MFLAGS", "MAKEOVERRIDES", "MAKELEVEL"}) unsetenv(name);
}

std::string of_environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

struct Job {
  std::string name, time, memory_mb, output, command, remark;
  int cores = 1;
};

std::string job_script(const SlurmRequest& request, const fs::path& folder, const Job& job) {
  const auto asked = [](const char* option, const std::string& value) {
    return value.empty() ? "" : "#SBATCH --" + std::string(option) + "=" + value + "\n";
  };
  return "#!/bin/bash\n" + asked("job-name", job.name) + asked("time", job.time) +
         asked("mem", job.memory_mb + "M") + asked("cpus-per-task", std::to_string(job.cores)) +
         asked("output", (folder / job.output).string()) +
         "#SBATCH --requeue\n#SBATCH --open-mode=append\n" + asked("partition", request.partition) +
         asked("account", request.account) + job.remark + "cd " + quoted(fs::current_path()) +
         " || exit 1\nexec " + job.command + "\n";
}

std::string minutes_of(const SlurmRequest& request, const CaseCost& cost) {
  return request.time.empty() ? std::to_string(cost.minutes) : request.time;
}
std::string memory_of(const SlurmRequest& request, const CaseCost& cost) {
  return request.memory.empty() ? std::to_string(cost.memory_mb) : request.memory;
}
std::string source_of(const SlurmRequest& request, const CaseCost& cost) {
  return cost.source + (request.time.empty() ? "" : "; time as asked") +
         (request.memory.empty() ? "" : "; memory as asked");
}

fs::path next_folder(const fs::path& runs) {
  int number = 1;
  while (fs::exists(runs / ".slurm" / std::to_string(number))) ++number;
  return runs / ".slurm" / std::to_string(number);
}

// The largest number of tasks in a job array: the site's setting, or Slurm's default if unknown.
std::size_t largest_array() {
  constexpr std::size_t usual = 1001;
  Captured said;
  try {
    said = capture_child({"scontrol", "show", "config"});
  } catch (const Error&) {
    return usual;
  }
  std::smatch found;
  return std::regex_search(said.out, found, std::regex("MaxArraySize *= *([0-9]+)"))
             ? std::size_t(std::stoul(found[1]))
             : usual;
}

// Submits a job and returns its number.
std::string sbatch(const SlurmRequest& request, const Words& options, const Words& script) {
  Words words{"sbatch", "--parsable"};
  words.insert(words.end(), options.begin(), options.end());
  std::istringstream more(request.options);
  for (std::string word; more >> word;) words.push_back(word);
  words.insert(words.end(), script.begin(), script.end());
  const Captured said = capture_child(words);
  if (said.exit_code != 0) throw failed_error(one_line(said.err));
  return said.out.substr(0, said.out.find_first_of(";\n"));
}

std::string submit_arrays(const SlurmRequest& request, const fs::path& folder, std::size_t total) {
  const std::size_t size = largest_array();
  std::string jobs;
  for (std::size_t offset = 0; offset < total; offset += size) {
    const std::size_t count = std::min(total - offset, size);
    try {
      jobs += ":" + sbatch(request, {message("--array=0-", count - 1)},
                           {folder / "array.sh", std::to_string(offset)});
    } catch (const Error& error) {
      throw failed_error(
          error.what(), "; sbatch accepted ", offset, " of ", total, " cases",
          jobs.empty() ? "" : " (jobs" + jobs + ")",
          "; when they have ended, submit the others by the same command with --resume");
    }
  }
  return jobs;
}

void check_sbatch() {
  for (const std::string& folder : split(of_environment("PATH"), ':'))
    if (access((fs::path(folder) / "sbatch").c_str(), X_OK) == 0) return;
  throw failed_error(
      "the program sbatch was not found in PATH, so that no job can be submitted to Slurm from this "
      "machine; install slurm-client, or run the cases on this machine without --slurm");
}

}  // namespace

std::vector<SlurmCase> slurm_cases(const fs::path& list) {
  std::vector<SlurmCase> cases;
  for (const std::string& line : lines_of(list)) {
    const Words cells = split(line, '\t');
    if (cells.size() != 3)
      throw input_error(list.string(), ": the line '", line, "' is no case: it has ", cells.size(),
                        " cells, and CASE, FILE and KIND are needed; remove the file and start the "
                        "cohort again");
    cases.push_back({cells[0], cells[1], cells[2]});
  }
  return cases;
}

CaseCost dearest_case(const SlurmRequest& request, const std::vector<SlurmCase>& cases) {
  constexpr double most_elements = 64;  // hexmesh refuses more
  double size = request.elements;
  std::string element = request.element.empty() ? "q1p0" : request.element;
  for (const SlurmCase& one : cases) {
    const std::string text = read_text(one.file);
    if (const auto asked = number_in(setting_in(text, "ELEMENTS")))
      size = std::max(size, std::min(*asked, most_elements));
    if (setting_in(text, "ELEMENT") == "q2p1") element = "q2p1";
  }
  const auto measured = table_if_any(request.runs / "cost.tsv");
  return case_cost(measured ? &*measured : nullptr, read_table(request.cost), request.cores,
                   element, size);
}

std::string array_script(const SlurmRequest& request, const fs::path& folder,
                         const CaseCost& cost) {
  return job_script(
      request, folder,
      {request.runs.filename(), minutes_of(request, cost), memory_of(request, cost), "%A_%a.out",
       quoted(request.program) + " task " + quoted(folder) + " \"${1:-0}\" --quiet",
       message("# Time and memory: from ", source_of(request, cost),
               ".\n# Task K runs the case on line K + 1 of ", (folder / "cases").string(),
               ", in chunks K + 1 + $1.\n"),
       request.cores});
}

std::vector<SlurmCase> wanted_cases(const SlurmRequest& request) {
  std::vector<SlurmCase> cases = slurm_cases(request.runs / ".cases");
  if (!request.resume) return cases;
  leave_make();
  std::erase_if(cases, [&](const SlurmCase& one) {
    if (!is_done(request.runs / (one.name + ".status"))) return false;
    Words words = case_command(request.command, request.runs, one);
    words.insert(words.begin() + 1, "-q");
    return capture_child(words).exit_code == 0;
  });
  return cases;
}

std::string slurm_plan(const SlurmRequest& request) {
  const CaseCost cost = dearest_case(request, slurm_cases(request.runs / ".cases"));
  return message("# sbatch --array=0-", int(wanted_cases(request).size()) - 1,
                 " [OFFSET: tasks before those of this chunk]\n",
                 array_script(request, next_folder(request.runs), cost));
}

std::string submit_to_slurm(const SlurmRequest& request) {
  check_sbatch();
  const std::vector<SlurmCase> all = slurm_cases(request.runs / ".cases"),
                               wanted = wanted_cases(request);
  const CaseCost cost = dearest_case(request, all);
  const fs::path folder = next_folder(request.runs);
  fs::create_directories(folder);
  write_text(folder / "command", join(request.command, "\n") + "\n");
  write_text(folder / "cases", text_of(wanted));
  write_text(folder / "array.sh", array_script(request, folder, cost));
  // The table takes one or two seconds per case; 30 minutes and 6 seconds per case are requested.
  write_text(folder / "table.sh",
             job_script(request, folder,
                        {request.runs.filename().string() + "-table",
                         std::to_string(30 + all.size() / 10), "1024", "table.out",
                         quoted(request.program) + " table " + quoted(folder) + " " +
                             quoted(request.cohort) + " --quiet",
                         "", 1}));
  const std::string jobs = submit_arrays(request, folder, wanted.size());
  const std::string last =
      sbatch(request, jobs.empty() ? Words{} : Words{"--dependency=afterany" + jobs},
             {folder / "table.sh"});
  return message(wanted.size(), " of ", all.size(), " cases given to Slurm, job",
                 jobs.empty() ? " none" : jobs, "; then the table, job ", last,
                 "\nTime and memory of a case: ", minutes_of(request, cost), " minutes, ",
                 memory_of(request, cost), " MB, from ", source_of(request, cost), "\n",
                 request.runs.string(),
                 "/cohort.tsv and cohort.html appear when the last has ended\n");
}

std::string run_slurm_task(const fs::path& folder, int offset) {
  leave_make();
  const std::vector<SlurmCase> cases = slurm_cases(folder / "cases");
  const std::string given = of_environment("SLURM_ARRAY_TASK_ID");
  const auto task = number_in(given);
  if (!task || *task < 0 || std::size_t(*task) + std::size_t(offset) >= cases.size())
    throw input_error("SLURM_ARRAY_TASK_ID: task '", given, "' with the offset ", offset,
                      " is none of the ", cases.size(), " cases listed in ",
                      (folder / "cases").string(), "; submit the cohort again");
  const SlurmCase& one = cases[std::size_t(*task) + std::size_t(offset)];
  const fs::path runs = folder.parent_path().parent_path(), status = runs / (one.name + ".status");
  const std::string cores = of_environment("SLURM_CPUS_PER_TASK");
  setenv("OMP_NUM_THREADS", cores.empty() ? "1" : cores.c_str(), 1);  // nproc prints it, too
  char node[256] = "";
  gethostname(node, sizeof node - 1);
  const int starts = int(number_in(of_environment("SLURM_RESTART_COUNT")).value_or(0)) + 1;
  // Printed at the start, because nothing could be printed at the end if the node were lost.
  dprintf(STDOUT_FILENO, "%s on %s, job %s, start %d\n", one.name.c_str(), node,
          of_environment("SLURM_JOB_ID").c_str(), starts);
  run_case({status, runs / (one.name + ".log"), one.kind == "phantom",
            case_command(lines_of(folder / "command"), runs, one)});
  const std::string said = read_text(status);
  if (!is_done(status)) throw failed_error(one.name, ": ", one_line(said));
  return said;
}

int run_slurm_table(const fs::path& folder, const std::string& cohort) {
  leave_make();
  const fs::path runs = folder.parent_path().parent_path();
  return run_child(
      command_of(lines_of(folder / "command"),
                 {"COHORT=" + cohort, "RUNS=" + runs.parent_path().string(), "cohort-table"}));
}

}  // namespace breast
