// SPDX-License-Identifier: GPL-3.0-or-later
// The settings of the pipeline (pipelines/settings.tsv) and the values that each of them accepts.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

/// A row of pipelines/settings.tsv.
struct Setting {
  std::string name;
  std::string kind;                  ///< path, name, text, words or program
  bool of_case = false;              ///< true if a case file may contain it
  std::string default_value;         ///< "" if there is none or if it depends on other settings
  std::vector<std::string> choices;  ///< empty if any text is accepted
  std::string may_hold;              ///< characters that names of this setting may contain

  /// True if its value may be several words.
  bool is_words() const { return kind == "text" || kind == "words" || kind == "program"; }
};

/// The settings of the pipeline in the folder `pipelines`, in the order of the table.
std::vector<Setting> read_settings(const std::filesystem::path& pipelines);

/// Throws Error (input), naming the setting and the character, if `value` contains a character that
/// make or a shell would interpret as code; for a setting of one word also if it contains a blank
/// or begins with a dash.
void check_characters(const Setting& setting, const std::string& value);

/// Throws Error (input), naming the setting, the value and what is accepted, if `value` is not
/// among the choices of the setting. A choice is a word, in which % stands for any text, or one of
/// these kinds. `number` or `integer`: optionally followed by the least and the greatest value.
/// `place`, after the words: a file, or x,y,z[:radius] in mm. `set`: a material set in `pipelines`
/// or a file. `rows:STUDY`: a row of that study. An empty value is accepted.
void check_choice(const Setting& setting, const std::string& value,
                  const std::filesystem::path& pipelines);

/// The file of the material set `name`: that file itself if it exists, otherwise the set of this
/// name in `pipelines`.
std::filesystem::path material_set_file(const std::string& name,
                                        const std::filesystem::path& pipelines);

}  // namespace breast
