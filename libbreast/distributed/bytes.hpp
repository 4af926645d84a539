// SPDX-License-Identifier: GPL-3.0-or-later
// Serialisation of numbers and arrays of numbers as bytes, for messages between processes of the
// same build. One function describes a structure for both directions:
//
//     template <class Bytes> void pass(Bytes& bytes, Thing& thing) { bytes(thing.a), bytes(thing.b); }
#pragma once

#include <cstring>
#include <type_traits>
#include <vector>

#include "core/types.hpp"

namespace breast {

/// Whether a type may be copied byte by byte; small Eigen matrices consist of plain numbers as
/// well.
template <class T>
inline constexpr bool plain =
    std::is_trivially_copyable_v<T> || std::is_same_v<T, Vec3> || std::is_same_v<T, Mat3>;

class ByteWriter {
 public:
  static constexpr bool reads = false;
  template <class T>
  void operator()(const T& value) {
    static_assert(plain<T>);
    append(&value, sizeof(T));
  }
  template <class T>
  void operator()(const std::vector<T>& values) {
    static_assert(plain<T>);
    (*this)(values.size());
    append(values.data(), values.size() * sizeof(T));
  }
  std::vector<char> take() { return std::move(bytes_); }

 private:
  void append(const void* from, std::size_t size) {
    const char* first = static_cast<const char*>(from);
    bytes_.insert(bytes_.end(), first, first + size);
  }
  std::vector<char> bytes_;
};

/// Reads the values that a ByteWriter wrote, in the same order.
class ByteReader {
 public:
  static constexpr bool reads = true;
  explicit ByteReader(const std::vector<char>& bytes) : at_(bytes.data()) {}
  template <class T>
  void operator()(T& value) {
    static_assert(plain<T>);
    std::memcpy(static_cast<void*>(&value), at_, sizeof(T));
    at_ += sizeof(T);
  }
  template <class T>
  void operator()(std::vector<T>& values) {
    static_assert(plain<T>);
    std::size_t count = 0;
    (*this)(count);
    values.resize(count);
    if (count > 0) std::memcpy(static_cast<void*>(values.data()), at_, count * sizeof(T));
    at_ += count * sizeof(T);
  }

 private:
  const char* at_;
};

}  // namespace breast
