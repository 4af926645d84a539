// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5/fields.hpp"

#include <algorithm>

namespace breast {

namespace {

std::string show(const std::vector<std::size_t>& shape) {
  std::string text = "(";
  for (const std::size_t n : shape) {
    text +=
        (text.size() > 1 ? "," : "") + (n == Fields::any ? std::string("n") : std::to_string(n));
  }
  return text + ")";
}

bool fits(const std::vector<std::size_t>& shape, const std::vector<std::size_t>& wanted) {
  if (shape.size() != wanted.size()) return false;
  for (std::size_t d = 0; d < shape.size(); ++d) {
    if (wanted[d] != Fields::any && wanted[d] != shape[d]) return false;
  }
  return true;
}

// An attribute of one value may be stored as a scalar or as an array of one.
const std::vector<std::size_t> scalar = {};

}  // namespace

bool Fields::has_group(const std::string& path) const {
  const auto below = [&](const auto& list, char separator) {
    const auto next = list.lower_bound(path + separator);
    return next != list.end() && next->first.starts_with(path + separator);
  };
  return below(document_.datasets, '/') || below(document_.attributes, '@') ||
         below(document_.attributes, '/');
}

Array& Fields::find(std::map<std::string, Array>& list, const std::string& path, const Shape& shape,
                    const char* what) {
  const auto found = list.find(path);
  if (found == list.end()) throw complain_(what, " ", path, " is missing");
  Array& array = found->second;
  const bool one = shape.empty() && array.shape == std::vector<std::size_t>{1};
  if (!one && !fits(array.shape, shape)) {
    throw complain_(what, " ", path, " has shape ", show(array.shape), ", must be ", show(shape));
  }
  return array;
}

Bytes Fields::bytes(const std::string& path, const Shape& shape) {
  Array& array = find(document_.datasets, path, shape, "dataset");
  if (auto* list = std::get_if<Bytes>(&array.values)) return std::move(*list);
  throw complain_("dataset ", path, " must hold unsigned 8-bit integers");
}

Integers Fields::integers(const std::string& path, const Shape& shape) {
  Array& array = find(document_.datasets, path, shape, "dataset");
  if (auto* list = std::get_if<Integers>(&array.values)) return std::move(*list);
  if (auto* list = std::get_if<Bytes>(&array.values)) return {list->begin(), list->end()};
  throw complain_("dataset ", path, " must hold integers");
}

Floats Fields::floats(const std::string& path, const Shape& shape) {
  Array& array = find(document_.datasets, path, shape, "dataset");
  if (auto* list = std::get_if<Floats>(&array.values)) return std::move(*list);
  throw complain_("dataset ", path, " must hold 32-bit floating-point numbers");
}

Doubles Fields::doubles(const std::string& path, const Shape& shape) {
  Array& array = find(document_.datasets, path, shape, "dataset");
  if (auto* list = std::get_if<Doubles>(&array.values)) return std::move(*list);
  if (auto* list = std::get_if<Floats>(&array.values)) return {list->begin(), list->end()};
  throw complain_("dataset ", path, " must hold floating-point numbers");
}

Texts Fields::texts(const std::string& path, const Shape& shape) {
  Array& array = find(document_.datasets, path, shape, "dataset");
  if (auto* list = std::get_if<Texts>(&array.values)) return std::move(*list);
  throw complain_("dataset ", path, " must hold texts");
}

std::vector<Vec3> Fields::vectors(const std::string& path, std::size_t count) {
  const Doubles flat = doubles(path, {count, 3});
  std::vector<Vec3> list(flat.size() / 3);
  for (std::size_t i = 0; i < list.size(); ++i) {
    list[i] = {flat[3 * i], flat[3 * i + 1], flat[3 * i + 2]};
  }
  return list;
}

std::vector<Vec3> Fields::places(const std::string& path, std::size_t count) {
  std::vector<Vec3> list = vectors(path, count);
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].cwiseAbs().maxCoeff() <= farthest_mm) continue;
    throw complain_("dataset ", path, "[", i, "] is ", list[i].transpose(), " mm, must be within ",
                    farthest_mm);
  }
  return list;
}

void Fields::check_name(const std::string& path, std::size_t index, const std::string& name) const {
  const bool odd = std::any_of(name.begin(), name.end(),
                               [](unsigned char c) { return c < ' ' || c == 0x7f || c == '/'; });
  if (!name.empty() && !odd) return;
  throw complain_("dataset ", path, "[", index, "] is ", name.empty() ? "empty" : "no name",
                  ", must be a name without '/' and control characters");
}

void Fields::require(const std::string& path, const Shape& shape) {
  find(document_.datasets, path, shape, "dataset");
}

const Integers& Fields::check_range(const std::string& path, const Shape& shape, std::int64_t low,
                                    std::int64_t high) {
  Array& array = find(document_.datasets, path, shape, "dataset");
  if (const auto* list = std::get_if<Bytes>(&array.values)) {
    array.values = Integers(list->begin(), list->end());
  }
  const auto* values = std::get_if<Integers>(&array.values);
  if (!values) throw complain_("dataset ", path, " must hold integers");
  for (std::size_t i = 0; i < values->size(); ++i) {
    const std::int64_t value = (*values)[i];
    if (value >= low && value < high) continue;
    throw complain_("dataset ", path, index_text(i, array.shape), " is ", value, ", must be ", low,
                    " to ", high - 1);
  }
  return *values;
}

std::vector<int> Fields::indices(const std::string& path, const Shape& shape, long low, long high) {
  const Integers& values = check_range(path, shape, low, high);
  return {values.begin(), values.end()};
}

std::string Fields::text(const std::string& path) {
  const Array& array = find(document_.attributes, path, scalar, "attribute");
  if (const auto* list = std::get_if<Texts>(&array.values)) return list->front();
  throw complain_("attribute ", path, " must be a text");
}

double Fields::number(const std::string& path) {
  const Array& array = find(document_.attributes, path, scalar, "attribute");
  if (const auto* list = std::get_if<Doubles>(&array.values)) return list->front();
  throw complain_("attribute ", path, " must be a 64-bit floating-point number");
}

std::int64_t Fields::integer(const std::string& path) {
  const Array& array = find(document_.attributes, path, scalar, "attribute");
  if (const auto* list = std::get_if<Integers>(&array.values)) return list->front();
  throw complain_("attribute ", path, " must be a 64-bit integer");
}

Doubles Fields::numbers(const std::string& path, std::size_t count) {
  const Array& array = find(document_.attributes, path, {count}, "attribute");
  if (const auto* list = std::get_if<Doubles>(&array.values)) return *list;
  throw complain_("attribute ", path, " must hold 64-bit floating-point numbers");
}

Integers Fields::integer_list(const std::string& path, std::size_t count) {
  const Array& array = find(document_.attributes, path, {count}, "attribute");
  if (const auto* list = std::get_if<Integers>(&array.values)) return *list;
  throw complain_("attribute ", path, " must hold integers");
}

Vec3 Fields::vector(const std::string& path) {
  const Doubles values = numbers(path, 3);
  return {values[0], values[1], values[2]};
}

Vec3 Fields::place(const std::string& path) {
  const Vec3 at = vector(path);
  if (at.cwiseAbs().maxCoeff() <= farthest_mm) return at;
  throw complain_("attribute ", path, " is ", at.transpose(), " mm, must be within ", farthest_mm);
}

}  // namespace breast
