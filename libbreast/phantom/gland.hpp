// SPDX-License-Identifier: GPL-3.0-or-later
// The irregular fibroglandular tree: lobes of branching ducts that converge on the nipple, their
// lobules, and Cooper's ligaments between. Everything lives in the stress-free frame.
#pragma once

#include <vector>

#include "phantom/shape.hpp"

namespace breast {

/// A duct piece or a lobule, both capsules.
struct GlandPiece {
  Vec3 from, to;
  double radius = 0;
  bool duct = false;  ///< a main duct; the calibration does not change its width
};

/// Grows the tree of one breast (serial, a few thousand pieces).
std::vector<GlandPiece> grow_gland(const BreastShape& shape, const GlandParameters& parameters,
                                   std::uint64_t seed);

/// Signed distance to the gland on a 0.8 mm lattice, with an irregular margin. The margin is
/// shifted so that the gland fills exactly the required fraction of the breast above the chest's
/// fat layer.
class GlandField {
 public:
  GlandField(const BreastShape& shape, const GlandParameters& parameters, std::uint64_t seed);

  /// Approximate signed distance (mm), negative inside the gland; +large outside the lattice.
  double distance(const Vec3& stress_free) const;
  /// Fat, ligament or gland of a stress-free point below the skin.
  Matter matter(const Vec3& stress_free) const;
  double volume_ml() const { return volume_ml_; }
  std::size_t pieces() const { return pieces_; }

 private:
  struct Lattice {
    Vec3 origin;
    double spacing = 0.8;
    std::array<int, 3> size{0, 0, 0};
    std::vector<float> values;
    std::size_t at(int i, int j, int k) const {
      return (std::size_t(k) * size[1] + j) * size[0] + i;
    }
  };
  void fill(const std::vector<GlandPiece>& pieces);
  void calibrate(const BreastShape& shape, double fraction);
  Vec3 node(int i, int j, int k) const {
    return lattice_.origin + lattice_.spacing * Vec3(i, j, k);
  }

  Lattice lattice_;
  std::vector<float> duct_;  ///< distance to the main ducts, only until calibrated
  std::uint64_t seed_;
  double volume_ml_ = 0;
  std::size_t pieces_ = 0;
};

}  // namespace breast
