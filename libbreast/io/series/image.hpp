// SPDX-License-Identifier: GPL-3.0-or-later
// One image of a DICOM file, as a slice of a volume: a file of its own, or a frame of an enhanced object.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "io/dicom/header.hpp"
#include "io/series/contrast.hpp"

namespace breast {

/// In what images at one place may differ. Values of the same rank in two images are compared as texts.
enum class Mark {
  time,
  acquisition,
  trigger,
  acquired_at,
  stored_at,
  kind,
  echo,
  weighting,
  component,  ///< of the complex signal: magnitude, phase, real, imaginary
  count
};

struct DicomImage {
  std::filesystem::path file;
  int frame = 0;  ///< of the file, from 0
  std::string study_uid, series_uid, frame_of_reference_uid, sop_class, instance_uid;
  int series_number = 0, instance_number = 0;
  int columns = 0, rows = 0;
  std::string patient_id, patient_name;
  std::string patient_position;  ///< "HFP", head first and prone; "" if not stated
  std::string laterality;        ///< "L", "R" or ""
  bool localiser = false;        ///< by its image type
  bool encapsulated = false;     ///< its pixels are compressed
  bool foreign = false;          ///< of another modality than MR, or a picture without a place
  bool derived = false;          ///< made from other images, such as a reformatted series
  Vec3 position{0, 0, 0};        ///< mm, centre of the first pixel, LPS
  Vec3 row{0, 0, 0}, column{0, 0, 0};
  Vec2 pixel{0, 0};  ///< mm between rows, between columns
  double slope = 1, intercept = 0;
  std::array<std::string, std::size_t(Mark::count)> marks;
  ScanContrast contrast = ScanContrast::unknown;
  /// Why it is no slice of an MR volume, as one line that begins with the file; "" if it is.
  std::string fault;

  const std::string& mark(Mark which) const { return marks[std::size_t(which)]; }
};

/// The images of an object with pixels. What is wrong with one is its fault; throws nothing.
std::vector<DicomImage> images_of(const std::filesystem::path& file, const DicomObject& object);

/// Only size and place of a frame, whatever it shows. Throws Error (input) beginning with the file's name
/// where they are missing or impossible.
DicomImage placed_frame(const std::filesystem::path& file, const DicomObject& object, int frame);

}  // namespace breast
