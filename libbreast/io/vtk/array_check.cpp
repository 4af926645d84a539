// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/vtk/array_check.hpp"

#include <vtkXMLDataElement.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

namespace breast {

namespace {

using Size = std::uint64_t;

constexpr std::size_t words_before_sizes =
    3;  // number of blocks, size of a block, size of the last
constexpr Size most_text_block = Size(1) << 24;
constexpr Size small_bytes = 64;  // beyond what a format's limit gives for a few bytes

/// How the compressed arrays of a file are written.
struct Form {
  std::string_view text;
  bool big_endian = false;
  std::size_t word = sizeof(std::uint32_t);
  Size expansion = 1;  ///< bytes that one compressed byte can become at most
  bool zlib = false;
};

std::string_view attribute(vtkXMLDataElement* element, const char* name) {
  const char* value = element->GetAttribute(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

// The limits of the formats: 1032 of zlib and 255 of LZ4; that of LZMA is not known exactly.
Form form_of(vtkXMLDataElement* root, std::string_view text) {
  Form form{text};
  form.big_endian = attribute(root, "byte_order") == "BigEndian";
  if (attribute(root, "header_type") == "UInt64") form.word = sizeof(std::uint64_t);
  const std::string_view compressor = attribute(root, "compressor");
  form.zlib = compressor == "vtkZLibDataCompressor";
  form.expansion = form.zlib ? 1032 : compressor == "vtkLZ4DataCompressor" ? 256 : 10000;
  return form;
}

int digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// The first bytes of a base64 text; fewer where it ends, or has something else in it.
std::vector<std::uint8_t> decoded(std::string_view text, std::size_t bytes) {
  std::vector<std::uint8_t> out;
  unsigned bits = 0, have = 0;
  for (const char c : text) {
    if (out.size() == bytes || digit(c) < 0) break;
    bits = (bits << 6 | unsigned(digit(c))) & 0xffff;
    have += 6;
    if (have < 8) continue;
    have -= 8;
    out.push_back(std::uint8_t(bits >> have));
  }
  return out;
}

std::vector<Size> words_of(const std::vector<std::uint8_t>& bytes, const Form& form) {
  std::vector<Size> words(bytes.size() / form.word, 0);
  for (std::size_t i = 0; i < words.size() * form.word; ++i) {
    const std::size_t place = i % form.word;
    const std::size_t shift = 8 * (form.big_endian ? form.word - 1 - place : place);
    words[i / form.word] |= Size(bytes[i]) << shift;
  }
  return words;
}

/// What stands between the tags of an array; VTK finds it in this way, too.
std::string_view inline_text(vtkXMLDataElement* array, std::string_view text) {
  const auto at = std::size_t(std::max<vtkTypeInt64>(array->GetXMLByteIndex(), 0));
  const auto open = text.find('>', std::min(at, text.size()));
  if (open == std::string_view::npos) return {};
  const auto first = text.find_first_not_of(" \t\r\n", open + 1);
  const auto end = text.find('<', open);
  if (first == std::string_view::npos || end == std::string_view::npos || first > end) return {};
  return text.substr(first, end - first);
}

/// What the tags of an array state. Without a number of values they state 0.
struct Declared {
  Size values = 0;
  Size width = 0;      ///< bytes of a value; 0 for texts and bits
  bool texts = false;  ///< of a number that the array itself states, as in field data
};

Declared declared_by(vtkXMLDataElement* array, Size tuples) {
  if (array->GetAttribute("NumberOfTuples") != nullptr) {
    tuples = std::strtoull(array->GetAttribute("NumberOfTuples"), nullptr, 10);
  }
  const char* stated = array->GetAttribute("NumberOfComponents");
  const Size components = stated == nullptr ? 1 : std::strtoull(stated, nullptr, 10);
  const std::string_view type = attribute(array, "type");
  Declared declared;
  declared.texts = type == "String" && array->GetAttribute("NumberOfTuples") != nullptr;
  declared.width = type.ends_with("64")   ? 8
                   : type.ends_with("32") ? 4
                   : type.ends_with("16") ? 2
                   : type.ends_with("t8") ? 1
                                          : 0;
  if (__builtin_mul_overflow(tuples, components, &declared.values)) declared.values = ~Size(0);
  return declared;
}

Size least_bytes(const Declared& declared) {
  Size bytes = 0;
  const bool too_many = __builtin_mul_overflow(declared.values, declared.width, &bytes);
  return too_many ? ~Size(0) : bytes;
}

/// Texts in an array, each of which ends with a zero. `sizes` is its compression header.
Size texts_in(std::string_view coded, const Form& form, const std::vector<Size>& sizes) {
  constexpr std::size_t coded_group = 4, plain_group = 3;  // of base64
  const std::size_t header =
      (sizes.size() * form.word + plain_group - 1) / plain_group * coded_group;
  const std::vector<std::uint8_t> packed =
      decoded(coded.substr(std::min(header, coded.size())), coded.size());
  std::vector<std::uint8_t> block(sizes[1]);
  Size texts = 0;
  std::size_t at = 0;
  for (std::size_t k = words_before_sizes; k < sizes.size(); at += sizes[k++]) {
    uLongf length = block.size();
    if (at + sizes[k] > packed.size() ||
        uncompress(block.data(), &length, packed.data() + at, sizes[k]) != Z_OK)
      break;
    texts += Size(std::count(block.begin(), block.begin() + std::ptrdiff_t(length), 0));
  }
  return texts;
}

std::string wrong_with(std::string_view coded, const Form& form, const Declared& declared) {
  const Size stored = coded.size() / 4 * 3 + 3;  // at most
  const std::vector<Size> start = words_of(decoded(coded, words_before_sizes * form.word), form);
  if (start.size() < words_before_sizes) return "no compression header";
  const Size blocks = start[0], block = start[1], last = start[2];
  if (blocks > stored / form.word) return "more blocks than it has bytes";
  const std::vector<Size> sizes =
      words_of(decoded(coded, (words_before_sizes + blocks) * form.word), form);
  if (sizes.size() < words_before_sizes + blocks) return "a cut compression header";
  Size packed = 0;
  for (std::size_t k = words_before_sizes; k < sizes.size(); ++k) {
    if (sizes[k] > stored - packed) return "blocks longer than its text";
    packed += sizes[k];
  }
  const Size most = packed * form.expansion + small_bytes;
  const Size full = blocks == 0 || last == 0 ? blocks : blocks - 1;
  if (last > block || (block > 0 && full > most / block)) {
    return "blocks larger than their bytes can become";
  }
  const Size whole = full * block + (blocks == 0 ? 0 : last);
  if (whole < least_bytes(declared)) return "fewer bytes than values";
  if (!declared.texts || !form.zlib) return {};
  if (block > most_text_block) return "texts in a block of more than 16 MB";
  // VTK 9.1 stores every text that it finds, beyond the end of its array.
  return texts_in(coded, form, sizes) > declared.values ? "more texts than it declares" : "";
}

std::string first_wrong(vtkXMLDataElement* element, const Form& form, Size tuples) {
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* child = element->GetNestedElement(i);
    const std::string_view name = child->GetName() == nullptr ? "" : child->GetName();
    std::string wrong;
    if (name == "DataArray" || name == "Array") {
      // Without a format, VTK takes an array for text.
      if (attribute(child, "format") == "binary") {
        wrong = wrong_with(inline_text(child, form.text), form, declared_by(child, tuples));
      }
    } else {
      const bool of_points = name == "PointData" || name == "Points";
      const char* points = of_points ? element->GetAttribute("NumberOfPoints") : nullptr;
      wrong = first_wrong(child, form, points == nullptr ? 0 : std::strtoull(points, nullptr, 10));
    }
    if (!wrong.empty()) return wrong;
  }
  return {};
}

}  // namespace

std::string impossible_array(vtkXMLDataElement* root, std::string_view text) {
  if (root->GetAttribute("compressor") == nullptr) return {};
  return first_wrong(root, form_of(root, text), 0);
}

}  // namespace breast
