// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5/fields.hpp"

namespace breast {

Array array_of(const std::vector<Vec3>& vectors) {
  Doubles flat;
  flat.reserve(3 * vectors.size());
  for (const Vec3& v : vectors) flat.insert(flat.end(), v.data(), v.data() + 3);
  return {{vectors.size(), 3}, std::move(flat)};
}
Array array_of(const Vec3& vector) {
  return {{3}, Doubles(vector.data(), vector.data() + 3)};
}
Array array_of(double value) {
  return {{}, Doubles{value}};
}
Array array_of(std::int64_t value) {
  return {{}, Integers{value}};
}
Array array_of(const std::string& text) {
  return {{}, Texts{text}};
}

namespace {
template <class List>
Array list_array(List values) {
  const std::size_t n = values.size();
  return {{n}, std::move(values)};
}
}  // namespace

Array array_of(Texts texts) {
  return list_array(std::move(texts));
}
Array array_of(Doubles values) {
  return list_array(std::move(values));
}
Array array_of(Integers values) {
  return list_array(std::move(values));
}
Array array_of(Bytes values) {
  return list_array(std::move(values));
}
Array array_of(Floats values) {
  return list_array(std::move(values));
}

Array reshaped(Array array, std::vector<std::size_t> shape) {
  array.shape = std::move(shape);
  return array;
}

}  // namespace breast
