// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dicom/dataset.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "core/sha256.hpp"
#include "io/dicom/delimiters.hpp"

namespace breast {

namespace {

std::string little_endian(std::uint32_t value, int bytes) {
  std::string out;
  for (int b = 0; b < bytes; ++b) out += char(value >> (8 * b) & 0xff);
  return out;
}

std::string tag_bytes(std::uint32_t tag) {
  return little_endian(tag >> 16, 2) + little_endian(tag & 0xffff, 2);
}

// Types whose length takes four bytes (PS3.5 7.1.2).
bool is_long(std::string_view vr) {
  constexpr std::array<std::string_view, 13> names = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                      "SV", "UC", "UN", "UR", "UT", "UV"};
  return std::find(names.begin(), names.end(), vr) != names.end();
}

}  // namespace

DatasetBuilder& DatasetBuilder::put(std::uint32_t tag, const char* vr, std::string value) {
  const std::string reserved = is_long(vr) ? std::string(2, '\0') : std::string();
  const int width = is_long(vr) ? 4 : 2;
  elements_[tag] =
      tag_bytes(tag) + vr + reserved + little_endian(std::uint32_t(value.size()), width) + value;
  return *this;
}

DatasetBuilder& DatasetBuilder::text(std::uint32_t tag, const char* vr, std::string value) {
  if (tag == 0x00080016) class_uid_ = value;
  if (tag == 0x00080018) instance_uid_ = value;
  if (value.size() % 2 != 0) value += std::string_view(vr) == "UI" ? '\0' : ' ';
  return put(tag, vr, std::move(value));
}

DatasetBuilder& DatasetBuilder::number(std::uint32_t tag, double value) {
  char text[32];  // DS holds 16 characters
  for (int digits = 10; digits > 0; --digits) {
    if (std::snprintf(text, sizeof text, "%.*g", digits, value) <= 16) break;
  }
  return this->text(tag, "DS", text);
}

DatasetBuilder& DatasetBuilder::unsigned_short(std::uint32_t tag, std::uint16_t value) {
  return put(tag, "US", little_endian(value, 2));
}

DatasetBuilder& DatasetBuilder::signed_short(std::uint32_t tag, std::int16_t value) {
  return put(tag, "SS", little_endian(std::uint16_t(value), 2));
}

DatasetBuilder& DatasetBuilder::unsigned_longs(std::uint32_t tag,
                                               const std::vector<std::uint32_t>& values) {
  std::string bytes;
  for (const std::uint32_t value : values) bytes += little_endian(value, 4);
  return put(tag, "UL", std::move(bytes));
}

DatasetBuilder& DatasetBuilder::tag_of(std::uint32_t tag, std::uint32_t element) {
  return put(tag, "AT", tag_bytes(element));
}

DatasetBuilder& DatasetBuilder::words(std::uint32_t tag, std::string_view bytes) {
  return put(tag, "OW", std::string(bytes));
}

DatasetBuilder& DatasetBuilder::sequence(std::uint32_t tag,
                                         const std::vector<DatasetBuilder>& items) {
  const std::string undefined = little_endian(undefined_length, 4);
  const std::string end_length = little_endian(0, 4);
  std::string element = tag_bytes(tag) + "SQ" + std::string(2, '\0') + undefined;
  for (const DatasetBuilder& item : items) {
    element +=
        tag_bytes(item_tag) + undefined + item.bytes() + tag_bytes(item_end_tag) + end_length;
  }
  elements_[tag] = element + tag_bytes(sequence_end_tag) + end_length;
  return *this;
}

DatasetBuilder& DatasetBuilder::grey_layout(int columns, int rows, int stored, bool is_signed,
                                            const char* photometric) {
  return unsigned_short(0x00280002, 1)
      .text(0x00280004, "CS", photometric)
      .unsigned_short(0x00280010, std::uint16_t(rows))
      .unsigned_short(0x00280011, std::uint16_t(columns))
      .unsigned_short(0x00280100, 16)
      .unsigned_short(0x00280101, std::uint16_t(stored))
      .unsigned_short(0x00280102, std::uint16_t(stored - 1))
      .unsigned_short(0x00280103, is_signed ? 1 : 0);
}

DatasetBuilder& DatasetBuilder::fragments(std::string_view bytes) {
  constexpr std::uint32_t pixel_data = 0x7fe00010;
  elements_[pixel_data] = tag_bytes(pixel_data) + "OB" + std::string(2, '\0') +
                          little_endian(undefined_length, 4) + std::string(bytes);
  return *this;
}

std::string DatasetBuilder::bytes() const {
  std::string all;
  for (const auto& [tag, element] : elements_) all += element;
  return all;
}

std::string DatasetBuilder::file(const std::string& syntax) const {
  DatasetBuilder meta;
  meta.put(0x00020001, "OB", std::string("\0\1", 2))
      .text(0x00020002, "UI", class_uid_)
      .text(0x00020003, "UI", instance_uid_)
      .text(0x00020010, "UI", syntax)
      .text(0x00020012, "UI", uid_from("libbreast"))
      .text(0x00020013, "SH", "libbreast");
  const std::string rest = meta.bytes();
  DatasetBuilder length;
  length.put(0x00020000, "UL", little_endian(std::uint32_t(rest.size()), 4));
  return std::string(128, '\0') + "DICM" + length.bytes() + rest + bytes();
}

DatasetBuilder code_item(const std::string& value, const std::string& scheme,
                         const std::string& meaning) {
  DatasetBuilder item;
  item.text(0x00080100, "SH", value).text(0x00080102, "SH", scheme).text(0x00080104, "LO", meaning);
  return item;
}

std::string uid_from(const std::string& text) {
  Sha256 hash;
  hash.update(text);
  return "2.25." + std::to_string(std::stoull(hash.hex().substr(0, 15), nullptr, 16) + 1);
}

std::string vector_text(const Vec3& a) {
  char text[80];
  std::snprintf(text, sizeof text, "%.10g\\%.10g\\%.10g", a[0], a[1], a[2]);
  return text;
}

}  // namespace breast
