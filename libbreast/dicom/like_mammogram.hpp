// SPDX-License-Identifier: GPL-3.0-or-later
// Compression settings from the header of a mammogram that the simulation should imitate.
#pragma once

#include <filesystem>
#include <optional>

#include "dicom/mammogram_header.hpp"

namespace breast {

/// What the header gives of a compression; thickness is what the machine measured and is the target
/// when it is there, force otherwise.
struct LikeMammogram {
  std::optional<double> angle_deg, thickness_mm, force_N;
};
/// Throws Error (input) when the mammogram is of the other breast or another view, or when it tells
/// neither thickness nor force.
LikeMammogram like_mammogram(const std::filesystem::path& file, View view, Side side);

}  // namespace breast
