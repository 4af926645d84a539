#include "page/page.hpp"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <set>
#include <span>
#include <string_view>

#include "core/error.hpp"
#include "core/table.hpp"
#include "projection/display.hpp"

namespace breast {

extern const char* const page_html;

namespace {

// Length of the UTF-8 character at the front, with its code; 0 for bytes that are none.
std::size_t front_character(std::string_view text, std::uint32_t& code) {
  const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const std::size_t length = byte(0) < 0x80 ? 1 : byte(0) >> 5 == 6 ? 2 : byte(0) >> 4 == 14 ? 3 : byte(0) >> 3 == 30 ? 4 : 0;
  if (length == 0 || length > text.size()) return 0;
  constexpr unsigned char bits[] = {0x7f, 0x7f, 0x1f, 0x0f, 0x07};
  code = byte(0) & bits[length];
  for (std::size_t k = 1; k < length; ++k) {
    if (byte(k) >> 6 != 2) return 0;
    code = code << 6 | (byte(k) & 0x3f);
  }
  return code < 0x110000 ? length : 0;
}

std::string escaped(std::uint32_t unit) {
  constexpr const char* digits = "0123456789abcdef";
  std::string out = "\\u";
  for (int shift = 12; shift >= 0; shift -= 4) out += digits[unit >> shift & 15];
  return out;
}

// A text as a JavaScript string inside an HTML page. Names come from files that anybody may have
// written: only letters, digits and the plainest signs stand as they are, so that no byte can end the
// string, the line or the script element.
std::string script_text(const std::string& text) {
  std::string out = "\"";
  for (std::string_view rest = text; !rest.empty();) {
    constexpr std::uint32_t replacement = 0xfffd, first_pair = 0x10000;
    std::uint32_t code = 0;
    const std::size_t length = front_character(rest, code);
    const char c = rest[0];
    if (length == 0) {
      out += escaped(replacement);
    } else if (code >= first_pair) {
      out += escaped(0xd800 + ((code - first_pair) >> 10)) + escaped(0xdc00 + ((code - first_pair) & 0x3ff));
    } else if (code < 0x80 && (std::isalnum(static_cast<unsigned char>(c)) || std::string_view(" -_.,:+()").find(c) != std::string_view::npos)) {
      out += c;
    } else {
      out += escaped(code);
    }
    rest.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out + '"';
}

std::string base64(std::span<const unsigned char> bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve(4 * ((bytes.size() + 2) / 3));
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto at = [&](std::size_t k) {
      return i + k < bytes.size() ? unsigned(bytes[i + k]) : 0u;
    };
    const unsigned three = at(0) << 16 | at(1) << 8 | at(2);
    for (int k = 0; k < 4; ++k) {
      text += i + std::size_t(k) < bytes.size() + 1 ? digits[three >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

template <class T>
std::string encoded(const std::vector<T>& values) {
  return '"' +
         base64(
             {reinterpret_cast<const unsigned char*>(values.data()), values.size() * sizeof(T)}) +
         '"';
}

// The picture as hung, 8 bits, every n-th pixel so that none is below a quarter millimetre.
std::string image_json(const Mammogram& image) {
  const HungImage hung = hang(image);
  const int skip = std::max(1, int(0.25 / image.pixel + 0.5));
  const int width = (hung.width + skip - 1) / skip, height = (hung.height + skip - 1) / skip;
  std::vector<std::uint8_t> grey;
  for (int row = 0; row < height; ++row) {
    for (int column = 0; column < width; ++column) {
      grey.push_back(std::uint8_t(hung.grey[std::size_t(row * skip) * std::size_t(hung.width) +
                                            std::size_t(column * skip)] >>
                                  8));
    }
  }
  return "{\"view\":" + script_text(view_name(image.view)) + ",\"width\":" + std::to_string(width) +
         ",\"height\":" + std::to_string(height) +
         ",\"pixel\":" + format_number(image.pixel * skip) +
         ",\"u_mm\":" + format_number(image.pixel * (image.width - 1)) +
         ",\"v_mm\":" + format_number(image.pixel * (image.height - 1)) +
         ",\"grey\":" + encoded(grey) + "}";
}

// Edges of the boundary's faces in the MR frame.
std::string body_json(const HexMesh& mesh) {
  std::set<std::pair<int, int>> edges;
  for (const auto* set : {&mesh.skin_faces, &mesh.pectoral_faces, &mesh.cut_faces}) {
    for (const Face& face : *set) {
      const std::vector<int> nodes = face_nodes(mesh, face);
      for (int k = 0; k < 4; ++k) {
        const int a = nodes[std::size_t(k)], b = nodes[std::size_t((k + 1) % 4)];
        edges.insert({std::min(a, b), std::max(a, b)});
      }
    }
  }
  std::vector<float> ends;
  for (const auto& [a, b] : edges) {
    for (const int node : {a, b}) {
      for (int k = 0; k < 3; ++k) ends.push_back(float(mesh.imaged[std::size_t(node)][k]));
    }
  }
  return encoded(ends);
}

void check_view(const Mammogram& image, View view, Side side) {
  if (image.view == view && image.side == side) return;
  throw input_error("the image shows ", view_name(image.view), " of the ", side_name(image.side),
                    " breast, the compression ", view_name(view), " of the ", side_name(side));
}

}  // namespace

std::string lookup_page(const MatchLookup& lookup, const Mammogram& from, const Mammogram& to,
                        const HexMesh& body) {
  check_view(from, lookup.from_view, lookup.side);
  check_view(to, lookup.to_view, lookup.side);
  std::string without;
  for (const std::string& name : lookup.band_without)
    without += (without.empty() ? "" : ", ") + name;
  const std::string data =
      "{\"side\":\"" + std::string(side_name(lookup.side)) +
      "\",\"pitch\":" + format_number(lookup.pitch) + ",\"nu\":" + std::to_string(lookup.nu) +
      ",\"nv\":" + std::to_string(lookup.nv) + ",\"samples\":" + std::to_string(lookup.samples) +
      ",\"status\":" + encoded(lookup.status) + ",\"depth\":" + encoded(lookup.depth) +
      ",\"curve\":" + encoded(lookup.curve) + ",\"deviation\":" + encoded(lookup.deviation) +
      ",\"across\":" + encoded(lookup.across) + ",\"imaged\":" + encoded(lookup.imaged) +
      ",\"from\":" + image_json(from) + ",\"to\":" + image_json(to) + ",\"band_without\":" +
      script_text(without) + ",\"body\":" + body_json(body) + "}";
  std::string page = page_html;
  const std::string mark = "\"DATA\"";
  page.replace(page.find(mark), mark.size(), data);
  return page;
}

}  // namespace breast
