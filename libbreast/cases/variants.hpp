// SPDX-License-Identifier: GPL-3.0-or-later
// A study as data: a table whose rows are variants of a case, and the variables of make that they become.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/table.hpp"

namespace breast {

/// What the rows of a study start from. pipelines/stages.mk has the attributes: DIR@stages, DIR@hexmesh, DIR@mechanics, ...
struct StudyBase {
  std::string run;                  ///< the case's folder; variants are RUN/studies/STUDY/VARIANT
  std::vector<std::string> stages;  ///< of the chain, in order
  std::string ends_at;              ///< what a row without `ends_at` asks for
  std::vector<std::string> attributes;         ///< columns that hold options
  std::map<std::string, std::string> of_case;  ///< the case's own
  std::map<std::string, std::string>
      placeholders;  ///< {NAME} in a cell; {tumour} stays for the stage to fill in
};

/// The rows of studies as lines of make, in the order in which they are added: a row may come from one of an earlier study.
class Studies {
 public:
  explicit Studies(StudyBase base);
  /// The rows of the table as variants of `from`, the case or STUDY/VARIANT. Throws Error (input) naming the table's file and the
  /// row for a column, stage or name that is none, for a character that make or a shell would read as code, and where a row comes
  /// from none above.
  void add(const std::string& study, const std::string& text, const std::string& file,
           const std::string& from = "");
  /// STUDY_variants and variant_dirs; DIR@from, DIR@given, DIR@stages, DIR@ends_at, DIR@if and DIR@ATTRIBUTE.
  const std::string& text() const { return text_; }

 private:
  using Attributes = std::map<std::string, std::string>;
  struct Row;

  std::string folder(const std::string& study, const std::string& variant) const;
  void add_row(const Row& row);
  std::string option(const Row& row, const std::string& attribute, const Attributes& from) const;
  std::string named(const std::string& cell) const;

  StudyBase base_;
  std::map<std::string, Attributes> known_;  ///< by folder
  std::string text_;
};

}  // namespace breast
