// SPDX-License-Identifier: GPL-3.0-or-later
// Number of bytes in a file, after inflation if it is gzip; private to io/volume.
#pragma once

#include <filesystem>
#include <vector>

namespace breast {

struct Content {
  double bytes = 0;
  bool compressed = false;
};

/// Reads `file` from byte `start` to its end, through every gzip checksum. Throws Error (input) if
/// it contains more than `most_bytes`, since a small stream can inflate without end, and for a
/// truncated or damaged stream.
Content content_from(const std::filesystem::path& file, std::streamoff start, double most_bytes);

/// The first bytes, at most 600: enough for a header.
std::vector<unsigned char> head_of(const std::filesystem::path& file);

}  // namespace breast
