// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dicom/mammogram_fields.hpp"

#include "core/table.hpp"
#include "core/text/lists.hpp"
#include "core/text/trimmed.hpp"

namespace breast {

MammogramFields::MammogramFields(const std::filesystem::path& file) : where_(file.string()) {
  if (!read_dicom_header(file, header_)) throw input_error(where_, ": not a DICOM file");
}

std::string MammogramFields::text(const char* key) const {
  return trimmed(text_of(header_, key));
}

std::vector<double> MammogramFields::numbers(const char* key, const char* name, double low,
                                             double high) {
  const std::string value = text(key);
  std::vector<double> all;
  if (value.empty()) return all;
  for (const std::string& part : split(value, '\\')) {
    try {
      all.push_back(parse_number(trimmed(part), where_ + ": " + name));
    } catch (const Error&) {
      remark(message(name, " is not a number; ignored"));
      return {};
    }
    if (!(all.back() >= low && all.back() <= high)) {
      remark(message(name, " ", all.back(), " is not within ", low, " to ", high, "; ignored"));
      return {};
    }
  }
  return all;
}

std::optional<double> MammogramFields::number(const char* key, const char* name, double low,
                                              double high) {
  const std::vector<double> all = numbers(key, name, low, high);
  return all.empty() ? std::nullopt : std::optional(all.front());
}

void MammogramFields::remark(const std::string& text) {
  remarks_.push_back(std::filesystem::path(where_).filename().string() + ": " + text);
}

Error MammogramFields::missing(const char* name, const std::string& value,
                               const char* expected) const {
  return input_error(where_, ": ", name, value.empty() ? " is missing" : " is \"" + value + "\"",
                     "; ", expected, " expected");
}

}  // namespace breast
