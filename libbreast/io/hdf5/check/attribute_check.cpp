// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5/check/attribute_check.hpp"

#include <vector>

#include "core/error.hpp"

namespace breast {

namespace {

using Size = std::uint64_t;

/// A little-endian integer of `bytes` bytes; what lies beyond the end counts as 0.
Size integer(std::string_view data, Size at, int bytes) {
  Size value = 0;
  for (int b = bytes - 1; b >= 0; --b) {
    const Size place = at + Size(b);
    value = value << 8 | (place < data.size() ? Size(static_cast<unsigned char>(data[place])) : 0);
  }
  return value;
}

/// Bytes of an attribute's values by its dataspace and the size of one; `most` + 1 when that is more than `most`.
Size bytes_of_values(std::string_view space, Size one, Size most) {
  constexpr Size null_space = 2;
  const bool old = integer(space, 0, 1) == 1;
  if (!old && integer(space, 3, 1) == null_space) return 0;
  const Size rank = integer(space, 1, 1), first = old ? 8 : 4;
  if (first + 8 * rank > space.size()) return most + 1;
  Size bytes = one;
  for (Size d = 0; d < rank; ++d) {
    const Size extent = integer(space, first + 8 * d, 8);
    if (extent == 0) return 0;
    if (bytes > most / extent) return most + 1;
    bytes *= extent;
  }
  return bytes;
}

/// Bytes that the description of a datatype takes at least; 0 for one that is neither number nor text.
Size bytes_of_type(std::string_view type, bool inner = false) {
  enum Class : Size { fixed_point = 0, floating_point = 1, string = 3, variable_length = 9 };
  constexpr Size head = 8;
  switch (integer(type, 0, 1) & 15) {
    case fixed_point:
      return head + 4;
    case floating_point:
      return head + 12;
    case string:
      return head;
    case variable_length: {
      const Size of = inner || type.size() < head ? 0 : bytes_of_type(type.substr(head), true);
      return of == 0 ? 0 : head + of;
    }
    default:
      return 0;
  }
}

/// The message of one attribute, whose parts follow each other: name, datatype, dataspace, values.
std::string wrong_attribute(std::string_view message) {
  const Size version = integer(message, 0, 1);
  if (version < 1 || version > 3) return "an attribute is of an unknown version";
  if (version > 1 && integer(message, 1, 1) != 0) return "an attribute shares its type";
  const auto padded = [&](Size bytes) { return version == 1 ? (bytes + 7) / 8 * 8 : bytes; };
  const Size name = integer(message, 2, 2), type = integer(message, 4, 2),
             space = integer(message, 6, 2);
  const Size begin = version == 3 ? 9 : 8, type_at = begin + padded(name),
             space_at = type_at + padded(type), values_at = space_at + padded(space);
  constexpr Size least_type = 8, least_space = 4;
  if (values_at > message.size() || type < least_type || space < least_space)
    return "an attribute is longer than its message";
  if (name == 0 || message[begin + name - 1] != '\0') return "the name of an attribute has no end";
  const std::string called(message.substr(begin, name - 1));
  const Size described = bytes_of_type(message.substr(type_at, type));
  if (described == 0) return "attribute " + called + " is neither number nor text";
  const Size one = integer(message, type_at + 4, 4), left = message.size() - values_at;
  if (type < described || bytes_of_values(message.substr(space_at, space), one, left) > left)
    return "the values of attribute " + called + " are longer than its message";
  return {};
}

}  // namespace

std::string wrong_attributes(std::string_view file, std::uint64_t header) {
  constexpr Size prefix = 16, head = 8;  // of the header and of a message
  constexpr Size continuation = 16, attribute = 12;
  struct Block {
    Size at, bytes;
  };
  if (header >= file.size() || file[header] != 1) return {};
  std::vector<Block> blocks{{header + prefix, integer(file, header + 8, 4)}};
  Size walked = 0;  // blocks may point at each other
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const auto [at, bytes] = blocks[b];
    if (at > file.size() || bytes > file.size() - at || bytes > file.size() - walked)
      return "a list of attributes is longer than the file";
    walked += bytes;
    const std::string_view block = file.substr(at, bytes);
    for (Size place = 0; place + head <= block.size();) {
      const Size type = integer(block, place, 2), size = integer(block, place + 2, 2);
      const bool shared = integer(block, place + 4, 1) & 2;
      if (size > block.size() - place - head) return "a message is longer than its header";
      const std::string_view message = block.substr(place + head, size);
      if (type == continuation) blocks.push_back({integer(message, 0, 8), integer(message, 8, 8)});
      const std::string wrong = type != attribute ? ""
                                : shared          ? "an attribute is shared"
                                                  : wrong_attribute(message);
      if (!wrong.empty()) return wrong;
      place += head + size;
    }
  }
  return {};
}

}  // namespace breast
