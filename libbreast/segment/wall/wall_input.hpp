// SPDX-License-Identifier: GPL-3.0-or-later
// Manual correction of the chest wall from a label map, clicked points or a surface.
#pragma once

#include <string>
#include <vector>

#include "image/label_volume.hpp"
#include "segment/wall/chest_wall.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// Replaces the wall where the label map (codes as Tissue; muscle = 4) has muscle in the column.
/// Returns the share of the domain's columns replaced.
double apply_wall_labels(ChestWall& wall, const WallDomain& domain, const Grid& grid,
                         const Volume<float>& labels);
/// Behind the muscle of the label map, where it has a back (other tissue for at least 2 mm), muscle of the labels
/// becomes `other`. Returns the share of the columns with muscle in both in which it has one.
double end_muscle(LabelVolume& labels, const Volume<float>& given);
/// Moves the wall to clicked points (patient mm) by a thin-plate spline of the corrections, which
/// are zero farther than 50 mm from every point. More than 400 points are averaged in cells of 8
/// mm. Throws Error (input) for a point beside the domain.
void apply_wall_points(ChestWall& wall, const WallDomain& domain, const Grid& grid,
                       const std::vector<Vec3>& points);
/// Moves the wall to a surface given by its points (patient mm): the mean point of every cell of 8
/// mm counts as a clicked one; points outside the domain are ignored. Throws Error (input) if no
/// point is left.
void apply_wall_surface(ChestWall& wall, const WallDomain& domain, const Grid& grid,
                        const std::vector<Vec3>& points);

/// Points of a chest-wall surface; of the data points of a segmentation (scalar "surface") only
/// those marked as chest wall. Throws Error (input) with the name `name` if there are none.
std::vector<Vec3> wall_surface_points(const TriMesh& surface, const std::string& name);

}  // namespace breast
