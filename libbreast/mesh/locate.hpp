// SPDX-License-Identifier: GPL-3.0-or-later
// Point location: the element that contains a point and its local coordinates, for landmarks,
// mammograms and tissue lookup.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mesh/topology.hpp"
#include "surface/box_tree.hpp"

namespace breast {

/// A material point of a hexahedral mesh.
struct Location {
  int element = -1;
  Vec3 local{0, 0, 0};  ///< (ξ,η,ζ) in [-1,1]^3
  double moved = 0;     ///< mm from the requested point to the point found; 0 if inside
};

/// Point location in one nodal field (MeshShape::points, imaged or reference) of a mesh of order
/// 1 or 2: bounding-box tree over the elements (exact boxes: Bézier hulls for order 2), then Newton
/// on the isoparametric map to 1e-10. Copies the coordinates it needs; all queries are const and
/// may be made from many threads. A point on a shared face belongs to the lowest element number.
class Locator {
 public:
  /// Throws Error (input) when `nodal` does not have one finite point per node.
  Locator(const HexTopology& mesh, const std::vector<Vec3>& nodal);

  /// The element that contains `point`; no value if there is none. `hint` is tried first (the
  /// element of a neighbouring point, for walks along a ray); if the point is strictly inside it,
  /// the search ends at once.
  std::optional<Location> find(const Vec3& point, int hint = -1) const;
  /// Like find; for a point outside the mesh, the nearest point of the mesh, with the distance
  /// moved.
  Location nearest(const Vec3& point) const;
  /// Position of a local point of an element in this field.
  Vec3 position(int element, const Vec3& local) const;

  /// Bounding box of the mesh, mm.
  const Vec3& lower() const { return tree_.whole().min(); }
  const Vec3& upper() const { return tree_.whole().max(); }

 private:
  const Vec3* lattice(int element) const {
    return &coordinates_[std::size_t(element) * per_element_];
  }
  std::optional<Vec3> invert(int element, const Vec3& point) const;

  int order_of_mesh_ = 1;
  int per_element_ = 8;
  std::vector<Vec3> coordinates_;  ///< per element, lattice order (ξ fastest)
  BoxTree tree_;                   ///< of the elements
  double slack_ = 0;
};

/// The point of the given boundary faces nearest to `point` (nipple on the skin).
Location nearest_on_faces(const HexTopology& mesh, const std::vector<Vec3>& nodal,
                          const std::vector<Face>& faces, const Vec3& point);

/// The node nearest to `point`.
int nearest_node(const std::vector<Vec3>& nodal, const Vec3& point);

}  // namespace breast
