// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/ladder.hpp"

#include "cli/library_words.hpp"
#include "command/child.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text/lists.hpp"
#include "core/text/one_line.hpp"
#include "study/cells.hpp"

namespace breast {

namespace {

// Solves a point and returns its row of the table, or "" if the point has no solution.
std::string tried(const Ladder& ladder, const std::string& point, const std::string& coarser) {
  std::vector<std::string> solve = ladder.make;
  solve.push_back((ladder.run / "studies/cost" / point / "supine.json").string());
  // The user should see the output of make, but stdout is reserved for the table.
  if (run_child_to(solve, message_descriptor(), message_descriptor()) != 0)
    throw failed_error("accuracy: ", point, " could not be made");
  std::vector<std::string> judge = ladder.tabulate;
  judge.insert(judge.end(),
               {"accuracy", (ladder.run / "studies/cost").string(), point, ladder.wanted_mm});
  if (!coarser.empty()) judge.push_back(coarser);
  const Captured said = capture_child(judge);
  if (said.exit_code != 0) throw failed_error(one_line(said.err));
  return said.out;
}

}  // namespace

std::string climb(const Ladder& ladder) {
  std::string table =
      "point\telements\tstress_free_estimate_mm\tsupine_estimate_mm\tcpu_s\tmeets\n";
  std::string coarser, chosen, row;
  for (const std::string& point : ladder.points) {
    const std::string found = tried(ladder, point, coarser);
    if (found.empty()) continue;
    row = found;
    chosen = point;
    table += row;
    if (point.starts_with("q2p1-")) coarser = point;
    if (row.ends_with("yes\n")) break;
  }
  if (chosen.empty())
    throw not_converged_error("accuracy: no mesh of the ladder could be solved: see ",
                              (ladder.run / "studies/cost").string());
  write_text(ladder.run / "accuracy.tsv", table);
  const std::vector<std::string> parts = split(chosen, '-');
  write_text(ladder.run / "accuracy.mk",
             "ELEMENTS := " + parts.at(2) + "\nELEMENT := " + parts.at(0) + "\n");
  return table + (row.ends_with("yes\n")
                      ? ""
                      : "accuracy: " + ladder.wanted_mm +
                            " mm is not met by any mesh tried; the finest is taken\n");
}

}  // namespace breast
