// SPDX-License-Identifier: GPL-3.0-or-later
// The JSON report of a stage, as read by the tables and pages of a study. An absent entry has no
// value and is not an error.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.hpp"

namespace breast {

/// A report that may be absent, because a stage may have been replaced by a program that does not
/// write one.
class StageReport {
 public:
  StageReport();  ///< an empty report
  /// The report in `file`; an empty one if the file is absent or empty. Bytes that are not valid
  /// UTF-8 become U+FFFD. Throws Error (input) naming the file if it contains anything other than a
  /// JSON object.
  static StageReport read(const std::filesystem::path& file);
  static StageReport parse(const std::string& json, const std::string& name);

  bool empty() const;
  /// The number at a path of keys such as "seconds/total"; no value if it is absent, null or not a
  /// number.
  std::optional<double> number(std::string_view path) const;
  /// A text, or a number or truth value as written in the file; "" if it is absent, null, a list or
  /// an object.
  std::string text(std::string_view path) const;
  std::vector<std::string> texts(std::string_view path) const;  ///< the texts in a list
  /// The first number with that name at any depth, in the order of the file.
  std::optional<double> first(std::string_view name) const;
  /// The position in mm LPS of a landmark; `what` is "imaged" or "position". "tumour" also finds an
  /// artificial one.
  std::optional<Vec3> place(const std::string& landmark, const std::string& what) const;
  /// The key of a landmark in this report; "" if there is none of that name.
  std::string landmark(const std::string& name) const;

 private:
  struct Impl;
  std::shared_ptr<const Impl> impl_;
};

/// True for a regular file that is not empty: a result that was written.
bool has_something(const std::filesystem::path& file);

/// The folder RUN/studies/STUDY/VARIANT, which contains STAGE.json and STAGE.vtkhdf for every stage
/// of a variant.
std::filesystem::path variant_of(const std::filesystem::path& run, const std::string& study,
                                 const std::string& variant);

/// The reason why the solve NAME.vtkhdf, NAME.json has no result: the sentence in its report or,
/// without a sentence, its typed reason. No value if it has a result or was never tried.
std::optional<std::string> failure_of(const std::filesystem::path& name);
/// The same for the change of posture of a variant, which fails if its stage reference or its stage
/// supine does.
std::optional<std::string> posture_failure_of(const std::filesystem::path& variant);

}  // namespace breast
