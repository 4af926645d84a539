// SPDX-License-Identifier: GPL-3.0-or-later
// The phantom's ground truth for the chain: labels, surfaces, landmarks, meshes.
#pragma once

#include <filesystem>

#include "core/table.hpp"
#include "image/label_volume.hpp"
#include "phantom/imaging.hpp"
#include "phantom/postures.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// Boundary faces of a mesh in the given nodal field, every quadrilateral cut into 2 n² triangles
/// (n = 4 for order 2, whose faces are curved). Normals of the triangles point out of the body.
TriMesh boundary_surface(const HexTopology& mesh, const std::vector<Vec3>& nodal,
                         const std::vector<Face>& faces);

/// One row per landmark of one side: landmark, side, then x y z (mm, LPS) stress-free, prone (mesh.imaged),
/// supine. Rows are appended to `table`, whose columns are set when it is empty.
void add_landmarks(const PhantomBreast& breast, const Postures& postures, Table& table);

/// The position of the tumour in the scan (mesh.points) in the form read by hexmesh --tumour: x_mm
/// y_mm z_mm.
Table tumour_place(const HexMesh& mesh);

/// Reports the solve of one breast and the displacements of its nipple and tumour, under "left/" or
/// "right/".
void report_breast(const PhantomBreast& breast, const Postures& postures, Report& report);

/// Volumes (ml) of the true labels by tissue name under "volumes_ml/".
void report_volumes(const LabelVolume& labels, const std::string& key, Report& report);

}  // namespace breast
