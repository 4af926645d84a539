// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases/settings_table.hpp"

#include <algorithm>
#include <cctype>

#include "cases/make_text.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "core/text/lists.hpp"
#include "core/text/place.hpp"
#include "core/text/words.hpp"
#include "study/cells.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

using Words = std::vector<std::string>;

std::string filled(const Table& table, std::size_t row, const std::string& column) {
  const std::string& cell = table.cell(row, column);
  return cell == no_value ? "" : cell;
}

bool is_plain_number(const std::string& word) {
  const auto digits =
      std::count_if(word.begin(), word.end(), [](unsigned char c) { return std::isdigit(c) != 0; });
  const auto points = std::count(word.begin(), word.end(), '.');
  return digits > 0 && points <= 1 && std::size_t(digits + points) == word.size();
}

bool matches(const std::string& word, const std::string& choice) {
  const std::size_t any = choice.find('%');
  return any == std::string::npos ? word == choice : word.starts_with(choice.substr(0, any));
}

// Refuses a word that is no number, or is outside the bounds that follow the kind of number.
void check_number(const Setting& setting, const std::string& word) {
  if (!is_plain_number(word))
    throw input_error(
        setting.name, ": '", word,
        "' is not a number; write digits and at most one decimal point, as 40 or 2.5");
  if (setting.choices.front() == "integer" && word.find('.') != std::string::npos)
    throw input_error(setting.name, ": '", word, "' is not a whole number");
  if (setting.choices.size() < 3) return;
  const std::string &least = setting.choices[1], &greatest = setting.choices[2];
  const double value = parse_number(word, setting.name);
  if (value < parse_number(least, setting.name) || value > parse_number(greatest, setting.name))
    throw input_error(setting.name, ": ", word, " must be from ", least, " to ", greatest);
}

// Refuses a word that is neither one of the choices, nor a file, nor a place.
void check_place(const Setting& setting, const std::string& word) {
  if (std::find(setting.choices.begin(), setting.choices.end(), word) != setting.choices.end())
    return;
  std::error_code none;
  if (fs::is_regular_file(word, none)) return;
  if (word.find(',') == std::string::npos)
    throw input_error(setting.name, ": '", word,
                      "' is neither a file, nor auto, nor none, nor x,y,z[:radius] in mm");
  parse_place(word, setting.name);
}

// What a word of the setting may be; "%" if it may be anything.
Words words_accepted(const Setting& setting, const std::string& word, const fs::path& pipelines) {
  const std::string& first = setting.choices.front();
  const std::string rows = "rows:";
  if (first.starts_with(rows)) {
    const Table study = read_table(pipelines / "studies" / (first.substr(rows.size()) + ".tsv"));
    Words names;
    for (std::size_t r = 0; r < study.rows.size(); ++r) names.push_back(study.cell(r, "variant"));
    return names;
  }
  if (first != "set") return setting.choices;
  if (fs::exists(word)) return {"%"};
  Words names;
  for (const auto& entry : fs::directory_iterator(pipelines / "materials"))
    if (entry.path().extension() == ".tsv") names.push_back(entry.path().stem());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::vector<Setting> read_settings(const fs::path& pipelines) {
  const Table table = read_table(pipelines / "settings.tsv");
  std::vector<Setting> settings;
  for (std::size_t r = 0; r < table.rows.size(); ++r)
    settings.push_back({table.cell(r, "setting"), table.cell(r, "kind"),
                        table.cell(r, "of") == "case", filled(table, r, "default"),
                        words_of(filled(table, r, "choices")), filled(table, r, "may_hold")});
  return settings;
}

void check_characters(const Setting& setting, const std::string& value) {
  const std::string advice = setting.is_words()
                                 ? "write the value without it"
                                 : "give a name without it, or a link that has such a name (ln -s)";
  if (std::any_of(value.begin(), value.end(),
                  [](unsigned char c) { return (c < ' ' && c != '\t') || c == 0x7f; }))
    throw input_error(setting.name, ": a control character may not stand in it; ", advice);
  std::string code = code_in(value);
  if (!setting.is_words() && code.empty()) {
    std::string refused = "=:%~";
    std::erase_if(refused, [&](char c) { return setting.may_hold.find(c) != std::string::npos; });
    code = value.substr(std::min(value.size(), value.find_first_of(refused)), 1);
  }
  if (!code.empty())
    throw input_error(setting.name, ": the character ", code,
                      " may not stand in it, because make or a shell would read it as code; ",
                      advice);
  if (setting.is_words()) return;
  if (words_of(value).size() > 1)
    throw input_error(setting.name, ": blanks may not stand in '", value,
                      "'; give a name without blanks, or a link that has such a name (ln -s)");
  // The coordinates of a tumour may be negative.
  if (value.starts_with('-') && setting.name != "TUMOUR")
    throw input_error(setting.name, ": '", value,
                      "' begins with a dash and would be read as an option; write ./", value);
}

void check_choice(const Setting& setting, const std::string& value, const fs::path& pipelines) {
  if (setting.choices.empty()) return;
  for (const std::string& word : words_of(value)) {
    const std::string& kind = setting.choices.front();
    if (kind == "number" || kind == "integer") {
      check_number(setting, word);
      continue;
    }
    if (setting.choices.back() == "place") {
      check_place(setting, word);
      continue;
    }
    const Words accepted = words_accepted(setting, word, pipelines);
    if (std::none_of(accepted.begin(), accepted.end(),
                     [&](const std::string& choice) { return matches(word, choice); }))
      throw input_error(setting.name, ": '", word,
                        kind == "set" ? "' is neither a file nor one of " : "' is none of ",
                        join(accepted, ", "), suggestion(word, accepted));
  }
}

fs::path material_set_file(const std::string& name, const fs::path& pipelines) {
  std::error_code none;
  return fs::exists(name, none) ? fs::path(name) : pipelines / "materials" / (name + ".tsv");
}

}  // namespace breast
