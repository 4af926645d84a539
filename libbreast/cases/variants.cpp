// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/variants.hpp"

#include <algorithm>
#include <sstream>
#include <utility>

#include "cases/make_text.hpp"
#include "command/make_name.hpp"
#include "core/error.hpp"
#include "core/text/lists.hpp"
#include "core/text/words.hpp"
#include "study/cells.hpp"

namespace breast {

namespace {

using Words = std::vector<std::string>;

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  if (from.empty()) return;
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
}

void check_among(const std::string& where, const Words& given, const Words& known) {
  for (const std::string& word : given)
    if (std::find(known.begin(), known.end(), word) == known.end())
      throw input_error(where, ": '", word, "' is none of ", join(known, ", "),
                        suggestion(word, known));
}

// The error names a row by its first cell, which tells the user more than the number of its line.
void check_cells(const std::string& lines, const std::string& file) {
  std::istringstream in(lines);
  std::size_t columns = 0;
  for (std::string line; std::getline(in, line);) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) continue;
    const Words cells = split(line, '\t');
    if (std::any_of(cells.begin(), cells.end(), has_control))
      throw input_error(file, ": ", cells.front(), " holds a control character");
    if (columns == 0) columns = cells.size();
    if (cells.size() != columns)
      throw input_error(file, ": ", cells.front(), " has ", cells.size(), " cells and not ",
                        columns, "; separate cells by one tab, and write - for an empty one");
  }
}

}  // namespace

namespace {

// The options of a command line, each "--name" with the words up to the next one; "--name=value" is
// one word.
std::vector<std::pair<std::string, std::string>> options_in(const std::string& text) {
  std::vector<std::pair<std::string, std::string>> options;
  for (const std::string& word : words_of(text)) {
    if (word.starts_with("--")) {
      options.emplace_back(word.substr(0, word.find('=')), word);
    } else if (!options.empty()) {
      options.back().second += " " + word;
    }
  }
  return options;
}

// The options of `text` whose names do not occur in `other`.
std::string options_without(const std::string& text, const std::string& other) {
  Words named, left;
  for (const auto& [name, option] : options_in(other)) named.push_back(name);
  for (const auto& [name, option] : options_in(text))
    if (std::find(named.begin(), named.end(), name) == named.end()) left.push_back(option);
  return join(left, " ");
}

}  // namespace

struct Studies::Row {
  const Table& table;
  std::size_t number;
  std::string study, from;

  // The text of a cell; "" if it is "-" or if the table has no such column.
  std::string cell(const std::string& column) const {
    if (!table.has(column)) return "";
    const std::string& text = table.cell(number, column);
    return text == no_value ? "" : text;
  }
  [[noreturn]] void fault(const std::string& what) const {
    throw input_error(table.name, ": ", cell("variant"), " ", what);
  }
};

Studies::Studies(StudyBase base) : base_(std::move(base)) {
  known_[base_.run] = base_.of_case;
}

std::string Studies::folder(const std::string& study, const std::string& variant) const {
  const bool whole = variant.find('/') != std::string::npos;
  return base_.run + "/studies/" + (whole ? "" : study + "/") + variant;
}

void Studies::add(const std::string& study, const std::string& text, const std::string& file,
                  const std::string& from) {
  std::string bare;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with('#')) bare += line + "\n";
  Words names;
  for (const auto& [name, value] : base_.placeholders) names.push_back(name);
  for (const std::string& name : names) replace_all(bare, "{" + name + "}", "");
  if (const std::string code = code_in(bare); !code.empty())
    throw input_error(
        file, ": the character ", code,
        " may not stand in a study, because make or a shell would read it as code; write the cell "
        "without it ({NAME} is one of ",
        join(names, ", "), ")");
  check_cells(bare, file);
  const Table table = parse_table(text, file);
  Words columns{"variant", "starts_at", "ends_at", "from", "given", "if"};
  columns.insert(columns.end(), base_.attributes.begin(), base_.attributes.end());
  check_among(file, table.columns, columns);
  text_ += make_assignment(study + "_variants", "");
  for (std::size_t r = 0; r < table.rows.size(); ++r) add_row({table, r, study, from});
}

std::string Studies::named(const std::string& cell) const {
  std::string text = cell;
  for (const auto& [name, value] : base_.placeholders) replace_all(text, "{" + name + "}", value);
  return text;
}

std::string Studies::option(const Row& row, const std::string& attribute,
                            const Attributes& from) const {
  const std::string cell = row.cell(attribute);
  const auto found = from.find(attribute);
  const std::string before = found == from.end() ? "" : found->second;
  if (cell.empty()) return before;
  if (!cell.starts_with('+')) return named(cell);
  return before + (before.empty() ? "" : " ") + named(cell.substr(1));
}

// What the cells of a row leave out, as "mechanics: --materials invivo; hexmesh: --muscle measured".
std::string Studies::drops(const Row& row, const Attributes& from) const {
  std::string text;
  for (const std::string& attribute : base_.attributes) {
    const std::string cell = row.cell(attribute);
    const auto before = from.find(attribute);
    if (cell.empty() || cell.starts_with('+') || before == from.end()) continue;
    const std::string left_out = options_without(before->second, named(cell));
    if (!left_out.empty()) text += (text.empty() ? "" : "; ") + attribute + ": " + left_out;
  }
  return text;
}

void Studies::add_row(const Row& row) {
  const std::string name = row.cell("variant"), from_cell = row.cell("from"),
                    start = row.cell("starts_at"), ends = row.cell("ends_at"),
                    given = row.cell("given"), only_if = row.cell("if");
  const std::string dir = folder(row.study, name);
  if (!plain_for_make(name) || name.find('/') != std::string::npos || known_.count(dir) != 0)
    row.fault(
        "is no name of a row of its own; give each row another name of letters, digits, points, dashes and underscores");
  if (start.empty())
    row.fault("does not say in the column starts_at at which stage it begins; write one of " +
              join(base_.stages, ", "));
  check_among(row.table.name, {start}, base_.stages);
  check_among(row.table.name, words_of(ends + " " + given), base_.stages);
  const std::string origin = !from_cell.empty()  ? folder(row.study, from_cell)
                             : !row.from.empty() ? folder(row.study, row.from)
                                                 : base_.run;
  const auto from = known_.find(origin);
  if (from == known_.end())
    row.fault("comes from '" + from_cell +
              "', and no row above has this name; write the row from which it comes above it");

  Attributes own;
  for (const std::string& attribute : base_.attributes)
    own[attribute] = option(row, attribute, from->second);
  replace_all(own["mechanics"], "--materials " + from->second["materials"],
              "--materials " + own["materials"]);
  const auto first = std::find(base_.stages.begin(), base_.stages.end(), start);
  text_ +=
      make_addition(row.study + "_variants", name) + make_addition("variant_dirs", dir) +
      make_assignment(dir + "@from", origin) + make_assignment(dir + "@given", given) +
      make_assignment(dir + "@stages", given + " " + join(Words(first, base_.stages.end()), " ")) +
      make_assignment(dir + "@ends_at", ends.empty() ? base_.ends_at : ends);
  if (!only_if.empty()) text_ += make_assignment(dir + "@if", folder(row.study, only_if));
  if (const std::string left_out = drops(row, from->second); !left_out.empty())
    text_ += make_assignment(dir + "@drops", left_out);
  for (const auto& [attribute, value] : own)
    if (!value.empty()) text_ += make_assignment(dir + "@" + attribute, value);
  known_[dir] = std::move(own);
}

}  // namespace breast
