// SPDX-License-Identifier: GPL-3.0-or-later
// The JSON report of a stage, as the tables and pages of a study read it: what is absent has no value, and is no error.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.hpp"

namespace breast {

/// A report that need not be there: a stage may have been swapped for a program that writes none.
class StageReport {
 public:
  StageReport();  ///< without a word
  /// The report in `file`; an empty one where there is no such file or nothing in it. Bytes that are no UTF-8 become U+FFFD.
  /// Throws Error (input) naming the file when it holds something else than a JSON object.
  static StageReport read(const std::filesystem::path& file);
  static StageReport parse(const std::string& json, const std::string& name);

  bool empty() const;
  /// The number at a path of keys, "seconds/total"; nothing when absent, null or no number.
  std::optional<double> number(std::string_view path) const;
  /// A text as it is, a number or truth value as it stands in the file; "" when absent, null, a list or an object.
  std::string text(std::string_view path) const;
  std::vector<std::string> texts(std::string_view path) const;  ///< the texts of a list
  /// The first number of that name at any depth, in the order of the file.
  std::optional<double> first(std::string_view name) const;
  /// mm LPS: `what` ("imaged", "position") of a landmark; "tumour" is also found where it is an artificial one.
  std::optional<Vec3> place(const std::string& landmark, const std::string& what) const;
  /// A landmark's key in this report, "" when it has none of that name.
  std::string landmark(const std::string& name) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

/// Where a variant of a study has its stages, STAGE.json and STAGE.vtkhdf: a folder of its own.
std::filesystem::path variant_of(const std::filesystem::path& run, const std::string& study,
                                 const std::string& variant);

/// Why the solve NAME.vtkhdf, NAME.json has no result: the sentence in its report, or its typed reason. Nothing when it has one, or
/// was never tried.
std::optional<std::string> failure_of(const std::filesystem::path& name);
/// The same of a variant's change of posture: its stages reference and supine.
std::optional<std::string> posture_failure_of(const std::filesystem::path& variant);

}  // namespace breast
