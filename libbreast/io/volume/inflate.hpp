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

/// Reads `file` from byte `start` to its end, through every gzip checksum. Stops, with an Error
/// (input), where it holds more than `most_bytes`: a small stream can inflate without end. Throws
/// Error (input) also for a cut or damaged stream.
Content content_from(const std::filesystem::path& file, std::streamoff start, double most_bytes);

/// The first bytes, at most 600: enough for a header.
std::vector<unsigned char> head_of(const std::filesystem::path& file);

}  // namespace breast
