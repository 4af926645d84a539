// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dicom/mammogram_header.hpp"

#include <cmath>

#include "core/error.hpp"
#include "io/dicom/mammogram_fields.hpp"
#include "io/dicom/mammogram_view.hpp"

namespace breast {

namespace {

// A machine presses with at most 200 N, by hand with at most 300 N (IEC 60601-2-45).
constexpr double most_force_N = 400;

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

/// Numbers of an element that gives the height and width of a pixel; nothing if it is absent or impossible.
std::optional<double> square_pixel(MammogramFields& fields, const char* key, const char* name) {
  const std::vector<double> size = fields.numbers(key, name, 0.005, 2);
  if (size.empty()) return std::nullopt;
  constexpr double same = 0.01;
  if (size.size() > 1 && std::abs(size[0] - size[1]) > same * size[0]) {
    throw input_error(fields.where(), ": ", name, " ", size[0], " x ", size[1],
                      " mm; square pixels expected");
  }
  return size[0];
}

/// The size of a pixel in the breast (PS3.3 10.7.1.3: Imager Pixel Spacing is measured at the detector, and
/// so is Pixel Spacing unless it has been calibrated).
double pixel_in_breast(MammogramFields& fields, double magnification) {
  if (const auto mm = square_pixel(fields, "0018|1164", "imager pixel spacing"))
    return *mm / magnification;
  if (const auto mm = square_pixel(fields, "0028|0030", "pixel spacing")) {
    const std::string calibration = fields.text("0028|0a02");
    const bool in_breast = calibration == "GEOMETRY" || calibration == "FIDUCIAL";
    fields.remark(message("imager pixel spacing is not stated; pixel spacing is taken as that ",
                          in_breast ? "in the breast" : "at the detector"));
    return in_breast ? *mm : *mm / magnification;
  }
  if (const auto mm = square_pixel(fields, "0018|2010", "nominal scanned pixel spacing")) {
    fields.remark("imager pixel spacing is not stated; that of the scanned film is taken");
    return *mm / magnification;
  }
  throw fields.missing("imager pixel spacing", "", "mm at the detector");
}

double magnification_of(MammogramFields& fields) {
  constexpr double least_of_a_stand = 1.2;  // on the detector's cover it is at most 1.1
  const auto stated = fields.number("0018|1114", "radiographic magnification", 0.5, 5);
  if (is_magnification_view(fields) && stated.value_or(1) < least_of_a_stand) {
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
  MammogramFields fields(file);
  const std::string modality = fields.text("0008|0060");
  if (modality != "MG") throw fields.missing("modality", modality, "MG (mammogram)");
  MammogramHeader header;
  header.patient_id = fields.text("0010|0020");
  header.view = stated_view(fields);
  header.side = stated_side(fields);
  refuse_what_is_not_simulated(fields);
  header.magnification = magnification_of(fields);
  header.pixel_mm = pixel_in_breast(fields, header.magnification);
  header.angle_deg = fields.number("0018|1510", "positioner primary angle", -180, 180);
  if (header.angle_deg) header.angle_deg = folded(*header.angle_deg);
  header.thickness_mm = fields.number("0018|11a0", "body part thickness", 1, 300);
  header.force_N = fields.number("0018|11a2", "compression force", 1, most_force_N);
  header.rows = int(fields.number("0028|0010", "rows", 1, 65535).value_or(0));
  header.columns = int(fields.number("0028|0011", "columns", 1, 65535).value_or(0));
  header.bright_is_low = fields.text("0028|0004") == "MONOCHROME1";
  header.flipped = fields.text("0018|7034") == "YES";
  const std::string orientation = fields.text("0020|0020");
  const auto bar = orientation.find('\\');
  if (bar != std::string::npos) {
    header.right = direction(orientation.substr(0, bar));
    header.down = direction(orientation.substr(bar + 1));
  }
  header.remarks = fields.remarks();
  return header;
}

}  // namespace breast
