// SPDX-License-Identifier: GPL-3.0-or-later
// Position in the body of a spot that is marked in two views.
#pragma once

#include "core/report.hpp"
#include "matching/correspondence.hpp"

namespace breast {

/// A material point: element and local coordinates, valid in every shape of the mesh.
struct MaterialPoint {
  int element = -1;
  Vec3 local{0, 0, 0};
};

struct PairPoint {
  /// Closest approach of the two columns in the MR frame: a point on each.
  MaterialPoint on_first, on_second;
  double residual = 0;         ///< mm between the two, in the MR frame
  double first_to_second = 0;  ///< mm in the second image from its mark to the first mark's curve
  double second_to_first = 0;  ///< mm in the first image from its mark to the second mark's curve
  /// Midpoint of the two points in another shape of the mesh (imaged, reference, the points of a
  /// supine mesh).
  Vec3 position(const HexTopology& mesh, const std::vector<Vec3>& nodal) const;
};

/// `forward` maps the first view to the second, `backward` the second to the first. Throws Error
/// (input) when a mark lies in air.
PairPoint locate_pair(const Matcher& forward, const Matcher& backward, const Vec2& first,
                      const Vec2& second);

/// Reports the keys spot/residual_mm, spot/imaged, spot/reference, spot/VIEW ...
void report_spot(const PairPoint& pair, const Matcher& forward, Report& report);

}  // namespace breast
