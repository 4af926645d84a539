// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/types.hpp"

#include <array>
#include <string>

#include "core/error.hpp"

namespace breast {

namespace {
constexpr std::array<std::string_view, n_tissues> tissue_names = {
    "air", "fat", "fibroglandular", "skin", "muscle", "tumour", "other"};
}

std::string_view tissue_name(Tissue tissue) {
  const auto code = static_cast<std::size_t>(tissue);
  return code < tissue_names.size() ? tissue_names[code] : "unknown";
}

bool is_breast(Tissue tissue) {
  return tissue == Tissue::fat || tissue == Tissue::fibroglandular || tissue == Tissue::skin ||
         tissue == Tissue::tumour;
}

Tissue tissue_from_name(std::string_view name) {
  for (std::size_t code = 0; code < tissue_names.size(); ++code) {
    if (tissue_names[code] == name) return static_cast<Tissue>(code);
  }
  throw input_error("unknown tissue '", name,
                    "'; use one of air, fat, fibroglandular, skin, muscle, tumour, other");
}

std::string_view side_name(Side side) {
  return side == Side::left ? "left" : "right";
}

Side side_from_name(std::string_view name) {
  if (name == "left") return Side::left;
  if (name == "right") return Side::right;
  throw input_error("unknown side '", name, "'; use left or right");
}

}  // namespace breast
