// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dicom/header.hpp"

// A walk through a DICOM file's elements (PS3.5 section 7), enough to know that it is whole and to
// read short text elements.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <string_view>

#include "core/error.hpp"
#include "io/dicom/delimiters.hpp"

namespace breast {

namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t pixel_data = 0x7fe00010;
// The codes of a mammogram's view and, within it, of the view's modifiers (PS3.3 C.8.11.7).
constexpr std::array<std::uint32_t, 2> view_sequences{0x00540220, 0x00540222};
// Elements of group 28 that are binary numbers (US); others, such as Rescale Slope, are text.
constexpr std::array<std::uint32_t, 7> binary_numbers{
    0x00280002, 0x00280010, 0x00280011, 0x00280100, 0x00280101, 0x00280102, 0x00280103};
// Transfer syntaxes whose pixel data are native (PS3.5 A.1, A.2).
const std::string implicit_syntax = "1.2.840.10008.1.2";
const std::string explicit_little_endian = "1.2.840.10008.1.2.1";
std::string transfer_syntax(const DicomHeader& header) {
  const auto stated = header.find("0002|0010");
  return stated == header.end() ? implicit_syntax : stated->second;
}

// Value representations (PS3.5 table 6.2-1) with a length of 32 bits after two empty bytes, and
// those with a length of 16 bits.
constexpr std::string_view long_kinds = "OB OD OF OL OV OW SQ SV UC UN UR UT UV";
constexpr std::string_view short_kinds =
    "AE AS AT CS DA DS DT FD FL IS LO LT PN SH SL SS ST TM UI UL US";
// Of a slice a few hundred; a file of zeros is one of empty elements, eight bytes each.
constexpr int most_tags = 200000;

template <std::size_t N>
bool is_among(const std::array<std::uint32_t, N>& tags, std::uint32_t tag) {
  return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

bool is_among(std::string_view kinds, const std::string& name) {
  const auto at = kinds.find(name);
  return at != std::string_view::npos && at % 3 == 0;  // not across two of them
}

class Walker {
 public:
  Walker(const fs::path& file, std::ifstream& in)
      : file_(file), in_(in), size_(fs::file_size(file)) {}

  /// Group 2 is always explicit; the transfer syntax it names holds for the rest.
  void walk(DicomHeader& header) {
    position_ = 132;
    while (position_ < size_) {
      const std::uint32_t next = peek_tag();
      if (next >> 16 == 2) {
        element(true, 0, &header);
      } else {
        element(explicit_syntax(header), 0, &header);
      }
    }
    if (!header.contains("7fe0|0010")) throw broken("ends before the pixel data");
  }

 private:
  Error broken(const char* why) const {
    return input_error(file_.string(), ": damaged or truncated DICOM file (", why, ")");
  }

  bool explicit_syntax(const DicomHeader& header) const {
    const std::string syntax = transfer_syntax(header);
    if (syntax == "1.2.840.10008.1.2.2" || syntax == "1.2.840.10008.1.2.1.99") {
      throw input_error(file_.string(),
                        ": big-endian or deflated DICOM is not read: convert it first");
    }
    return syntax != implicit_syntax;
  }

  template <class T>
  T take() {
    std::array<char, sizeof(T)> bytes;
    in_.seekg(std::streamoff(position_));
    if (position_ + sizeof(T) > size_ || !in_.read(bytes.data(), sizeof(T))) {
      throw broken("ends inside an element's head");
    }
    position_ += sizeof(T);
    return std::bit_cast<T>(bytes);
  }
  std::uint32_t take_tag() {
    if (++tags_ > most_tags) throw broken("has more elements than any image");
    const std::uint32_t group = take<std::uint16_t>();
    return group << 16 | take<std::uint16_t>();
  }
  std::uint32_t peek_tag() {
    const auto here = position_;
    const std::uint32_t tag = take_tag();
    position_ = here;
    return tag;
  }
  void skip(std::uint64_t length) {
    if (length > size_ - position_) throw broken("ends inside an element");
    position_ += length;
  }

  /// Items of a sequence (or of encapsulated pixel data) of this many bytes, or up to its delimiter when
  /// the length is undefined.
  void items(bool explicit_vr, int depth, std::uint32_t bytes, DicomHeader* header) {
    if (depth > 16) throw broken("sequences nested too deeply");
    const std::uint64_t end = bytes == undefined_length ? size_ : position_ + bytes;
    if (end > size_) throw broken("ends inside a sequence");
    while (bytes == undefined_length || position_ < end) {
      const std::uint32_t tag = take_tag();
      const auto length = take<std::uint32_t>();
      if (tag == sequence_end_tag && bytes == undefined_length) return;
      if (tag != item_tag) throw broken("an item is expected");
      if (length != undefined_length && header == nullptr) {
        skip(length);
      } else {
        item(explicit_vr, depth, length, header);
      }
    }
    if (position_ != end) throw broken("a sequence is longer than it states");
  }

  void item(bool explicit_vr, int depth, std::uint32_t length, DicomHeader* header) {
    const std::uint64_t end = position_ + length;
    if (length == undefined_length) {
      while (peek_tag() != item_end_tag) element(explicit_vr, depth + 1, header);
      position_ += 8;
      return;
    }
    while (position_ < end) element(explicit_vr, depth + 1, header);
    if (position_ != end) throw broken("an item is longer than it states");
  }

  void element(bool explicit_vr, int depth, DicomHeader* header) {
    const std::uint32_t tag = take_tag();
    std::uint32_t length = 0;
    bool unknown_vr = false;
    if (explicit_vr) {
      const auto vr = take<std::array<char, 2>>();
      const std::string name(vr.begin(), vr.end());
      const bool is_long = is_among(long_kinds, name);
      // Readers differ in where the length of an unknown kind stands: GDCM takes the value for a
      // length of up to 4 GB.
      if (!is_long && !is_among(short_kinds, name)) throw broken("no element where one must be");
      unknown_vr = name == "UN";
      if (is_long) position_ += 2;
      length = is_long ? take<std::uint32_t>() : take<std::uint16_t>();
    } else {
      length = take<std::uint32_t>();
    }
    if (header && is_among(view_sequences, tag)) {
      const std::string outer = path_;
      path_ += key_of(tag) + "/";
      items(explicit_vr && !unknown_vr, depth + 1, length, header);
      path_ = outer;
      return;
    }
    if (length == undefined_length) {
      items(explicit_vr && !unknown_vr, depth + 1, length, nullptr);
      if (header && tag == pixel_data) (*header)["7fe0|0010"] = "encapsulated";
      return;
    }
    if (header && tag == pixel_data) (*header)["7fe0|0010"] = std::to_string(length);
    if (header && tag != pixel_data && length <= 256) keep(tag, length, *header);
    skip(length);
  }

  void keep(std::uint32_t tag, std::uint32_t length, DicomHeader& header) {
    std::string value(length, '\0');
    in_.seekg(std::streamoff(position_));
    if (!in_.read(value.data(), length)) throw broken("ends inside an element");
    if (is_among(binary_numbers, tag) && length == 2) {
      std::uint16_t number = 0;
      std::memcpy(&number, value.data(), 2);
      value = std::to_string(number);
    }
    while (!value.empty() && (value.back() == ' ' || value.back() == '\0')) value.pop_back();
    std::string& kept = header[path_ + key_of(tag)];
    kept = path_.empty() || kept.empty() ? value : kept + "\\" + value;
  }

  static std::string key_of(std::uint32_t tag) {
    char key[16];
    std::snprintf(key, sizeof key, "%04x|%04x", tag >> 16, tag & 0xffff);
    return key;
  }

  const fs::path& file_;
  std::ifstream& in_;
  std::uint64_t size_, position_ = 0;
  int tags_ = 0;
  std::string path_;  ///< of the sequences around the present element: "0054|0220/"
};

/// Pixel data are encapsulated if, and only if, the transfer syntax says so; otherwise they must be as
/// long as rows, columns and bits say.
void check_pixel_bytes(const fs::path& file, const DicomHeader& header) {
  const auto number = [&](const char* key, double fallback) {
    const auto found = header.find(key);
    return found == header.end() ? fallback : std::strtod(found->second.c_str(), nullptr);
  };
  const std::string& length = header.at("7fe0|0010");
  const bool encapsulated = length == "encapsulated";
  const std::string syntax = transfer_syntax(header);
  const bool native = syntax == implicit_syntax || syntax == explicit_little_endian;
  if (encapsulated == native)
    throw input_error(file.string(), ": pixel data are ", encapsulated ? "" : "not ",
                      "encapsulated, contrary to the transfer syntax ", syntax);
  if (encapsulated) return;
  const double needed = number("0028|0010", 0) * number("0028|0011", 0) * number("0028|0002", 1) *
                        number("0028|0100", 16) / 8;
  if (!(needed > 0) || std::strtod(length.c_str(), nullptr) < needed) {
    throw input_error(file.string(), ": pixel data of ", length, " bytes, rows and columns need ",
                      needed);
  }
}

}  // namespace

bool read_dicom_header(const fs::path& file, DicomHeader& header) {
  std::ifstream in(file, std::ios::binary);
  char preamble[132] = {};
  if (!in || !in.read(preamble, sizeof preamble) || std::memcmp(preamble + 128, "DICM", 4) != 0)
    return false;
  header.clear();
  Walker(file, in).walk(header);
  check_pixel_bytes(file, header);
  return true;
}

}  // namespace breast
