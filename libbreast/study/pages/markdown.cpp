// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/pages/markdown.hpp"

#include <algorithm>
#include <filesystem>
#include <regex>
#include <sstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/text/lists.hpp"
#include "study/cells.hpp"

namespace breast {

namespace fs = std::filesystem;

std::string markdown_table(const std::string& tsv, const std::string& name) {
  std::istringstream in(tsv);
  std::string text;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) continue;
    if (line.empty() || line == "\r") continue;
    const Row cells = split(line, '\t');
    const bool header = text.empty();
    text += "|";
    for (const std::string& cell : cells) text += " " + cell_or_dash(cell) + " |";
    text += "\n";
    if (!header) continue;
    text += "|";
    for (std::size_t c = 0; c < cells.size(); ++c) text += "---|";
    text += "\n";
  }
  if (text.empty()) throw input_error(name, ": contains no table");
  return text;
}

std::string with_tables(const std::string& page, const std::string& name,
                        const std::function<std::string(const std::string& file)>& read,
                        const std::function<std::string(const std::string& file)>& run_of) {
  const std::string begin = "<!-- table ", close = " -->", end = "<!-- end of table -->";
  std::istringstream in(page);
  std::string text, inside;
  for (std::string line; std::getline(in, line);) {
    if (line == end) inside.clear();
    if (!inside.empty()) continue;
    text += line + "\n";
    if (!line.starts_with(begin) || !line.ends_with(close)) continue;
    inside = line.substr(begin.size(), line.size() - begin.size() - close.size());
    if (inside.empty() || inside.find(' ') != std::string::npos) {
      inside.clear();
      continue;
    }
    text += "\n" + markdown_table(read(inside), inside) + "\n" + run_of(inside) + "\n\n";
  }
  if (!inside.empty())
    throw input_error(name, ": the table ", inside, " has no end; close it with ", end);
  return text;
}

std::string run_line(const Table& runs, const std::string& file) {
  const std::string table = fs::path(file).filename(), date = cell_at(runs, table, "date");
  if (date.empty() || date == no_value) return "Run: not recorded.";
  if (date == "none") return "Not from a run.";
  return "Run: " + date + ", commit " + cell_at(runs, table, "commit") + ", " +
         cell_at(runs, table, "machine") + ".";
}

Table with_run(const Table& runs, const std::string& file, const std::string& date,
               const std::string& commit, const std::string& machine) {
  Table table = runs;
  const Row row{fs::path(file).filename(), date, commit, machine};
  const auto known = std::find_if(table.rows.begin(), table.rows.end(),
                                  [&](const Row& other) { return other.front() == row.front(); });
  if (known != table.rows.end())
    *known = row;
  else
    table.rows.push_back(row);
  std::sort(table.rows.begin(), table.rows.end());
  return table;
}

Table truth_summary(const Table& truth) {
  Table table{{"landmark", "imaged_error_mm", "stress_free_error_mm", "stress_free_moved_mm",
               "supine_error_mm", "supine_moved_mm"},
              {}};
  for (std::size_t r = 0; r < truth.rows.size(); ++r) {
    const std::string& landmark = truth.rows[r].front();
    if (landmark != "mean" && landmark != "largest" && landmark != "nipple" &&
        landmark != "true-tumour")
      continue;
    Row row{landmark};
    for (const std::string column : {"prone_error_mm", "stress_free_error_mm",
                                     "stress_free_true_mm", "supine_error_mm", "supine_true_mm"})
      row.push_back(truth.has(column) ? fixed_cell(number_of(truth.cell(r, column)), 2) : no_value);
    table.rows.push_back(row);
  }
  return table;
}

namespace {

Row posture_row(const Table& truth, const std::string& run, const std::string& posture) {
  const auto value = [&](const char* row, const char* quantity) {
    return number_at(truth, row, posture + quantity);
  };
  const auto moved = value("mean", "_true_mm"), error = value("mean", "_error_mm");
  const bool both = moved && error && *moved > 0;
  return {run,
          posture,
          fixed_cell(moved, 1),
          fixed_cell(error, 1),
          fixed_cell(value("largest", "_error_mm"), 1),
          both ? format_fixed(100 * *error / *moved, 0) : no_value,
          fixed_cell(value("mean", "_own_error_mm"), 2),
          fixed_cell(value("largest", "_own_error_mm"), 2)};
}

}  // namespace

Table truth_of_postures(const std::vector<fs::path>& runs) {
  Table table{{"case", "shape", "moved_mm", "error_mm", "largest_mm", "error_percent",
               "own_error_mm", "largest_own_mm"},
              {}};
  for (const fs::path& run : runs) {
    const fs::path compressed = run / "truth-compressed.tsv";
    const Table truth = read_table(fs::exists(compressed) ? compressed : run / "truth.tsv");
    for (const std::string posture : {"stress_free", "supine", "cc", "mlo"})
      if (truth.has(posture + "_error_mm"))
        table.rows.push_back(posture_row(truth, run.filename(), posture));
  }
  return table;
}

namespace {

std::vector<fs::path> files_of(const fs::path& source) {
  if (!fs::is_directory(source)) return {source};
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(source))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

// The first match of the pattern's group; "" without a match.
std::string stated(const fs::path& source, const std::string& pattern) {
  const std::regex wanted(pattern, std::regex::extended);
  for (const fs::path& file : files_of(source)) {
    if (!fs::is_regular_file(file)) continue;
    std::istringstream in(read_text(file));
    std::smatch found;
    for (std::string line; std::getline(in, line);)
      if (std::regex_search(line, found, wanted) && found.size() > 1) return found[1].str();
  }
  return "";
}

}  // namespace

std::vector<std::string> wrong_numbers(const Table& numbers) {
  std::vector<std::string> wrong;
  for (std::size_t r = 0; r < numbers.rows.size(); ++r) {
    const auto cell = [&](const char* column) { return numbers.cell(r, column); };
    const std::string said = stated(cell("page"), cell("page_pattern")),
                      decided = stated(cell("source"), cell("source_pattern"));
    if (!said.empty() && said == decided) continue;
    wrong.push_back(message(cell("page"), " says '", said.empty() ? "nothing" : said, "' for ",
                            cell("page_pattern"), "; ", cell("source"), " has '",
                            decided.empty() ? "nothing" : decided, "' for ",
                            cell("source_pattern")));
  }
  return wrong;
}

}  // namespace breast
