// SPDX-License-Identifier: GPL-3.0-or-later
// Compression settings from the header of a mammogram that the simulation is to reproduce.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/types.hpp"
#include "mesh/view.hpp"

namespace breast {

/// Compression data of the header; the thickness measured by the machine is the target if present,
/// otherwise the force.
struct LikeMammogram {
  Side side = Side::left;
  std::optional<double> angle_deg, thickness_mm, force_N;
  std::vector<std::string> remarks;  ///< of the header
};
/// Throws Error (input) when the mammogram is of another view, when it states
/// neither thickness nor force, and, unless another `angle_deg` is chosen, when its angle is not one of
/// the view (more than 30 degrees from view_angle_deg).
LikeMammogram like_mammogram(const std::filesystem::path& file, View view,
                             const std::optional<double>& angle_deg = {});

}  // namespace breast
