// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing mesh files with derivatives of their shapes (sensitivity); see
// docs/file-formats.md.
#pragma once

#include "io/mesh_file.hpp"
#include "mesh/derivatives.hpp"

namespace breast {

/// Like write_mesh, with additional arrays, which other readers of the file ignore.
void write_mesh(const std::filesystem::path& file, const HexMesh& mesh,
                const Derivatives& derivatives);

/// The arrays of a file of `mesh`; empty when there are none. Throws Error
/// (input) for wrong shapes.
Derivatives read_derivatives(const std::filesystem::path& file, const HexMesh& mesh);

}  // namespace breast
