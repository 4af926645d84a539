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
  continued = 0,  ///< nearly harmonic extrapolation, without flux through the border of the grid
  border = 1,  ///< within one cell outside the body: extrapolation of the adjacent elements' maps
  body = 2,    ///< vector of the element map itself
};

struct DisplacementField {
  Grid grid;
  std::vector<std::array<float, 3>> vectors;  ///< mm, LPS; i fastest, then j, then k
  std::vector<FieldPart> part;                ///< per grid point

  /// p + u(p) with u interpolated trilinearly; beyond the border of the grid, the vector of the
  /// border is used.
  Vec3 moved(const Vec3& point) const;
};

/// The field from the nodal positions `from` to `to` of one mesh. Throws Error (input) if no grid
/// point lies in the body.
DisplacementField displacement_field(const HexTopology& mesh, const std::vector<Vec3>& from,
                                     const std::vector<Vec3>& to, const Grid& grid,
                                     Progress& progress = no_progress(),
                                     const std::string& stage = "field");

/// The grid that covers all points of each shape and `margin` mm around them. Its points are those
/// of `lattice` (its voxels, continued at the same distances), or have a distance of `spacing` mm
/// along every axis if `spacing` is not 0.
Grid covering_grid(const Grid& lattice, const std::vector<const std::vector<Vec3>*>& shapes,
                   double margin, double spacing);

/// Extrapolates vectors from the grid points with a part other than `continued` to the others:
/// nearly harmonic, by nested iteration from coarse grids to fine ones.
void continue_field(DisplacementField& field);

}  // namespace breast
