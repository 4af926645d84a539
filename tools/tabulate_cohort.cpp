// SPDX-License-Identifier: GPL-3.0-or-later
// The tables and pages of a cohort.
#include <cstdlib>

#include "command/child.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text/lists.hpp"
#include "core/text/one_line.hpp"
#include "study/cells.hpp"
#include "study/cohort/cohort_page.hpp"
#include "study/cohort/cohort_table.hpp"
#include "study/cohort/side_table.hpp"
#include "tabulate_kinds.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

using Request = TabulateRequest;

bool in_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  for (const std::string& folder : split(path == nullptr ? "" : path, ':'))
    if (fs::exists(fs::path(folder) / program)) return true;
  return false;
}

// The output of a pipe of netpbm programs; "" if one of them fails because another program made the
// picture.
std::string piped(const std::string& pipe, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{"bash", "-o", "pipefail", "-c", pipe, "netpbm"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const Captured made = capture_child(words);
  return made.exit_code == 0 ? made.out : "";
}

Thumbnails thumbnails() {
  // Selects three axial and two sagittal slices out of the sixteen that segment draws, four per row
  // of 500 x 360 pixels with the breast in the middle; pixel by pixel, because a contour is one
  // pixel wide.
  const std::string slices =
      "cut() { pngtopnm \"$1\" | pamcut -left $((500 * $3 + 80)) -top $((360 * $2 + 40)) -width 340 -height 280; }; "
      "pnmcat -lr <(cut \"$1\" 0 1) <(cut \"$1\" 0 3) <(cut \"$1\" 1 1) <(cut \"$1\" 2 1) <(cut \"$1\" 2 2) | pnmtojpeg -quality 70 -sample=1x1";
  const bool possible = in_path("pnmtojpeg");
  const auto made = [possible](const fs::path& png, const std::string& pipe,
                               const std::string& width) {
    return possible && fs::is_regular_file(png) && fs::file_size(png) > 0
               ? piped(pipe, {png.string(), width})
               : "";
  };
  return {possible,
          [made](const fs::path& png, int width) {
            return made(png, "pngtopnm \"$1\" | pamscale -xsize \"$2\" | pnmtojpeg -quality 70",
                        std::to_string(width));
          },
          [made, slices](const fs::path& png) { return made(png, slices, ""); }};
}

// Tabulates the motion of a case's tissue if its mesh has a chest wall to measure from; repeated if
// the supine shape is newer.
void measure_motion(const fs::path& run, const std::string& population) {
  const fs::path supine = run / "supine.vtkhdf", motion = run / "motion.tsv";
  const bool solved = fs::exists(supine);
  if (solved && fs::exists(motion) && fs::last_write_time(motion) > fs::last_write_time(supine))
    return;
  if (!solved || capture_child({population, supine, "--table", motion, "--quiet"}).exit_code != 0)
    fs::remove(motion);
}

std::string cohort(const Request& r) {
  fs::path runs = r.word(0);
  if (!runs.has_filename()) runs = runs.parent_path();
  const std::vector<CohortCase> cases = read_cases(runs);
  std::vector<std::string> shapes{r.word(1)};
  for (const CohortCase& one : cases) {
    if (!fs::is_directory(runs / one.name)) continue;
    measure_motion(runs / one.name, r.word(1));
    if (fs::exists(runs / one.name / "motion.tsv"))
      shapes.push_back(runs / one.name / "supine.vtkhdf");
  }
  const fs::path women_file = r.own("invivo/women.tsv"), motion = runs / "motion.tsv",
                 women = runs / "women.tsv";
  const Table known = read_table(women_file);
  const Table table = cohort_table(runs, cases, read_advice(r.own("advice.tsv")), known),
              cost = cohort_cost(runs, cases);
  write_text(runs / "cohort.tsv", table.text());
  write_text(runs / "cost.tsv", cost.text());
  fs::remove(motion);
  fs::remove(women);
  if (shapes.size() > 1) {
    shapes.insert(shapes.end(),
                  {"--women", women_file, "--table", motion, "--summary", women, "--quiet"});
    const Captured made = capture_child(shapes);
    if (made.exit_code != 0) throw failed_error(shapes.front(), ": ", one_line(made.err));
  }
  const CohortPages pages{runs, table, cost, table_if_any(motion), known, thumbnails()};
  write_text(runs / "cohort.html", cohort_page(pages));
  write_text(runs / "contours.html", contours_page(pages));
  return table.text();
}

std::string cost_of_case(const Request& r) {
  const auto measured = table_if_any(fs::path(r.word(0)) / "cost.tsv");
  const CaseCost cost =
      case_cost(measured ? &*measured : nullptr, read_table(r.own("cohort-cost.tsv")),
                int(parse_number(r.word(1), "case-cost: CORES")), r.word(2),
                parse_number(r.word(3), "case-cost: ELEMENTS"));
  return message(cost.minutes, "\t", cost.memory_mb, "\t", cost.source, "\n");
}

std::string sides(const Request& r) {
  const fs::path runs = r.word(0);
  const Table table = side_table(runs, read_cases(runs));
  write_text(runs / "sides.tsv", table.text());
  return table.text();
}

}  // namespace

std::vector<TabulateKind> cohort_kinds() {
  return {
      {"cohort", "RUNS POPULATION",
       "table of all cases in RUNS/.cases, which is also printed; beside it cost.tsv, motion.tsv "
       "and women.tsv (made by the program POPULATION), cohort.html and contours.html are written",
       2, 2, cohort},
      {"sides", "RUNS",
       "table of all cases in RUNS/.cases, written to RUNS/sides.tsv and printed: how far each side gets "
       "from the scan to the supine shape, and how well",
       1, 1, sides},
      {"case-cost", "RUNS CORES ELEMENT ELEMENTS",
       "minutes and MB to request from a cluster, and their source: RUNS/cost.tsv or the "
       "pipeline's own table",
       4, 4, cost_of_case},
  };
}

}  // namespace breast
