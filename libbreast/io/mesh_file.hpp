// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of a HexMesh as a VTKHDF file (schema "mesh/1"), with HDF5 only; see
// docs/file-formats.md.
#pragma once

#include <filesystem>

#include "mesh/hex_mesh.hpp"

namespace breast {

/// Parts that the reading tool needs; the reader refuses a file without them and names the tool
/// that makes them.
struct MeshNeeds {
  bool reference = false;  ///< stress-free shape (backward)
  bool geometry = false;   ///< Hermite sheets
  bool contact = false;    ///< compression record (compress)
};

/// Reads and checks everything (schema, shapes, ranges, finiteness, face sets cover the boundary);
/// fills content_sha256. Throws Error (input) naming file, dataset, index, value and bound.
HexMesh read_mesh(const std::filesystem::path& file, const MeshNeeds& needs = {});

/// Writes atomically. Throws Error (failed) if the disk fails or the mesh is inconsistent.
void write_mesh(const std::filesystem::path& file, const HexMesh& mesh);

}  // namespace breast
