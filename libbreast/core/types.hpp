// SPDX-License-Identifier: GPL-3.0-or-later
// The types that all folders share: small vectors, tissue codes, side of the body.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string_view>

namespace breast {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Tissue codes stored in every label volume and mesh (file-format contract).
enum class Tissue : std::uint8_t {
  air = 0,
  fat = 1,
  fibroglandular = 2,
  skin = 3,
  muscle = 4,  ///< chest wall: everything behind the pectoral surface
  tumour = 5,
  other = 6,
};
inline constexpr int n_tissues = 7;

/// Name used in tables, options and reports: "fat", "fibroglandular", ...
std::string_view tissue_name(Tissue tissue);
/// Inverse of tissue_name; throws Error (input) naming the choices.
Tissue tissue_from_name(std::string_view name);
/// True for the tissues that make up a breast: fat, fibroglandular, skin and tumour.
bool is_breast(Tissue tissue);

enum class Side { left, right };
std::string_view side_name(Side side);
Side side_from_name(std::string_view name);
/// +1 left, -1 right: the sign of patient x (LPS: x grows to the patient's left) on that side.
inline double lateral_sign(Side side) {
  return side == Side::left ? 1.0 : -1.0;
}

}  // namespace breast
