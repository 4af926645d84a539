// SPDX-License-Identifier: GPL-3.0-or-later
// The displacement between two shapes of a mesh, as vectors on a regular grid.
//
// Direction, by the convention of ITK and 3D Slicer: the vector u(p) at a grid point p maps p, a
// position in the first shape, to p + u(p), its position in the second. Slicer reads such a file as
// a transform "from parent": an image or a model of the *second* shape to which it is applied is
// shown in the *first*.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "image/volume.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// Origin of a grid point's vector.
enum class FieldPart : std::uint8_t {
  continued = 0,  ///< harmonic continuation of the rest, no flux through the grid's border
  border =
      1,  ///< outside within one cell of the body: the neighbouring elements' maps beyond their faces
  body = 2,  ///< the element map itself
};

struct DisplacementField {
  Grid grid;
  std::vector<std::array<float, 3>> vectors;  ///< mm, LPS; i fastest, then j, then k
  std::vector<FieldPart> part;                ///< per grid point

  /// p + u(p), u interpolated trilinearly; beyond the grid's border the border's vector holds.
  Vec3 moved(const Vec3& point) const;
};

/// From the nodal positions `from` to `to` of one mesh. Throws Error (input) where no grid point lies in the body.
DisplacementField displacement_field(const HexMesh& mesh, const std::vector<Vec3>& from,
                                     const std::vector<Vec3>& to, const Grid& grid,
                                     Progress& progress = no_progress(),
                                     const std::string& stage = "field");

/// The points of `lattice` (its voxels, and beyond them at the same distances) that cover all `points` of each list
/// and `margin` mm around. `spacing` mm (0: the lattice's own) sets the distance of grid points along every axis.
Grid covering_grid(const Grid& lattice, const std::vector<const std::vector<Vec3>*>& shapes,
                   double margin, double spacing);

/// Continues vectors from the grid points whose part is not `continued` to the others: nearly harmonic, by nested
/// iteration from coarse grids to fine ones.
void continue_field(DisplacementField& field);

}  // namespace breast
