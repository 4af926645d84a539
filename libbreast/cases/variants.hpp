// SPDX-License-Identifier: GPL-3.0-or-later
// Studies as data: the rows of a table are variants of a case, which are converted to variables of
// make.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// The case from which the rows of a study start. Its attributes are the variables DIR@hexmesh,
/// DIR@mechanics, ... of pipelines/stages.mk.
struct StudyBase {
  std::string run;                  ///< folder of the case; variants are RUN/studies/STUDY/VARIANT
  std::vector<std::string> stages;  ///< all stages of the chain, in order
  std::string ends_at;              ///< stages at which a row without `ends_at` ends
  std::vector<std::string> attributes;         ///< names of the columns with options
  std::map<std::string, std::string> of_case;  ///< attributes of the case
  /// The text that replaces {NAME} in a cell. The placeholder {tumour} remains in the text, and the
  /// stage replaces it.
  std::map<std::string, std::string> placeholders;
};

/// Converts the rows of studies to lines of make. The order in which studies are added matters,
/// since a row may start from a row of an earlier study.
class Studies {
 public:
  explicit Studies(StudyBase base);
  /// Adds the rows of the table `text` as variants of `from`: STUDY/VARIANT, or the case if empty.
  /// Throws Error (input), naming `file` and where possible the row, for an unknown column or
  /// stage, for a name that is not valid or occurs twice, for a character that make or a shell
  /// would interpret as code, and for a row whose `from` is not a row above it.
  void add(const std::string& study, const std::string& text, const std::string& file,
           const std::string& from = "");
  /// The lines of all rows added: STUDY_variants and variant_dirs, and for the folder DIR of every
  /// variant DIR@from, DIR@given, DIR@stages, DIR@ends_at, DIR@if, DIR@ATTRIBUTE and DIR@drops, which
  /// names the options of `from` that a cell without a leading + leaves out.
  const std::string& text() const { return text_; }

 private:
  using Attributes = std::map<std::string, std::string>;
  struct Row;

  std::string folder(const std::string& study, const std::string& variant) const;
  void add_row(const Row& row);
  std::string option(const Row& row, const std::string& attribute, const Attributes& from) const;
  std::string named(const std::string& cell) const;
  std::string drops(const Row& row, const Attributes& from) const;

  StudyBase base_;
  std::map<std::string, Attributes> known_;  ///< attributes of the case and all variants, by folder
  std::string text_;
};

}  // namespace breast
