// SPDX-License-Identifier: GPL-3.0-or-later
// Texts and pages about a case, values of reports, and tables in the pages of docs/.
#include <sys/stat.h>

#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <sstream>
#include <thread>

#include "cli/declaration.hpp"
#include "command/child.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/temporary_folder.hpp"
#include "core/text/lists.hpp"
#include "core/text/one_line.hpp"
#include "lineage/pair_rules.hpp"
#include "study/cells.hpp"
#include "study/pages/markdown.hpp"
#include "study/pages/report_page.hpp"
#include "study/paper/findings.hpp"
#include "study/summary.hpp"
#include "study/verify.hpp"
#include "tabulate_kinds.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

using Request = TabulateRequest;

// "runs/x/": the folder's name is its last part.
fs::path folder_of(const std::string& word) {
  fs::path folder = word;
  return folder.has_filename() ? folder : folder.parent_path();
}

std::string note_of(const Request& r) {
  return r.calibrated.empty() ? "" : calibration_note(r.calibrated, r.side);
}

std::string summary(const Request& r) {
  return summary_text(folder_of(r.word(0)), {read_advice(r.own("advice.tsv")),
                                             r.words.size() > 1 ? r.word(1) : "", note_of(r)});
}

std::string processor() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("model name") && line.find(": ") != std::string::npos)
      return line.substr(line.find(": ") + 2);
  return "a processor without a name";
}

std::string report(const Request& r) {
  const fs::path run = folder_of(r.word(0));
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char made[32];
  std::strftime(made, sizeof made, "%Y-%m-%d %H:%M UTC", &utc);
  ReportContext context{r.word(1), read_advice(r.own("advice.tsv")), {}, note_of(r), ""};
  context.made = std::string("Made ") + made + "\nwith libbreast " + BREAST_VERSION + ", BLAS " +
                 StageReport::read(run / "reference.json").text("blas") + ", " +
                 std::to_string(std::thread::hardware_concurrency()) + " cores (" + processor() +
                 ").";
  std::istringstream limits(read_text(r.own("limits.txt")));
  for (std::string line; std::getline(limits, line);) context.limits.push_back(line);
  return report_page(run, context);
}

// A headless Chromium with a temporary profile prints the page. Its sandbox remains on unless this
// process runs as root, since Chromium then refuses to start with it. Scripts are forbidden by the
// content security policy of the page itself, because Chromium 156 prints nothing if they are
// switched off by an option. No network is reachable.
std::string pdf(const Request& r) {
  const TemporaryFolder work;
  const fs::path made = work / "out.pdf";
  std::vector<std::string> words{"timeout", "120", r.word(0), "--headless"};
  if (geteuid() == 0) words.push_back("--no-sandbox");
  words.insert(words.end(),
               {"--proxy-server=127.0.0.1:9", "--disable-gpu", "--disable-dev-shm-usage",
                "--user-data-dir=" + (work / "profile").string(), "--no-pdf-header-footer",
                "--print-to-pdf=" + made.string(), "file://" + fs::canonical(r.word(1)).string()});
  const Captured said = capture_child(words);
  if (said.exit_code != 0 || !fs::exists(made) || fs::file_size(made) == 0)
    throw failed_error(r.word(0), " made no PDF of ", r.word(1), ": ", one_line(said.err));
  write_text(r.word(2), read_text(made));
  return "";
}

std::string verified(const Request& r) {
  const Verification result = verify(r.table(0), r.word(1));
  if (result.failed == 0) return result.table.text();
  std::string which;
  for (const Row& row : result.table.rows)
    if (row.back() != "ok")
      which += "; " + row[0] + " " + row[1] + " " + row[2] + " is " + row[4] + ", expected " +
               row[3] + " within " + row[5];
  throw failed_error(result.failed, " values differ from ", r.word(0), which);
}

std::string key(const Request& r) {
  const StageReport report = StageReport::read(r.word(0));
  const std::string value = report.text(r.word(1));
  if (!value.empty()) return value + "\n";
  const auto number = report.first(r.word(1));
  if (!number) throw input_error(r.word(0), ": has no '", r.word(1), "'");
  return format_number(*number) + "\n";
}

std::string place(const Request& r) {
  const std::string what = r.words.size() > 2 ? r.word(2) : "imaged";
  const auto found = StageReport::read(r.word(0)).place(r.word(1), what);
  if (!found) throw input_error(r.word(0), ": has no landmark '", r.word(1), "'");
  return format_number(found->x()) + "," + format_number(found->y()) + "," +
         format_number(found->z()) + "\n";
}

// Warnings as a table of text, for other programs.
std::string warnings(const Request& r) {
  Table table{{"stages", "warning", "advice"}, {}};
  for (const Warning& w : warnings_of(r.word(0), read_advice(r.own("advice.tsv"))))
    table.rows.push_back({w.stages, w.text, cell_or_dash(w.remedy)});
  return table.text();
}

const std::string runs_of_tables = "docs/tables/runs.tsv";

