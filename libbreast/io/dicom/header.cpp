// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dicom/header.hpp"

// A walk through a DICOM file's elements (PS3.5 section 7), enough to know that it is whole and to
// read short text elements.
#include <algorithm>
#include <array>
#include <bit>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "core/table.hpp"
#include "io/dicom/delimiters.hpp"
#include "io/dicom/storage_class.hpp"
#include "io/volume/inflate.hpp"

namespace breast {

namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t pixel_data = 0x7fe00010, float_pixels = 0x7fe00008,
                        double_pixels = 0x7fe00009, per_frame_groups = 0x52009230;
// Sequences whose elements are kept: the codes of a mammogram's view and, within it, of the view's
// modifiers (PS3.3 C.8.11.7); the functional groups of an enhanced object (C.7.6.16) and those of its
// place, pixels, time, kind and contrast; the segments of a segmentation, and that of a frame (C.8.20).
constexpr std::array<std::uint32_t, 17> kept_sequences{
    0x00540220, 0x00540222, 0x52009229, 0x52009230, 0x00209113, 0x00209116,
    0x00289110, 0x00289145, 0x00209111, 0x00189226, 0x00189114, 0x00189112,
    0x00189115, 0x00189117, 0x00209071, 0x00620002, 0x0062000a};
// Elements that are binary numbers; others, such as Rescale Slope, are text.
constexpr std::array<std::uint32_t, 13> shorts{
    0x00620004, 0x0062000b, 0x0062000e, 0x00280002, 0x00280010, 0x00280011, 0x00280100,
    0x00280101, 0x00280102, 0x00280103, 0x00280120, 0x00209156, 0x0043102f};
constexpr std::array<std::uint32_t, 1> longs{0x00209128};
constexpr std::array<std::uint32_t, 3> doubles{0x00189082, 0x00209153, 0x00189087};

// Transfer syntaxes whose pixel data are native (PS3.5 A.1, A.2, A.3, A.5).
constexpr const char* implicit_little_endian = "1.2.840.10008.1.2";
constexpr const char* explicit_little_endian = "1.2.840.10008.1.2.1";
constexpr const char* deflated_little_endian = "1.2.840.10008.1.2.1.99";
constexpr const char* explicit_big_endian = "1.2.840.10008.1.2.2";

// Value representations (PS3.5 table 6.2-1) with a length of 32 bits after two empty bytes, and
// those with a length of 16 bits.
constexpr std::string_view long_kinds = "OB OD OF OL OV OW SQ SV UC UN UR UT UV";
constexpr std::string_view short_kinds =
    "AE AS AT CS DA DS DT FD FL IS LO LT PN SH SL SS ST TM UI UL US";
// Of a slice, and of each frame, a few hundred; a file of zeros is one of empty elements, eight bytes
// each.
constexpr int most_tags = 200000, most_tags_of_frame = 20000;
constexpr std::size_t preamble_bytes = 132;
constexpr double most_inflated_bytes = 2e9;

template <std::size_t N>
bool is_among(const std::array<std::uint32_t, N>& tags, std::uint32_t tag) {
  return std::find(tags.begin(), tags.end(), tag) != tags.end();
}

bool is_among(std::string_view kinds, std::string_view name) {
  const auto at = kinds.find(name);
  return name.size() == 2 && at != std::string_view::npos && at % 3 == 0;  // not across two of them
}

bool is_kind(std::string_view name) {
  return is_among(long_kinds, name) || is_among(short_kinds, name);
}

std::string key_of(std::uint32_t tag) {
  char key[16];
  std::snprintf(key, sizeof key, "%04x|%04x", tag >> 16, tag & 0xffff);
  return key;
}

template <class T>
T swapped(T value) {
  auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
  std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

class Walker {
 public:
  Walker(const fs::path& file, std::istream& in, DicomObject& object)
      : file_(file), in_(in), size_(size_of(in)), object_(object), header_(&object.header) {}

  /// The elements of group 2, which are explicit and little endian whatever follows them.
  std::uint64_t walk_meta(std::uint64_t start) {
    position_ = start;
    while (position_ < size_ && peek_tag() >> 16 == 2) element(true, 0, true);
    return position_;
  }

  /// The data set, as far as its pixel data.
  void walk(std::uint64_t start, bool explicit_vr) {
    position_ = start;
    big_endian_ = object_.big_endian;
    while (position_ < size_ && !object_.pixels) element(explicit_vr, 0, true);
  }

  /// Without transfer syntax: whether the first element, of group 8, is big-endian.
  bool begins_big_endian(std::uint64_t start) {
    return start + 2 <= size_ && bytes_at(start, 2) == std::string("\0\x08", 2);
  }

  /// Without transfer syntax: whether the first element states the kind of its value.
  bool begins_explicit(std::uint64_t start) {
    return start + 6 <= size_ && is_kind(bytes_at(start + 4, 2));
  }

 private:
  Error broken(const char* why) const {
    return input_error(file_.string(), ": damaged or truncated DICOM file (", why, ")");
  }

  static std::uint64_t size_of(std::istream& in) {
    in.seekg(0, std::ios::end);
    return std::uint64_t(std::max<std::streamoff>(in.tellg(), 0));
  }

  std::string bytes_at(std::uint64_t position, std::size_t count) {
    std::string bytes(count, '\0');
    in_.clear();
    in_.seekg(std::streamoff(position));
    if (position + count > size_ || !in_.read(bytes.data(), std::streamsize(count)))
      throw broken("ends inside an element");
    return bytes;
  }

  template <class T>
  T number_at(std::uint64_t position) {
    T value;
    std::memcpy(&value, bytes_at(position, sizeof(T)).data(), sizeof(T));
    return big_endian_ ? swapped(value) : value;
  }
  template <class T>
  T take() {
    if (position_ + sizeof(T) > size_) throw broken("ends inside an element's head");
    position_ += sizeof(T);
    return number_at<T>(position_ - sizeof(T));
  }
  std::uint32_t take_tag() {
    if (++tags_ > (in_frame_ ? most_tags_of_frame : most_tags))
      throw broken("has more elements than any image");
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
  /// the length is undefined. The elements of those that are not kept are passed over where they can be.
  void items(bool explicit_vr, int depth, std::uint32_t bytes, bool kept, bool of_frames = false) {
    if (depth > 16) throw broken("sequences nested too deeply");
    const std::uint64_t end = bytes == undefined_length ? size_ : position_ + bytes;
    if (end > size_) throw broken("ends inside a sequence");
    while (bytes == undefined_length || position_ < end) {
      const std::uint32_t tag = take_tag();
      const auto length = take<std::uint32_t>();
      if (tag == sequence_end_tag && bytes == undefined_length) return;
      if (tag != item_tag) throw broken("an item is expected");
      if (length != undefined_length && !kept) {
        skip(length);
      } else if (of_frames) {
        frame(explicit_vr, depth, length);
      } else {
        item(explicit_vr, depth, length, kept);
      }
    }
    if (position_ != end) throw broken("a sequence is longer than it states");
  }

  /// An item of the per-frame functional groups, whose elements are those of one frame.
  void frame(bool explicit_vr, int depth, std::uint32_t length) {
    DicomHeader own;
    header_ = &own;
    std::string outer;
    std::swap(outer, path_);
    const int tags = std::exchange(tags_, 0);
    in_frame_ = true;
    item(explicit_vr, depth, length, true);
    in_frame_ = false;
    tags_ = tags;
    std::swap(outer, path_);
    header_ = &object_.header;
    object_.frames.push_back(std::move(own));
  }

  void item(bool explicit_vr, int depth, std::uint32_t length, bool kept) {
    const std::uint64_t end = position_ + length;
    if (length == undefined_length) {
      while (peek_tag() != item_end_tag) element(explicit_vr, depth + 1, kept);
      position_ += 8;
      return;
    }
    while (position_ < end) element(explicit_vr, depth + 1, kept);
    if (position_ != end) throw broken("an item is longer than it states");
  }

  void element(bool explicit_vr, int depth, bool kept) {
    const std::uint32_t tag = take_tag();
    const std::string name = explicit_vr ? bytes_at(position_, 2) : std::string();
    const std::uint32_t length = explicit_vr ? length_of(tag, name) : take<std::uint32_t>();
    const bool explicit_items = explicit_vr && name != "UN";
    if (tag == pixel_data && depth == 0) return pixels(length, name == "OW");
    if ((tag == float_pixels || tag == double_pixels) && depth == 0)
      throw input_error(file_.string(),
                        ": its pixels are floating-point numbers, which are not "
                        "read: export the series with integer values");
    if (kept && is_among(kept_sequences, tag)) {
      const std::string outer = path_;
      path_ += key_of(tag) + "/";
      items(explicit_items, depth + 1, length, true, tag == per_frame_groups);
      path_ = outer;
      return;
    }
    if (length == undefined_length) return items(explicit_items, depth + 1, length, false);
    if (kept && length <= 256) keep(tag, length);
    skip(length);
  }

  /// Passes the kind of an element and its length, which it returns.
  std::uint32_t length_of(std::uint32_t tag, const std::string& name) {
    if (is_among(long_kinds, name)) {
      position_ += 4;
      return take<std::uint32_t>();
    }
    if (is_among(short_kinds, name)) {
      position_ += 2;
      return take<std::uint16_t>();
    }
    const bool is_private = (tag >> 16 & 1) != 0;
    if (!is_private) throw broken("no element where one must be");
    return length_of_unknown_kind(tag);
  }

  /// Programs differ in how they write a private element of a kind that they do not know: with a length
  /// of 16 or 32 bits after two letters, or with one of 32 bits alone. An element must follow.
  std::uint32_t length_of_unknown_kind(std::uint32_t tag) {
    struct Form {
      int before;
      bool is_short;
    };
    for (const auto& [before, is_short] : {Form{2, true}, {4, false}, {0, false}}) {
      const std::uint64_t at = position_ + std::uint64_t(before);
      const std::uint64_t value = at + (is_short ? 2 : 4);
      if (value > size_) continue;
      const std::uint32_t length =
          is_short ? number_at<std::uint16_t>(at) : number_at<std::uint32_t>(at);
      if (length > size_ - value || !element_may_follow(tag, value + length)) continue;
      position_ = value;
      return length;
    }
    throw broken("a private element without a length");
  }
  bool element_may_follow(std::uint32_t tag, std::uint64_t position) {
    if (position == size_) return true;
    if (position + 8 > size_) return false;
    const std::uint32_t group = number_at<std::uint16_t>(position);
    const std::uint32_t next = group << 16 | number_at<std::uint16_t>(position + 2);
    return next == item_end_tag ||
           (next > tag && ((next >> 16 & 1) != 0 || is_kind(bytes_at(position + 4, 2))));
  }

  /// Pixel data end the walk. Fragments are passed one by one, to know that the last is there.
  void pixels(std::uint32_t length, bool words) {
    const std::uint64_t start = position_;
    if (length == undefined_length) {
      items(true, 1, length, false);
      object_.pixels = DicomPixels{start, position_ - start, true, false};
    } else {
      skip(length);
      object_.pixels = DicomPixels{start, length, false, words};
    }
  }

  void keep(std::uint32_t tag, std::uint32_t length) {
    std::string value;
    if (is_among(shorts, tag) && length == 2) {
      value = std::to_string(number_at<std::uint16_t>(position_));
    } else if (is_among(longs, tag) && length == 4) {
      value = std::to_string(number_at<std::uint32_t>(position_));
    } else if (is_among(doubles, tag) && length == 8) {
      value = format_number(std::bit_cast<double>(number_at<std::uint64_t>(position_)));
    } else {
      value = bytes_at(position_, length);
    }
    while (!value.empty() && (value.back() == ' ' || value.back() == '\0')) value.pop_back();
    std::string& kept = (*header_)[path_ + key_of(tag)];
    kept = path_.empty() || kept.empty() ? value : kept + "\\" + value;
  }

  const fs::path& file_;
  std::istream& in_;
  std::uint64_t size_, position_ = 0;
  int tags_ = 0;
  bool big_endian_ = false, in_frame_ = false;
  DicomObject& object_;
  DicomHeader* header_;  ///< of the object or of one frame
  std::string path_;     ///< of the sequences around the present element: "0054|0220/"
};

bool is_native(const std::string& syntax) {
  return syntax == implicit_little_endian || syntax == explicit_little_endian ||
         syntax == explicit_big_endian || syntax == deflated_little_endian;
}

/// Refuses what only programs of one maker read, whose elements need not lie as the standard says, and
/// objects whose pixels are fetched from a server (PS3.5 A.6, A.7).
void check_syntax(const fs::path& file, const std::string& syntax) {
  constexpr std::string_view standard = "1.2.840.10008.1.2";
  constexpr std::array<std::string_view, 4> on_server{
      "1.2.840.10008.1.2.4.94", "1.2.840.10008.1.2.4.95", "1.2.840.10008.1.2.4.204",
      "1.2.840.10008.1.2.4.205"};
  if (syntax != standard && !syntax.starts_with(std::string(standard) + ".")) {
    throw input_error(file.string(), ": transfer syntax ", syntax.substr(0, 64),
                      " is no standard one: export the series as Explicit VR Little Endian");
  }
  if (std::find(on_server.begin(), on_server.end(), syntax) != on_server.end()) {
    throw input_error(file.string(),
                      ": names a server for its pixels instead of holding them "
                      "(transfer syntax ",
                      syntax, "): export the series with its pixels");
  }
}

/// Pixel data are encapsulated if, and only if, the transfer syntax says so; otherwise they must be as
/// long as rows, columns, frames and bits say; some programs add a little.
void check_pixel_bytes(const fs::path& file, const DicomObject& object) {
  const auto number = [&](const char* key, double fallback) {
    const std::string text = text_of(object.header, key);
    return text.empty() ? fallback : std::strtod(text.c_str(), nullptr);
  };
  const DicomPixels& pixels = *object.pixels;
  if (pixels.encapsulated == is_native(object.syntax))
    throw input_error(file.string(), ": pixel data are ", pixels.encapsulated ? "" : "not ",
                      "encapsulated, contrary to the transfer syntax ", object.syntax);
  if (pixels.encapsulated) return;
  const double needed = number("0028|0010", 0) * number("0028|0011", 0) * number("0028|0002", 1) *
                        number("0028|0100", 16) / 8 * number("0028|0008", 1);
  if (!(needed > 0) || double(pixels.bytes) < needed) {
    throw input_error(file.string(), ": pixel data of ", pixels.bytes,
                      " bytes, rows and columns need ", needed);
  }
  if (double(pixels.bytes) >= 2 * needed && double(pixels.bytes) > needed + 1) {
    throw input_error(file.string(), ": pixel data of ", pixels.bytes,
                      " bytes, but rows, columns and frames need ", needed,
                      ": it holds more frames than it states, or larger ones");
  }
}

/// Where the elements of a file begin: after the preamble, or at once in one without it, which is known
/// by its first element, of group 2 or 8. Nothing for another file.
std::optional<std::uint64_t> start_of(std::istream& in) {
  std::array<char, preamble_bytes> head{};
  in.read(head.data(), head.size());
  const auto count = std::size_t(in.gcount());
  in.clear();
  if (count == head.size() && std::memcmp(head.data() + 128, "DICM", 4) == 0) return head.size();
  if (count < 12) return std::nullopt;
  const auto byte = [&](std::size_t at) { return std::uint8_t(head[at]); };
  const int group = byte(0) + 256 * byte(1), element = byte(2) + 256 * byte(3);
  const bool is_explicit = is_kind(std::string_view(head.data() + 4, 2));
  const bool short_implicit = byte(5) == 0 && byte(6) == 0 && byte(7) == 0;
  const bool begins_big = byte(0) == 0 && byte(1) == 8 && byte(2) == 0 && byte(3) <= 0x18;
  const bool begins = (group == 8 && element <= 0x18 && (is_explicit || short_implicit)) ||
                      (group == 2 && element <= 0x10 && is_explicit) || (begins_big && is_explicit);
  return begins ? std::optional<std::uint64_t>(0) : std::nullopt;
}

}  // namespace

std::string text_of(const DicomHeader& header, const std::string& key) {
  const auto found = header.find(key);
  return found == header.end() ? std::string() : found->second;
}

bool read_dicom_object(const fs::path& file, DicomObject& object) {
  object = {};
  std::ifstream in(file, std::ios::binary);
  const std::optional<std::uint64_t> start = in ? start_of(in) : std::nullopt;
  if (!start) return false;
  Walker head(file, in, object);
  const std::uint64_t set = object.set = head.walk_meta(*start);
  object.syntax = text_of(object.header, "0002|0010");
  if (object.syntax.empty()) {
    object.syntax = !head.begins_explicit(set)    ? implicit_little_endian
                    : head.begins_big_endian(set) ? explicit_big_endian
                                                  : explicit_little_endian;
  }
  check_syntax(file, object.syntax);
  object.big_endian = object.syntax == explicit_big_endian;
  object.deflated = object.syntax == deflated_little_endian;
  const bool explicit_vr = object.syntax != implicit_little_endian;
  if (object.deflated) {
    std::istringstream inflated(inflated_bytes(file, std::streamoff(set), most_inflated_bytes));
    Walker(file, inflated, object).walk(0, explicit_vr);
  } else {
    head.walk(set, explicit_vr);
  }
  if (object.pixels) {
    check_pixel_bytes(file, object);
    return true;
  }
  std::string sop_class = text_of(object.header, "0008|0016");
  if (sop_class.empty()) sop_class = text_of(object.header, "0002|0002");
  if (sop_class.empty() || is_image_class(sop_class)) {
    throw input_error(file.string(),
                      ": damaged or truncated DICOM file (ends before the pixel data)");
  }
  return true;
}

bool read_dicom_header(const fs::path& file, DicomHeader& header) {
  DicomObject object;
  if (!read_dicom_object(file, object)) return false;
  header = std::move(object.header);
  if (!object.pixels) {
    throw input_error(file.string(), ": a ", object_kind(text_of(header, "0008|0016")),
                      ", which holds no pixels; give the image");
  }
  return true;
}

std::string pixel_bytes(const fs::path& file, const DicomObject& object) {
  const DicomPixels& pixels = *object.pixels;
  if (object.deflated) {
    return inflated_bytes(file, std::streamoff(object.set), most_inflated_bytes)
        .substr(pixels.position, pixels.bytes);
  }
  std::string bytes(pixels.bytes, '\0');
  std::ifstream in(file, std::ios::binary);
  in.seekg(std::streamoff(pixels.position));
  if (!in.read(bytes.data(), std::streamsize(bytes.size())))
    throw input_error(file.string(), ": its pixel data can no longer be read");
  const bool are_words = std::atoi(text_of(object.header, "0028|0100").c_str()) > 8;
  if (object.big_endian && pixels.words && !are_words) {  // two pixels a word, the second one first
    for (std::size_t n = 0; n + 1 < bytes.size(); n += 2) std::swap(bytes[n], bytes[n + 1]);
  }
  return bytes;
}

}  // namespace breast
