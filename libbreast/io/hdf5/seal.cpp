// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5/seal.hpp"

#include <cstdint>
#include <cstring>

#include "core/error.hpp"
#include "core/sha256.hpp"

namespace breast {

namespace {

constexpr std::string_view signature("\x89HDF\r\n\x1a\n", 8);
constexpr std::string_view mark = "libbreast sha256";  // 16 bytes, then 64 digits
constexpr std::size_t seal_bytes = 80;

std::string digest(std::string_view content) {
  Sha256 hash;
  hash.update(content);
  return hash.hex();
}

std::uint64_t little_endian(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = value << 8 | std::uint8_t(bytes[i]);
  return value;
}

// End of the HDF5 data as the superblock states it, 0 when it cannot be told (HDF5 File Format
// Specification III.A: sizes of 8 bytes, which is what every platform of ours writes).
std::uint64_t stated_end(std::string_view content) {
  if (content.size() < 96) return 0;
  const int version = std::uint8_t(content[8]);
  const std::size_t size_at = version < 2 ? 13 : 9;
  if (std::uint8_t(content[size_at]) != 8) return 0;
  const std::size_t at = version == 0 ? 40 : version == 1 ? 44 : 28;
  return little_endian(content.substr(at, 8));
}

}  // namespace

std::string sealed(std::string content) {
  const std::string digits = digest(content);
  return content.append(mark).append(digits);
}

void check_seal(std::string_view view, const std::string& name, const std::string& advice) {
  if (view.substr(0, 8) != signature) {
    throw input_error(name, ": is not an HDF5 file (", view.size(), " bytes)", advice);
  }
  const std::uint64_t end = stated_end(view);
  if (end > view.size() || view.size() < 96) {
    throw input_error(name, ": is truncated at byte ", view.size(), " of ", end, advice);
  }
  if (view.size() == end) return;  // unsealed: written or edited by another program
  const std::size_t body = view.size() < seal_bytes ? 0 : view.size() - seal_bytes;
  if (view.substr(body, mark.size()) != mark) {
    throw input_error(name, ": is damaged: ", view.size(), " bytes where its header states ", end,
                      advice);
  }
  if (view.substr(body + mark.size()) != digest(view.substr(0, body))) {
    throw input_error(name, ": is damaged: its content disagrees with the digest at its end",
                      advice);
  }
}

}  // namespace breast
