// SPDX-License-Identifier: GPL-3.0-or-later
// Mutations of packed documents (io/hdf5/packed.hpp) that stay documents: bytes changed blindly nearly always break the packing, and
// nothing behind it is tried. Other inputs are mutated as libFuzzer does it.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>
#include <limits>
#include <random>

#include "core/error.hpp"
#include "io/hdf5/packed.hpp"

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace breast {

bool is_document_target();  // targets.cpp

namespace {

using Random = std::minstd_rand;
using Entries = std::map<std::string, Array>;

std::size_t below(Random& random, std::size_t count) {
  return count == 0 ? 0 : std::size_t(random()) % count;
}

template <class T>
void odd_value(std::vector<T>& list, Random& random) {
  if (list.empty()) return;
  T& value = list[below(random, list.size())];
  if constexpr (std::is_same_v<T, std::string>) {
    std::string longer = value + std::string(32, 'x');
    const std::size_t size = LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(longer.data()),
                                              value.size(), longer.size());
    value = longer.substr(0, size);
  } else if constexpr (std::is_floating_point_v<T>) {
    const T odd[] = {0,
                     T(-1),
                     std::numeric_limits<T>::quiet_NaN(),
                     std::numeric_limits<T>::infinity(),
                     std::numeric_limits<T>::max(),
                     std::numeric_limits<T>::denorm_min(),
                     T(1e6) + 1,
                     -value,
                     value * T(1.5)};
    value = odd[below(random, std::size(odd))];
  } else {
    const T odd[] = {0,
                     T(-1),
                     1,
                     2,
                     std::numeric_limits<T>::max(),
                     std::numeric_limits<T>::min(),
                     T(value ^ 1),
                     T(value / 2)};
    value = odd[below(random, std::size(odd))];
  }
}

template <class To>
void become(Array& array) {
  const std::size_t size = array.size();
  array.values = To(size);
}

void mutate_values(Array& array, Random& random) {
  std::visit(
      [&](auto& list) {
        using T = typename std::decay_t<decltype(list)>::value_type;
        if constexpr (!std::is_same_v<T, std::string>) {
          if (!list.empty() && below(random, 2) == 0) {  // the bytes, as many as before
            LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(list.data()), list.size() * sizeof(T),
                             list.size() * sizeof(T));
            return;
          }
        }
        odd_value(list, random);
      },
      array.values);
}

void mutate_size(Array& array, Random& random) {
  const std::size_t size = array.size(),
                    wanted[] = {0, 1, size + 1, size > 0 ? size - 1 : 0, 2 * size};
  const std::size_t chosen = std::min<std::size_t>(wanted[below(random, std::size(wanted))], 4096);
  std::visit([&](auto& list) { list.resize(chosen); }, array.values);
  array.shape = {chosen};
}

void mutate_type(Array& array, Random& random) {
  switch (below(random, 5)) {
    case 0:
      return become<Bytes>(array);
    case 1:
      return become<Integers>(array);
    case 2:
      return become<Floats>(array);
    case 3:
      return become<Doubles>(array);
    default:
      become<Texts>(array);
  }
}

void mutate_entry(Entries& list, Random& random) {
  if (list.empty()) return;
  auto entry = std::next(list.begin(), long(below(random, list.size())));
  auto& array = entry->second;
  switch (below(random, 12)) {
    case 0:
      list.erase(entry);
      return;
    case 1:
      array = std::next(list.begin(), long(below(random, list.size())))->second;
      return;
    case 2:
      list[entry->first + "/more"] = array;
      return;
    case 3:
      return mutate_type(array, random);
    case 4:
      return mutate_size(array, random);
    case 5:  // the same values in another shape
      std::reverse(array.shape.begin(), array.shape.end());
      if (below(random, 2) == 0) array.shape.insert(array.shape.begin(), 1);
      return;
    default:
      mutate_values(array, random);
  }
}

}  // namespace

}  // namespace breast

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  if (!breast::is_document_target()) return LLVMFuzzerMutate(data, size, most);
  breast::Random random(seed);
  constexpr std::size_t blind_one_in = 16;
  if (breast::below(random, blind_one_in) == 0) return LLVMFuzzerMutate(data, size, most);
  try {
    breast::Document document = breast::unpacked({reinterpret_cast<const char*>(data), size});
    for (std::size_t times = 1 + breast::below(random, 3); times > 0; --times) {
      breast::mutate_entry(breast::below(random, 3) == 0 ? document.attributes : document.datasets,
                           random);
    }
    const std::string bytes = breast::packed(document);
    if (bytes.size() <= most) {
      std::memcpy(data, bytes.data(), bytes.size());
      return bytes.size();
    }
  } catch (const breast::Error&) {
  }
  return LLVMFuzzerMutate(data, size, most);
}
