// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdint>

#include "core/table.hpp"
#include "page/parts.hpp"
#include "page/script_text.hpp"
#include "projection/display.hpp"

namespace breast {

namespace {

constexpr double finest_pixel = 0.25;  // mm

struct Shown {
  int width = 0, height = 0;
  std::vector<std::uint16_t> grey;
};

Shown thinned(const HungImage& hung, int skip) {
  Shown shown{(hung.width + skip - 1) / skip, (hung.height + skip - 1) / skip, {}};
  for (int row = 0; row < hung.height; row += skip) {
    for (int column = 0; column < hung.width; column += skip) {
      shown.grey.push_back(
          hung.grey[std::size_t(row) * std::size_t(hung.width) + std::size_t(column)]);
    }
  }
  return shown;
}

// The landmarks that the page marks in the image, with their names in the mesh.
std::string landmarks_json(const ViewPose& pose, const HexMesh& compressed) {
  std::string list;
  for (const char* name : {"nipple", "tumour"}) {
    const Landmark* landmark = compressed.landmark(name);
    if (landmark == nullptr) continue;
    const Vec2 uv = pose.project(landmark_position(compressed, compressed.points, *landmark));
    list += (list.empty() ? "" : ",") + ("{\"name\":" + script_text(landmark->name)) +
            ",\"at\":" + numbers_json({uv.x(), uv.y()}) + "}";
  }
  return "[" + list + "]";
}

}  // namespace

std::string image_json(const Mammogram& image, const HexMesh& compressed) {
  const int skip = std::max(1, int(finest_pixel / image.pixel + 0.5));
  const Shown shown = thinned(hang(image), skip);
  return "{\"view\":" + script_text(view_name(image.view)) +
         ",\"width\":" + std::to_string(shown.width) +
         ",\"height\":" + std::to_string(shown.height) +
         ",\"pixel\":" + format_number(image.pixel * skip) +
         ",\"u_mm\":" + format_number(image.pixel * (image.width - 1)) +
         ",\"v_mm\":" + format_number(image.pixel * (image.height - 1)) +
         ",\"landmarks\":" + landmarks_json(image.pose, compressed) +
         ",\"grey\":" + script_array(shown.grey) + "}";
}

}  // namespace breast
