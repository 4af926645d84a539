// SPDX-License-Identifier: GPL-3.0-or-later
// An HDF5 file of libbreast in memory: named arrays and attributes. All readers and writers work on
// this form; only load.cpp and save.cpp use HDF5.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/error.hpp"
#include "core/types.hpp"

namespace breast {

using Bytes = std::vector<std::uint8_t>;
using Integers = std::vector<std::int64_t>;
using Floats = std::vector<float>;
using Doubles = std::vector<double>;
using Texts = std::vector<std::string>;

/// Values in C order; shape {} is a scalar (attributes only).
struct Array {
  std::vector<std::size_t> shape;
  std::variant<Bytes, Integers, Floats, Doubles, Texts> values;

  std::size_t size() const;
};

/// "[17,2]" of a flat index in C order; empty for a scalar.
std::string index_text(std::size_t flat, const std::vector<std::size_t>& shape);

/// Datasets by path ("/VTKHDF/Points"); attributes by path of their group and name
/// ("/breast@schema").
struct Document {
  std::map<std::string, Array> datasets;
  std::map<std::string, Array> attributes;
};

/// Reads everything under /VTKHDF and /breast into memory. Throws Error (input), one line naming
/// file and dataset, for a file that is missing, truncated, changed since it was written, not HDF5
/// or of another schema, or that contains a non-finite value. `maker` is the tool that the message
/// recommends.
Document load_document(const std::filesystem::path& file, const std::string& schema,
                       const std::string& maker);

/// Writes atomically; the same document gives the same bytes. Refuses non-finite values.
void save_document(const std::filesystem::path& file, const Document& document);

/// SHA-256 of the content: every dataset and attribute except /breast/history, the tool and version
/// that wrote the file, wall_seconds and /breast/solve/seconds.
std::string content_sha256(const Document& document);

}  // namespace breast
