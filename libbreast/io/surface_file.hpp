// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of surfaces, point sets and curves as VTK .vtp, with VTK.
#pragma once

#include <filesystem>

#include "surface/tri_mesh.hpp"

namespace breast {

TriMesh read_surface(const std::filesystem::path& file);
void write_surface(const std::filesystem::path& file, const TriMesh& surface);
PolyLines read_polylines(const std::filesystem::path& file);
void write_polylines(const std::filesystem::path& file, const PolyLines& lines);

}  // namespace breast
