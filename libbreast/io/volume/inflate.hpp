// SPDX-License-Identifier: GPL-3.0-or-later
// Number of bytes in a file, after inflation if it is compressed; private to io.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace breast {

enum class Packing { none, gzip, zlib };

struct Content {
  double bytes = 0;  ///< unpacked
  Packing packing = Packing::none;
};

/// The content of `file` from byte `start` to its end. A gzip or zlib stream is inflated through every
/// checksum; it has infinite bytes if it holds more than `most_bytes`, since a small stream can inflate
/// without end. Anything else counts as it is. `kept` receives the bytes, if there are
/// no more than `most_bytes`. Throws Error (input) for a truncated or damaged stream.
Content inflated_content(const std::filesystem::path& file, std::streamoff start, double most_bytes,
                         std::string* kept = nullptr);

/// The bytes of a raw deflate stream (RFC 1951) from byte `start` of `file`, as in deflated DICOM; what
/// follows it counts as padding. Throws Error (input) for a truncated or damaged stream, and for one of more than `most_bytes`.
std::string inflated_bytes(const std::filesystem::path& file, std::streamoff start,
                           double most_bytes);

/// The first bytes, at most 600: enough for a header.
std::vector<unsigned char> head_of(const std::filesystem::path& file);

}  // namespace breast
