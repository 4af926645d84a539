// SPDX-License-Identifier: GPL-3.0-or-later
// Names of landmarks that mean something to the tools.
#pragma once

#include <string_view>

namespace breast {

/// A tumour that nobody found in the scan: hexmesh --tumour auto puts it on the gland's edge, to show
/// what the chain does. It keeps this name in every file, table and picture, so that it is never
/// taken for a finding; who asks a mesh for its "tumour" gets it too (HexMesh::landmark).
inline constexpr std::string_view artificial_tumour = "artificial_tumour";

}  // namespace breast
