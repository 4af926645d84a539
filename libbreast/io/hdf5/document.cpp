// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5/document.hpp"

#include <algorithm>
#include <cstring>

#include "core/parallel.hpp"
#include "core/sha256.hpp"

namespace breast {

namespace {

constexpr std::size_t block_bytes = std::size_t(1) << 20;

struct Raw {
  const char* type;
  const void* data;
  std::size_t bytes;
};

template <class T>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<T, std::uint8_t>) return "uint8";
  if constexpr (std::is_same_v<T, std::int64_t>) return "int64";
  if constexpr (std::is_same_v<T, float>) return "float32";
  if constexpr (std::is_same_v<T, double>) return "float64";
  return "text";
}

// Blocks of a megabyte are hashed side by side, then their digests in order: the result does not
// depend on the number of threads.
std::string hash_bytes(const void* data, std::size_t bytes) {
  const auto* first = static_cast<const char*>(data);
  const long blocks = long((bytes + block_bytes - 1) / block_bytes);
  std::vector<std::string> digests(static_cast<std::size_t>(blocks));
#pragma omp parallel for num_threads(threads()) schedule(dynamic) if (blocks > 1)
  for (long b = 0; b < blocks; ++b) {
    const std::size_t start = std::size_t(b) * block_bytes;
    Sha256 hash;
    hash.update(first + start, std::min(block_bytes, bytes - start));
    digests[std::size_t(b)] = hash.hex();
  }
  Sha256 all;
  for (const std::string& digest : digests) all.update(digest);
  return all.hex();
}

std::string hash_array(const Array& array) {
  std::string head;
  for (const std::size_t n : array.shape) head += std::to_string(n) + " ";
  return std::visit(
      [&](const auto& values) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        head = std::string(type_name<T>()) + " " + head;
        if constexpr (std::is_same_v<T, std::string>) {
          std::string joined;
          for (const std::string& text : values) joined += text + '\0';
          return head + hash_bytes(joined.data(), joined.size());
        } else {
          return head + hash_bytes(values.data(), values.size() * sizeof(T));
        }
      },
      array.values);
}

bool is_content(const std::string& path) {
  return !path.starts_with("/breast/history") && path != "/VTKHDF/FieldData/wall_seconds" &&
         path != "/breast/solve/seconds" && path != "/breast@tool" && path != "/breast@version";
}

}  // namespace

std::size_t Array::size() const {
  return std::visit([](const auto& list) { return list.size(); }, values);
}

std::string index_text(std::size_t flat, const std::vector<std::size_t>& shape) {
  std::string text;
  for (std::size_t d = shape.size(); d-- > 0;) {
    text = std::to_string(flat % shape[d]) + (text.empty() ? "" : ",") + text;
    flat /= shape[d];
  }
  return shape.empty() ? "" : "[" + text + "]";
}

std::string content_sha256(const Document& document) {
  Sha256 hash;
  for (const auto* list : {&document.datasets, &document.attributes}) {
    for (const auto& [path, array] : *list) {
      if (is_content(path)) hash.update(path + "\n" + hash_array(array) + "\n");
    }
  }
  return hash.hex();
}

}  // namespace breast
