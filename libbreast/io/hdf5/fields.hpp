// SPDX-License-Identifier: GPL-3.0-or-later
// Typed access to a Document: getters that check presence, type and shape, and the corresponding
// setters.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/provenance.hpp"
#include "io/hdf5/document.hpp"

namespace breast {

/// Creates the errors about one file with a common beginning and end of the message: input errors
/// when reading, failures when writing.
struct Complaint {
  ErrorKind kind = ErrorKind::input;
  std::string file;
  std::string advice;

  template <class... Parts>
  Error operator()(const Parts&... parts) const {
    return Error(kind, message(file, ": ", parts..., advice));
  }
};

class Fields {
 public:
  Fields(Document& document, const Complaint& complain)
      : document_(document), complain_(complain) {}

  bool has(const std::string& path) const { return document_.datasets.contains(path); }
  /// Whether any dataset or attribute lies under the group.
  bool has_group(const std::string& path) const;
  const Complaint& complain() const { return complain_; }

  // Datasets of the given shape; `any` leaves an extent open. Large ones are moved out of the
  // document.
  static constexpr std::size_t any = std::size_t(-1);
  using Shape = std::vector<std::size_t>;
  Bytes bytes(const std::string& path, const Shape& shape);
  Integers integers(const std::string& path, const Shape& shape);
  Floats floats(const std::string& path, const Shape& shape);
  Doubles doubles(const std::string& path, const Shape& shape);
  Texts texts(const std::string& path, const Shape& shape);
  std::vector<Vec3> vectors(const std::string& path, std::size_t count = any);  ///< (count, 3)
  /// Vectors that are positions in mm: values beyond `farthest_mm`, for which squares overflow and
  /// searches fail, are refused with their index.
  std::vector<Vec3> places(const std::string& path, std::size_t count = any);
  static constexpr double farthest_mm = 1e6;
  /// Integers in [low, high); others are refused with their index and value.
  std::vector<int> indices(const std::string& path, const Shape& shape, long low, long high);

  /// Checks presence and shape only; the dataset stays in place.
  void require(const std::string& path, const Shape& shape);
  /// The same for integers in [low, high), which are returned; others are refused with their index
  /// and value.
  const Integers& check_range(const std::string& path, const Shape& shape, std::int64_t low,
                              std::int64_t high);

  /// Checks that a name is suitable for tables and reports: not empty, no control character, no
  /// '/'.
  void check_name(const std::string& path, std::size_t index, const std::string& name) const;

  // Attributes.
  std::string text(const std::string& path);
  double number(const std::string& path);
  std::int64_t integer(const std::string& path);
  Doubles numbers(const std::string& path, std::size_t count);
  Integers integer_list(const std::string& path, std::size_t count);
  Vec3 vector(const std::string& path);
  Vec3 place(const std::string& path);  ///< within farthest_mm

 private:
  Array& find(std::map<std::string, Array>& list, const std::string& path, const Shape& shape,
              const char* what);
  Document& document_;
  const Complaint complain_;
};

// Setters.
Array array_of(const std::vector<Vec3>& vectors);
Array array_of(const Vec3& vector);
Array array_of(double value);
Array array_of(std::int64_t value);
Array array_of(const std::string& text);
Array array_of(Texts texts);
Array array_of(Doubles values);
Array array_of(Integers values);
Array array_of(Bytes values);
Array array_of(Floats values);
Array reshaped(Array array, std::vector<std::size_t> shape);

/// The attributes of /breast that every file has, and /breast/history.
struct FileHeader {
  std::string schema;
  Side side = Side::left;
  History history;
};
void put_header(Document& document, const FileHeader& header);
/// Reads side and history; checks units and orientation.
FileHeader get_header(Fields& fields);

}  // namespace breast
