// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/own_file.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/table.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t head_bytes = std::size_t(1) << 20, tail_bytes = 256;
constexpr std::string_view png_signature("\x89PNG\r\n\x1a\n", 8);
constexpr std::string_view hdf5_signature("\x89HDF\r\n\x1a\n", 8);

bool holds(std::string_view text, std::string_view what) {
  return text.find(what) != std::string_view::npos;
}

struct Ends {
  std::string head, tail;  ///< the first megabyte and the last bytes
};

Ends ends_of(const fs::path& file, std::uintmax_t size) {
  std::ifstream in(file, std::ios::binary);
  Ends ends;
  const auto read = [&](std::string& text, std::uintmax_t from, std::uintmax_t count) {
    text.resize(std::size_t(count));
    in.clear();
    in.seekg(std::streamoff(from));
    in.read(text.data(), std::streamsize(count));
    text.resize(std::size_t(std::max<std::streamsize>(in.gcount(), 0)));
  };
  read(ends.head, 0, std::min<std::uintmax_t>(size, head_bytes));
  const std::uintmax_t last = std::min<std::uintmax_t>(size, tail_bytes);
  read(ends.tail, size - last, last);
  return ends;
}

bool begins_report(std::string_view head) {
  const std::size_t first = head.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos || head[first] != '{') return false;
  const std::size_t key = head.find_first_not_of(" \t\r\n", first + 1);
  return key != std::string_view::npos && head.substr(key).starts_with("\"tool\"");
}

std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = 0xffffffff;
  for (const char c : bytes) {
    crc ^= std::uint8_t(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320 : crc >> 1;
  }
  return ~crc;
}

std::string big_endian(std::uint32_t value) {
  return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

}  // namespace

bool written_by_us(const fs::path& file) {
  std::error_code reason;
  const std::uintmax_t size = fs::file_size(file, reason);
  if (reason) return false;
  if (size == 0) return true;
  const auto [head, tail] = ends_of(file, size);
  const std::string_view front = std::string_view(head).substr(0, 4096);
  if (front.starts_with(hdf5_signature)) {
    return holds(tail, "libbreast sha256") || (holds(head, "breast") && holds(head, "mm-g-s"));
  }
  if (holds(front, "<VTKFile")) {
    return holds(tail, "<!-- sha256 of everything above") || holds(head, "Name=\"history\"");
  }
  const bool has_place_for_mark =
      front.starts_with(png_signature) || front.starts_with("NRRD") ||
      front.starts_with("\x1f\x8b") || front.starts_with("ObjectType") ||
      (front.size() > 348 && (front.substr(344, 3) == "n+1" || front.substr(344, 3) == "ni1")) ||
      (front.size() > 132 && front.substr(128, 4) == "DICM") || front.starts_with("**") ||
      front.starts_with("<?xml") || front.starts_with("<!DOCTYPE") ||
      front.starts_with("<!doctype");
  if (has_place_for_mark) return holds(front, maker_mark);
  return begins_report(front) || closes_table(tail);
}

void check_replaceable(const fs::path& target, const std::string& label) {
  std::error_code ignored;
  if (!fs::exists(target, ignored) || is_stream(target) || written_by_us(target)) return;
  throw input_error(label, ": ", target.string(),
                    " exists and does not look like a result of libbreast, so that it is not "
                    "replaced: give another output, or remove it");
}

std::string marked_png(std::string_view png) {
  constexpr std::size_t header_end = 33;  // signature, and IHDR, which is always the first chunk
  if (!png.starts_with(png_signature) || png.size() < header_end) {
    throw failed_error("a picture could not be encoded as PNG");
  }
  const std::string text = "tEXtSoftware" + std::string(1, '\0') + std::string(maker_mark);
  std::string marked(png.substr(0, header_end));
  marked += big_endian(std::uint32_t(text.size() - 4)) + text + big_endian(crc32(text));
  return marked.append(png.substr(header_end));
}

}  // namespace breast
