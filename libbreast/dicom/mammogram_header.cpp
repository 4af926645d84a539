// SPDX-License-Identifier: GPL-3.0-or-later
#include "dicom/mammogram_header.hpp"

#include <cmath>

#include "core/error.hpp"
#include "core/table.hpp"
#include "dicom/header.hpp"

namespace breast {

namespace {

class Fields {
 public:
  explicit Fields(const std::filesystem::path& file) : where_(file.string()) {
    if (!read_dicom_header(file, header_)) throw input_error(where_, ": not a DICOM file");
  }

  std::string text(const char* key) const {
    const auto found = header_.find(key);
    if (found == header_.end()) return "";
    std::string value = found->second;
    value.erase(0, value.find_first_not_of(' '));
    return value;
  }
  /// First value of a number element; nothing when empty or absent.
  std::optional<double> number(const char* key, const char* name, double low, double high) const {
    const std::string value = text(key);
    if (value.empty()) return std::nullopt;
    std::string first = value.substr(0, value.find('\\'));
    first.erase(first.find_last_not_of(' ') + 1);
    const double x = parse_number(first, where_ + ": " + name);
    if (!(x >= low && x <= high)) {
      throw input_error(where_, ": ", name, " ", x, ", ", low, " to ", high, " expected");
    }
    return x;
  }
  Error missing(const char* name, const std::string& value, const char* expected) const {
    return input_error(where_, ": ", name, value.empty() ? " is missing" : " is \"" + value + "\"",
                       "; ", expected, " expected");
  }
  const std::string& where() const { return where_; }

 private:
  std::string where_;
  DicomHeader header_;
};

Vec3 direction(const std::string& letters) {
  Vec3 sum = Vec3::Zero();
  for (const char letter : letters) {
    if (letter == 'L') sum += Vec3(1, 0, 0);
    if (letter == 'R') sum += Vec3(-1, 0, 0);
    if (letter == 'P') sum += Vec3(0, 1, 0);
    if (letter == 'A') sum += Vec3(0, -1, 0);
    if (letter == 'H') sum += Vec3(0, 0, 1);
    if (letter == 'F') sum += Vec3(0, 0, -1);
  }
  return sum;
}

}  // namespace

MammogramHeader read_mammogram_header(const std::filesystem::path& file) {
  const Fields fields(file);
  const std::string modality = fields.text("0008|0060");
  if (modality != "MG") throw fields.missing("modality", modality, "MG (mammogram)");
  MammogramHeader header;
  const std::string position = fields.text("0018|5101");
  const std::optional<View> view = view_from_name(position);
  if (!view) throw fields.missing("view position", position, "CC, MLO or ML");
  header.view = *view;
  std::string side = fields.text("0020|0062");
  if (side.empty()) side = fields.text("0020|0060");
  if (side != "L" && side != "R") throw fields.missing("image laterality", side, "L or R");
  header.side = side == "L" ? Side::left : Side::right;
  const auto pixel = fields.number("0018|1164", "imager pixel spacing", 0.005, 2);
  if (!pixel) throw fields.missing("imager pixel spacing", "", "mm at the detector");
  header.pixel_mm = *pixel;
  header.angle_deg = fields.number("0018|1510", "positioner primary angle", -180, 180);
  if (header.angle_deg) *header.angle_deg = std::abs(*header.angle_deg);
  header.thickness_mm = fields.number("0018|11a0", "body part thickness", 1, 300);
  header.force_N = fields.number("0018|11a2", "compression force", 0, 1000);
  header.magnification =
      fields.number("0018|1114", "radiographic magnification", 0.5, 5).value_or(1);
  header.rows = int(fields.number("0028|0010", "rows", 1, 65535).value_or(0));
  header.columns = int(fields.number("0028|0011", "columns", 1, 65535).value_or(0));
  const std::string orientation = fields.text("0020|0020");
  const auto bar = orientation.find('\\');
  if (bar != std::string::npos) {
    header.right = direction(orientation.substr(0, bar));
    header.down = direction(orientation.substr(bar + 1));
  }
  return header;
}

}  // namespace breast
