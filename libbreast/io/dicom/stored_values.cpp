// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dicom/stored_values.hpp"

#include <gdcmPixmapReader.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <numeric>
#include <sstream>

#include "core/error.hpp"
#include "core/guarded_child.hpp"
#include "io/dicom/dataset.hpp"

namespace breast {

namespace {

namespace fs = std::filesystem;

/// How the values lie in the pixel data.
struct Layout {
  int columns = 0, rows = 0, frames = 1;
  int bits = 16, stored = 16, high = 15;
  bool negative = false;  ///< values have a sign

  std::size_t pixels() const { return std::size_t(columns) * std::size_t(rows); }  ///< of a frame
};

int number_of(const DicomHeader& header, const char* key, int otherwise) {
  const std::string text = text_of(header, key);
  return text.empty() ? otherwise : std::atoi(text.c_str());
}

Layout layout_of(const DicomHeader& header) {
  Layout layout;
  layout.columns = number_of(header, "0028|0011", 0);
  layout.rows = number_of(header, "0028|0010", 0);
  layout.frames = number_of(header, "0028|0008", 1);
  layout.bits = number_of(header, "0028|0100", 16);
  layout.stored = number_of(header, "0028|0101", layout.bits);
  layout.high = number_of(header, "0028|0102", layout.stored - 1);
  layout.negative = number_of(header, "0028|0103", 0) == 1;
  return layout;
}

/// Appends the values of a frame: of the allocated bits those that are stored; others may hold overlays.
template <class Word>
void append(const char* bytes, const Layout& layout, bool big_endian, std::vector<float>& values) {
  const int below = std::clamp(layout.high - layout.stored + 1, 0, layout.bits - layout.stored);
  const std::uint32_t mask = (1u << layout.stored) - 1, sign = 1u << (layout.stored - 1);
  for (std::size_t i = 0; i < layout.pixels(); ++i) {
    Word word;
    std::memcpy(&word, bytes + i * sizeof(Word), sizeof(Word));
    if (big_endian && sizeof(Word) == 2) word = Word(word >> 8 | word << 8);
    const std::uint32_t stored = std::uint32_t(word) >> below & mask;
    const bool is_negative = layout.negative && (stored & sign) != 0;
    values.push_back(is_negative ? float(std::int32_t(stored) - std::int32_t(mask) - 1)
                                 : float(stored));
  }
}

std::vector<float> unpacked(const std::string& bytes, const Layout& layout, bool big_endian,
                            std::vector<int> frames, const fs::path& file) {
  const std::size_t frame_bytes = layout.pixels() * std::size_t(layout.bits / 8);
  if (frames.empty()) {
    frames.resize(std::size_t(layout.frames));
    std::iota(frames.begin(), frames.end(), 0);
  }
  std::vector<float> values;
  values.reserve(layout.pixels() * frames.size());
  for (const int frame : frames) {
    const std::size_t start = std::size_t(frame) * frame_bytes;
    if (start + frame_bytes > bytes.size()) {
      throw input_error(file.string(), ": ", bytes.size(), " bytes of pixels for ", layout.columns,
                        " x ", layout.rows, " pixels and ", layout.frames, " frames");
    }
    if (layout.bits == 8) {
      append<std::uint8_t>(bytes.data() + start, layout, big_endian, values);
    } else {
      append<std::uint16_t>(bytes.data() + start, layout, big_endian, values);
    }
  }
  return values;
}

/// GDCM is given a file of our own with these pixels: what else the original holds cannot disturb it.
std::string decoded(const fs::path& file, const DicomObject& object, const Layout& layout) {
  DatasetBuilder set;
  set.text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.7")  // secondary capture
      .text(0x00080018, "UI", "2.25.1")
      .unsigned_short(0x00280002, 1)
      .text(0x00280004, "CS", "MONOCHROME2")
      .text(0x00280008, "IS", std::to_string(layout.frames))
      .unsigned_short(0x00280010, std::uint16_t(layout.rows))
      .unsigned_short(0x00280011, std::uint16_t(layout.columns))
      .unsigned_short(0x00280100, std::uint16_t(layout.bits))
      .unsigned_short(0x00280101, std::uint16_t(layout.stored))
      .unsigned_short(0x00280102, std::uint16_t(layout.high))
      .unsigned_short(0x00280103, layout.negative ? 1 : 0)
      .fragments(pixel_bytes(file, object));
  std::istringstream in(set.file(object.syntax));
  gdcm::PixmapReader reader;
  reader.SetStream(in);
  const auto undecodable = [&] {
    return input_error(file.string(), ": its pixels cannot be decoded (transfer syntax ",
                       object.syntax, "); export the series uncompressed");
  };
  if (!reader.Read()) throw undecodable();
  const gdcm::Pixmap& image = reader.GetPixmap();
  std::string bytes(image.GetBufferLength(), '\0');
  if (image.GetPixelFormat().GetBitsAllocated() != layout.bits || !image.GetBuffer(bytes.data()))
    throw undecodable();
  return bytes;
}

}  // namespace

void check_grey(const fs::path& file, const DicomHeader& header) {
  const std::string bits = text_of(header, "0028|0100"), stored = text_of(header, "0028|0101");
  const std::string samples = text_of(header, "0028|0002");
  if (bits != "8" && bits != "16") {
    throw input_error(file.string(), ": ", bits.empty() ? "no" : bits,
                      " bits allocated per pixel: 8 or 16 are supported");
  }
  const int depth = std::atoi(stored.c_str());
  if (!stored.empty() && !(depth >= 1 && depth <= std::atoi(bits.c_str()))) {
    throw input_error(file.string(), ": ", stored, " of ", bits, " bits stored per pixel");
  }
  if (!samples.empty() && samples != "1") {
    throw input_error(file.string(), ": ", samples,
                      " samples per pixel: a grey-scale image is needed");
  }
}

std::vector<float> stored_values(const fs::path& file, const DicomObject& object,
                                 const std::vector<int>& frames) {
  const Layout layout = layout_of(object.header);
  if (!object.pixels->encapsulated) {
    return unpacked(pixel_bytes(file, object), layout, object.big_endian, frames, file);
  }
  return unpacked(decoded(file, object, layout), layout, false, frames, file);
}

std::vector<float> guarded_values(const fs::path& file, const DicomObject& object) {
  if (!object.pixels->encapsulated) return stored_values(file, object);
  const std::string packed = in_guarded_child(file.string(), [&] {
    const std::vector<float> values = stored_values(file, object);
    return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float));
  });
  std::vector<float> values(packed.size() / sizeof(float));
  std::memcpy(values.data(), packed.data(), values.size() * sizeof(float));
  return values;
}

}  // namespace breast
