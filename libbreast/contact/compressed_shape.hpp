// SPDX-License-Identifier: GPL-3.0-or-later
// What is measured on a compressed shape: the share of the breast in front of the image's edge, contact
// with itself or with the thorax beside its base, which the equations do not prevent, and strains.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <vector>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// Shares of the whole breast without the muscle behind it, in percent.
struct Coverage {
  double volume = 0;
  std::optional<double> fibroglandular;  ///< absent if there is no such tissue
};

/// Coverage of the shape `x` (3 per node, mm) in front of the start of the plate's rounded edge,
/// from 2×2×2 Gauss points per element, each weighted by its share of the deformed volume.
Coverage coverage(const HexTopology& mesh, const Eigen::VectorXd& x, const Plate& plate);

/// Area of the breast's projection along the beam in front of the edge, cm², in the shape `x` (one
/// position per node, mm): half of ∫ |n·dA| over the skin there, exact where every ray enters and
/// leaves once.
double projected_cm2(const HexTopology& mesh, const std::vector<Vec3>& x, const Plate& plate);

/// How far the muscle reaches in front of the start of the plate's rounded edge, mm, in the row of the image through
/// `at` (negative: it ends behind the edge), in the shape `x`. No value for a mesh without a layer of muscle, or whose
/// muscle does not reach that row.
std::optional<double> muscle_in_front(const HexTopology& mesh, const std::vector<Vec3>& x,
                                      const Plate& plate, const Vec3& at);

struct SelfContact {
  /// Area of the free boundary that has other parts of the body less than half a millimetre in
  /// front of it, or penetrating it, cm².
  double itself_cm2 = 0;
  /// Greatest depth to which the free boundary penetrates the chest-wall surface, mm; 0 without
  /// such a surface.
  double into_thorax_mm = 0;
};

/// Self-contact of the shape `x` (one position per node, mm), at 2×2 points of every skin and cut
/// face.
SelfContact self_contact(const HexMesh& mesh, const std::vector<Vec3>& x);

/// Principal stretches and det F over the quadrature points of a tissue.
struct StrainRange {
  double min_stretch = 1, max_stretch = 1, min_det_F = 1, max_det_F = 1;
};
/// Per tissue present, F from mesh.reference to `x` (3 per node).
std::map<Tissue, StrainRange> strain_ranges(const HexMesh& mesh, const std::vector<Vec3>& x);

/// Smallest det F from mesh.reference to `x` over quadrature points and corners, per element.
std::vector<double> smallest_det_F(const HexMesh& mesh, const Eigen::VectorXd& x);

}  // namespace breast
