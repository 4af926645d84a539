// SPDX-License-Identifier: GPL-3.0-or-later
// The elements of a DICOM file as text, without a DICOM library.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace breast {

/// Elements of a DICOM file as text; key "GGGG|EEEE" in lower-case hex, of those in a sequence after the
/// sequence's: "0054|0220/0008|0100", with the values of several items separated by backslashes.
/// Only elements of at most 256 bytes are kept, and of sequences those that describe a view or a frame.
using DicomHeader = std::map<std::string, std::string>;

/// Where the pixel data of a file lie (of a deflated one: in its inflated content).
struct DicomPixels {
  std::uint64_t position = 0, bytes = 0;
  bool encapsulated = false;  ///< bytes are then those of all fragments with their heads
  bool words = false;         ///< of 16 bits (OW), also where a pixel has 8 or 1
};

/// What a DICOM file states up to its pixel data. What follows them is not read.
struct DicomObject {
  DicomHeader header;
  std::vector<DicomHeader> frames;    ///< of the per-frame functional groups (enhanced objects)
  std::optional<DicomPixels> pixels;  ///< none: a presentation state, a report
  std::string syntax;                 ///< UID of the transfer syntax
  bool big_endian = false, deflated = false;
  std::uint64_t set = 0;  ///< where the data set begins, after the meta information
};

/// Reads the elements of a DICOM file in any transfer syntax, with or without the preamble of PS3.10.
/// Returns false if the file is not DICOM at all; throws Error (input) if it is, but is damaged or
/// truncated. `object` then holds what was read before the damage.
bool read_dicom_object(const std::filesystem::path& file, DicomObject& object);

/// The same for the header of an image: throws Error (input) also for an object without pixels.
bool read_dicom_header(const std::filesystem::path& file, DicomHeader& header);

/// The bytes of the pixel data as the file holds them; those of pixels of at most 8 bits in the order of the pixels,
/// also where big-endian words hold them.
std::string pixel_bytes(const std::filesystem::path& file, const DicomObject& object);

/// The value of an element, or "" if the header lacks it.
std::string text_of(const DicomHeader& header, const std::string& key);

}  // namespace breast