// The commit of the source tree in which this program runs, marked if there are uncommitted
// changes.
std::string commit_here() {
  const Captured said = capture_child({"git", "describe", "--always", "--dirty", "--exclude", "*"});
  if (said.exit_code != 0) throw failed_error("git describe: ", one_line(said.err));
  return one_line(said.out.substr(0, said.out.find('\n')));
}

// The date of a run: that in its report, or the date on which its table was written.
std::string date_of(const fs::path& file) {
  if (file.extension() == ".json") {
    const std::string date = StageReport::read(file).text("date");
    if (date.empty()) throw input_error(file.string(), ": has no date of a run");
    return date.substr(0, date.find('T'));
  }
  struct stat state {};
  if (stat(file.c_str(), &state) != 0) throw input_error(file.string(), ": does not exist");
  std::tm utc{};
  gmtime_r(&state.st_mtim.tv_sec, &utc);
  char date[16];
  std::strftime(date, sizeof date, "%Y-%m-%d", &utc);
  return date;
}

std::string made(const Request& r) {
  const std::string date = date_of(r.word(1));
  const Table runs =
      table_if_any(runs_of_tables).value_or(Table{{"table", "date", "commit", "machine"}, {}});
  write_text(runs_of_tables, with_run(runs, r.word(0), date, commit_here(),
                                      std::to_string(std::thread::hardware_concurrency()) +
                                          " cores, " + processor())
                                 .text());
  return "";
}

std::string pages(const Request& r) {
  const bool fill = r.word(0) == "fill";
  if (!fill && r.word(0) != "check")
    throw input_error("pages: '", r.word(0), "' is neither fill nor check");
  const Table runs = table_if_any(runs_of_tables).value_or(Table{{"table"}, {}});
  std::string all;
  for (const std::string& name : r.rest(1)) {
    const std::string page = read_text(name);
    const std::string filled = with_tables(
        page, name, [](const std::string& file) { return read_text(file); },
        [&](const std::string& file) { return run_line(runs, file); });
    all += page;
    if (filled == page) continue;
    if (!fill)
      throw failed_error(
          name,
          ": its tables are not those of docs/tables: make -f Makefile.pipeline validation-page");
    write_text(name, filled);
  }
  if (fill) return "";
  for (const auto& entry : fs::directory_iterator("docs/tables")) {
    const std::string file = entry.path().generic_string();
    if (entry.path().extension() == ".tsv" && file != runs_of_tables &&
        all.find("<!-- table " + file + " -->") == std::string::npos)
      throw failed_error(file, ": stands in no page");
  }
  return "";
}

std::string numbers(const Request& r) {
  const std::vector<std::string> wrong = wrong_numbers(r.table(0));
  if (!wrong.empty()) throw failed_error(join(wrong, "; "));
  return "";
}

}  // namespace

std::vector<TabulateKind> page_kinds() {
  return {
      {"summary", "RUN [PHANTOM.json]",
       "results of a finished case as text, preceded by its "
       "warnings",
       1, 2, summary},
      {"report", "RUN RUNS",
       "one self-contained HTML page of a finished case; RUNS contains stability/ and compare/", 2,
       2, report},
      {"pdf", "CHROMIUM PAGE.html OUT.pdf", "that page as a PDF file, printed by CHROMIUM", 3, 3,
       pdf},
      {"warnings", "RUN", "warnings of the stages, each once, with advice", 1, 1, warnings},
      {"verify", "EXPECTED.tsv RUN",
       "comparison of a run with expected values; exit code 1 if "
       "one differs",
       2, 2, verified},
      {"expected", "EXPECTED.tsv RUN",
       "table of expected values, with the values of the run in "
       "rows that differ",
       2, 2, [](const Request& r) { return expected_anew(read_text(r.word(0)), r.word(1)); }},
      {"key", "REPORT.json PATH",
       "one value of a report, at a path of keys (seconds/total) or the first number of that name",
       2, 2, key},
      {"place", "REPORT.json LANDMARK [imaged|position]", "position x,y,z of a landmark in mm", 2,
       3, place},
      {"truth", "TRUTH.tsv",
       "mean, largest, nipple and tumour of a table of errors against the "
       "truth",
       1, 1, [](const Request& r) { return truth_summary(r.table(0)).text(); }},
      {"truth-rows", "RUN...", "errors of runs against their truth, one row per posture", 1,
       any_number,
       [](const Request& r) {
         std::vector<fs::path> runs;
         for (const std::string& word : r.words) runs.push_back(folder_of(word));
         return truth_of_postures(runs).text();
       }},
      {"pairs", "all|TOOL", "page of the files that must belong together, for all tools or for one",
       1, 1, [](const Request& r) { return pairs_page(r.word(0) == "all" ? "" : r.word(0)); }},
      {"made", "TABLE.tsv RESULT",
       "record in docs/tables/runs.tsv of the date, commit and machine of the run from which a table "
       "of the pages was made; RESULT is one of its reports or tables",
       2, 2, made},
      {"pages", "fill|check PAGE.md...",
       "tables between the marks of pages, written again (fill) or compared (check)", 2, any_number,
       pages},
      {"numbers", "NUMBERS.tsv", "whether the numbers in pages agree with their sources", 1, 1,
       numbers},
  };
}

}  // namespace breast
