// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/sha256.hpp"
#include "io/dicom/simulated_study.hpp"
#include "io/mammogram_dicom.hpp"
#include "projection/display.hpp"

namespace breast {

namespace {

constexpr const char* presentation_class = "1.2.840.10008.5.1.4.1.1.1.2";
constexpr const char* processing_class = "1.2.840.10008.5.1.4.1.1.1.2.1";

std::string content_of(const Mammogram& image, bool for_processing) {
  Sha256 hash;
  hash.update(view_name(image.view) + std::string(side_name(image.side)) + image.energy);
  hash.update(image.path.data(), image.path.size() * sizeof(float));
  hash.update(&image.pixel, sizeof image.pixel);
  hash.update(for_processing ? "processing" : "presentation");
  return hash.hex();
}

/// The letters of a patient direction, strongest axis first: "FR".
std::string letters(const Vec3& direction) {
  const char* names[3] = {"LR", "PA", "HF"};
  std::vector<std::pair<double, char>> parts;
  for (int k = 0; k < 3; ++k) {
    if (std::abs(direction[k]) < 0.1) continue;
    parts.push_back({std::abs(direction[k]), names[k][direction[k] > 0 ? 0 : 1]});
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first + 1e-9; });
  std::string text;
  for (const auto& part : parts) text += part.second;
  return text;
}

/// Detector signal, 0-16383, at the same places as the hung picture's greys.
std::vector<std::uint16_t> detector_signal(const Mammogram& image) {
  std::vector<std::uint16_t> stored(image.path.size());
  const bool left = image.side == Side::left;
  for (int row = 0; row < image.height; ++row) {
    const int v = left ? row : image.height - 1 - row;
    for (int column = 0; column < image.width; ++column) {
      const std::size_t from =
          std::size_t(v) * image.width + (left ? column : image.width - 1 - column);
      const double signal = image.blank(from) ? 0 : std::exp(-image.path[from]);
      stored[std::size_t(row) * image.width + column] =
          std::uint16_t(std::lround(16383 * std::clamp(signal, 0.0, 1.0)));
    }
  }
  return stored;
}

void add_identity(DatasetBuilder& set, const Mammogram& image, bool for_processing) {
  const std::string scan = content_of(image, for_processing);
  set.text(0x00080005, "CS", "ISO_IR 100")
      .text(0x00080008, "CS", for_processing ? "ORIGINAL\\PRIMARY" : "DERIVED\\PRIMARY")
      .text(0x00080016, "UI", for_processing ? processing_class : presentation_class)
      .text(0x00080018, "UI", uid_from(scan + "/image"))
      .text(0x00080068, "CS", for_processing ? "FOR PROCESSING" : "FOR PRESENTATION")
      .text(0x00081030, "LO", "Simulated mammogram");
  add_study(set, {"MG", "SIMULATED^MAMMOGRAM", scan});
}

DatasetBuilder view_code(View view) {
  switch (view) {
    case View::cc:
      return code_item("399162004", "SCT", "cranio-caudal");
    case View::mlo:
      return code_item("399368009", "SCT", "medio-lateral oblique");
    case View::ml:
      break;
  }
  return code_item("399260004", "SCT", "medio-lateral");
}

void add_positioning(DatasetBuilder& set, const Mammogram& image, const MammogramDicom& about) {
  const bool left = image.side == Side::left;
  const double way = left ? 1 : -1;  // of u and v along rows and columns
  DatasetBuilder item = view_code(image.view);
  item.sequence(0x00540222, {});  // no view modifier
  set.text(0x00200020, "CS", letters(way * image.pose.e_u) + "\\" + letters(way * image.pose.e_v))
      .text(0x00200062, "CS", left ? "L" : "R")
      .text(0x00181508, "CS", "MAMMOGRAPHIC")
      .number(0x00181510, image.pose.angle_deg)
      .text(0x00185101, "CS", view_name(image.view))
      .text(0x00400318, "CS", "BREAST")
      .text(0x00281300, "CS", "NO")
      .sequence(0x00540220, {item})
      .sequence(0x00082218, {code_item("76752008", "SCT", "Breast")})
      .sequence(0x00400555, {});
  if (about.thickness_mm) set.number(0x001811a0, *about.thickness_mm);
  if (about.force_N) set.number(0x001811a2, *about.force_N);
  if (image.pose.source_distance > 0) set.number(0x00181110, image.pose.source_distance);
}

void add_pixels(DatasetBuilder& set, const Mammogram& image, bool for_processing) {
  const int bits = for_processing ? 14 : 16;
  const int highest = (1 << bits) - 1;
  const std::vector<std::uint16_t> stored =
      for_processing ? detector_signal(image) : hang(image).grey;
  char spacing[40];
  std::snprintf(spacing, sizeof spacing, "%.8g\\%.8g", image.pixel, image.pixel);
  set.text(0x00181164, "DS", spacing)
      .text(0x00187004, "CS", "DIRECT")
      .grey_layout(image.width, image.height, bits, false,
                   for_processing ? "MONOCHROME1" : "MONOCHROME2")
      .text(0x00280301, "CS", "NO")
      .text(0x00281040, "CS", for_processing ? "LIN" : "LOG")
      .signed_short(0x00281041, for_processing ? 1 : -1)
      .number(0x00281052, 0)
      .number(0x00281053, 1)
      .text(0x00281054, "LO", "US")
      .text(0x00282110, "CS", "00")
      .text(0x20500020, "CS", for_processing ? "INVERSE" : "IDENTITY")
      .words(0x7fe00010,
             {reinterpret_cast<const char*>(stored.data()), stored.size() * sizeof stored[0]});
  if (!for_processing) {
    set.number(0x00281050, 0.5 * (highest + 1)).number(0x00281051, highest + 1);
  }
}

void add_acquisition(DatasetBuilder& set, const Mammogram& image) {
  const auto colon = image.energy.find(':');
  const std::string beam = image.energy.substr(0, colon);
  if (colon != std::string::npos && (beam == "W/Rh" || beam == "Mo/Mo")) {
    set.text(0x00180060, "DS", image.energy.substr(colon + 1))
        .text(0x00181191, "CS", beam == "W/Rh" ? "TUNGSTEN" : "MOLYBDENUM")
        .text(0x00187050, "CS", beam == "W/Rh" ? "RHODIUM" : "MOLYBDENUM");
  }
  set.text(0x00204000, "LT", "Simulated by libbreast; path is " + image.energy);
}

}  // namespace

void write_mammogram_dicom(const std::filesystem::path& file, const Mammogram& image,
                           const MammogramDicom& about) {
  if (about.for_processing && image.shows_fraction()) {
    throw input_error(
        "an image of tissue fractions has no detector signal: give --energy in keV or as a "
        "spectrum");
  }
  if (image.width > 65535 || image.height > 65535) {
    throw input_error(file.string(), ": ", image.width, " x ", image.height,
                      " pixels, but DICOM allows at most 65535 along a side; use larger pixels");
  }
  DatasetBuilder set;
  add_identity(set, image, about.for_processing);
  add_positioning(set, image, about);
  add_pixels(set, image, about.for_processing);
  add_acquisition(set, image);
  write_bytes(file, set.file());
}

}  // namespace breast
