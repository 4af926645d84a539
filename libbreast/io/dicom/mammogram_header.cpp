// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dicom/mammogram_header.hpp"

#include <cmath>
#include <initializer_list>
#include <sstream>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/text/trimmed.hpp"
#include "io/dicom/header.hpp"

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

/// Whether the view has one of these modifiers, given by their codes in SNOMED CT and SNOMED RT (PS3.16
/// CID 4015). Some programs write the modifiers beside the view instead of within it.
bool has_modifier(const Fields& fields, std::initializer_list<const char*> codes) {
  for (const char* place : {"0054|0220/0054|0222/0008|0100", "0054|0222/0008|0100"}) {
    std::istringstream stated(fields.text(place));
    for (std::string code; std::getline(stated, code, '\\');) {
      for (const char* known : codes) {
        if (trimmed(code) == known) return true;
      }
    }
  }
  return false;
}

void refuse_what_is_not_simulated(const Fields& fields) {
  if (has_modifier(fields, {"399055006", "R-102D7"})) {
    throw input_error(fields.where(),
                      ": a spot compression, which presses a part of the breast: the simulated "
                      "plates press all of it; give the whole view");
  }
  if (fields.text("0028|1300") == "YES" || has_modifier(fields, {"399209000", "R-102D5"})) {
    throw input_error(fields.where(),
                      ": shows a breast with an implant, which the model does not have");
  }
}

double magnification_of(const Fields& fields) {
  constexpr double least_of_a_stand = 1.2;  // on the detector's cover it is at most 1.1
  const auto stated = fields.number("0018|1114", "radiographic magnification", 0.5, 5);
  if (has_modifier(fields, {"399163009", "R-102D6"}) && stated.value_or(1) < least_of_a_stand) {
    throw input_error(
        fields.where(),
        ": a magnification view that does not state its factor (Estimated Radiographic "
        "Magnification Factor), so that its scale is unknown; give the contact view");
  }
  return stated.value_or(1);
}

/// The angle between the beam's line and the vertical.
double folded(double angle_deg) {
  const double from_above = std::abs(angle_deg);
  return from_above > 90 ? 180 - from_above : from_above;
}

}  // namespace

MammogramHeader read_mammogram_header(const std::filesystem::path& file) {
  const Fields fields(file);
  const std::string modality = fields.text("0008|0060");
  if (modality != "MG") throw fields.missing("modality", modality, "MG (mammogram)");
  MammogramHeader header;
  header.patient_id = fields.text("0010|0020");
  header.patient_id.erase(header.patient_id.find_last_not_of(' ') + 1);
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
  refuse_what_is_not_simulated(fields);
  header.magnification = magnification_of(fields);
  header.pixel_mm = *pixel / header.magnification;
  header.angle_deg = fields.number("0018|1510", "positioner primary angle", -180, 180);
  if (header.angle_deg) header.angle_deg = folded(*header.angle_deg);
  header.thickness_mm = fields.number("0018|11a0", "body part thickness", 1, 300);
  header.force_N = fields.number("0018|11a2", "compression force", 0, 1000);
  header.rows = int(fields.number("0028|0010", "rows", 1, 65535).value_or(0));
  header.columns = int(fields.number("0028|0011", "columns", 1, 65535).value_or(0));
  header.bright_is_low = fields.text("0028|0004") == "MONOCHROME1";
  const std::string orientation = fields.text("0020|0020");
  const auto bar = orientation.find('\\');
  if (bar != std::string::npos) {
    header.right = direction(orientation.substr(0, bar));
    header.down = direction(orientation.substr(bar + 1));
  }
  return header;
}

}  // namespace breast
