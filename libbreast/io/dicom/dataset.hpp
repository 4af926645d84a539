// SPDX-License-Identifier: GPL-3.0-or-later
// Construction of DICOM data sets element by element, and their encoding as files (PS3.5, PS3.10).
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/types.hpp"

namespace breast {

/// Builds a data set in explicit little endian. `tag` has the form 0xGGGGEEEE and `vr` is the two
/// letters of its type; an element that is given again replaces the first.
class DatasetBuilder {
 public:
  /// Adds text, padded to even length as required for its type.
  DatasetBuilder& text(std::uint32_t tag, const char* vr, std::string value);
  DatasetBuilder& number(std::uint32_t tag, double value);  ///< DS, as many digits as it holds
  DatasetBuilder& unsigned_short(std::uint32_t tag, std::uint16_t value);
  DatasetBuilder& signed_short(std::uint32_t tag, std::int16_t value);
  DatasetBuilder& unsigned_longs(std::uint32_t tag, const std::vector<std::uint32_t>& values);
  DatasetBuilder& tag_of(std::uint32_t tag, std::uint32_t element);  ///< AT, another element's tag
  DatasetBuilder& words(std::uint32_t tag, std::string_view bytes);  ///< OW, 16-bit values
  DatasetBuilder& sequence(std::uint32_t tag, const std::vector<DatasetBuilder>& items);
  /// How grey pixels of 16 bits lie in the pixel data (PS3.3 C.7.6.3): of which `stored` are used.
  DatasetBuilder& grey_layout(int columns, int rows, int stored, bool is_signed,
                              const char* photometric = "MONOCHROME2");

  /// Encapsulated pixel data: fragments with their heads, up to the delimiter that ends them.
  DatasetBuilder& fragments(std::string_view bytes);

  /// Returns the encoded elements in the order of their tags.
  std::string bytes() const;
  /// Returns a whole file: preamble, meta information with the set's SOP class and instance, and
  /// the set. Another transfer syntax than explicit little endian is that of its encapsulated pixels.
  std::string file(const std::string& syntax = "1.2.840.10008.1.2.1") const;

 private:
  DatasetBuilder& put(std::uint32_t tag, const char* vr, std::string value);
  std::map<std::uint32_t, std::string> elements_;  ///< each with its head
  std::string class_uid_, instance_uid_;
};

/// An item of a code sequence: value, scheme and meaning.
DatasetBuilder code_item(const std::string& value, const std::string& scheme,
                         const std::string& meaning);

/// A UID derived from text; the same text gives the same UID ("2.25." is the root of such numbers,
/// PS3.5 B.2).
std::string uid_from(const std::string& text);

/// The three numbers of a DS, as of a place or a direction.
std::string vector_text(const Vec3& a);

}  // namespace breast
