// SPDX-License-Identifier: GPL-3.0-or-later
// Names of landmarks that have a meaning for the tools.
#pragma once

#include <string_view>

namespace breast {

/// A tumour that was not found in the scan: hexmesh --tumour auto places it at the edge of the
/// fibroglandular tissue to demonstrate the chain. It keeps this name in every file, table and
/// picture, so that it is never mistaken for a finding; asking a mesh for its "tumour" also returns
/// it (HexTopology::landmark).
inline constexpr std::string_view artificial_tumour = "artificial_tumour";

}  // namespace breast
