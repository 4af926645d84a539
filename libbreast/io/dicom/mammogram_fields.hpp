// SPDX-License-Identifier: GPL-3.0-or-later
// The elements of a mammogram's header, as text and as numbers that can be right.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "io/dicom/header.hpp"

namespace breast {

class MammogramFields {
 public:
  /// Throws Error (input) as read_dicom_header, and if the file is not DICOM.
  explicit MammogramFields(const std::filesystem::path& file);

  /// The value of an element without blanks around it; "" if the header lacks it.
  std::string text(const char* key) const;
  /// The numbers of an element, as many as it holds. A value that is no number, or not within these
  /// bounds, is ignored with a remark, as are those beside it.
  std::vector<double> numbers(const char* key, const char* name, double low, double high);
  /// The first of them.
  std::optional<double> number(const char* key, const char* name, double low, double high);
  /// A sentence that a report keeps: it names the file, but not its folder.
  void remark(const std::string& text);

  Error missing(const char* name, const std::string& value, const char* expected) const;
  const std::string& where() const { return where_; }
  const std::vector<std::string>& remarks() const { return remarks_; }

 private:
  std::string where_;
  DicomHeader header_;
  std::vector<std::string> remarks_;
};

}  // namespace breast
