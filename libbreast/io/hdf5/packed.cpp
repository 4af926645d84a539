// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5/packed.hpp"

#include <cstring>

namespace breast {

namespace {

void put(std::string& out, std::uint64_t number) {
  out.append(reinterpret_cast<const char*>(&number), sizeof number);
}

void put(std::string& out, std::string_view text) {
  put(out, text.size());
  out.append(text);
}

void put(std::string& out, const Array& array) {
  put(out, array.shape.size());
  for (const std::size_t extent : array.shape) put(out, extent);
  put(out, array.values.index());
  put(out, array.size());
  std::visit(
      [&](const auto& values) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        if constexpr (std::is_same_v<T, std::string>) {
          for (const std::string& text : values) put(out, std::string_view(text));
        } else {
          out.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        }
      },
      array.values);
}

class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : rest_(bytes) {}

  std::size_t number() {
    std::uint64_t value = 0;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return std::size_t(value);
  }
  std::string text() { return std::string(take(number())); }

  Array array() {
    Array out;
    out.shape.resize(counted(1));
    for (std::size_t& extent : out.shape) extent = number();
    const std::size_t kind = number();
    switch (kind) {
      case 0:
        out.values = plain<Bytes>();
        break;
      case 1:
        out.values = plain<Integers>();
        break;
      case 2:
        out.values = plain<Floats>();
        break;
      case 3:
        out.values = plain<Doubles>();
        break;
      default: {
        Texts texts(counted(sizeof(std::uint64_t)));
        for (std::string& one : texts) one = text();
        out.values = std::move(texts);
      }
    }
    double values = 1;
    for (const std::size_t extent : out.shape) values *= double(extent);
    if (values != double(out.size()))
      throw failed_error("a packed document's shape is not its size");
    return out;
  }

  std::map<std::string, Array> list() {
    std::map<std::string, Array> out;
    for (std::size_t left = number(); left > 0; --left) {
      std::string path = text();
      out[std::move(path)] = array();
    }
    return out;
  }

 private:
  std::string_view take(std::size_t size) {
    if (size > rest_.size()) throw failed_error("a packed document is cut");
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }
  // A count of things that take at least `width` bytes each.
  std::size_t counted(std::size_t width) {
    const std::size_t count = number();
    if (count > rest_.size() / width) throw failed_error("a packed document is cut");
    return count;
  }
  template <class List>
  List plain() {
    constexpr std::size_t width = sizeof(typename List::value_type);
    List list(counted(width));
    const std::string_view bytes = take(list.size() * width);
    if (!bytes.empty()) std::memcpy(list.data(), bytes.data(), bytes.size());
    return list;
  }

  std::string_view rest_;
};

}  // namespace

std::string packed(const Document& document) {
  std::string out;
  for (const auto* list : {&document.datasets, &document.attributes}) {
    put(out, list->size());
    for (const auto& [path, array] : *list) {
      put(out, std::string_view(path));
      put(out, array);
    }
  }
  return out;
}

Document unpacked(std::string_view bytes) {
  Unpacker in(bytes);
  Document document;
  document.datasets = in.list();
  document.attributes = in.list();
  return document;
}

}  // namespace breast
