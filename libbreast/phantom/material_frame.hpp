// SPDX-License-Identifier: GPL-3.0-or-later
// Map from voxels of the image to the stress-free points that lie there.
#pragma once

#include "image/volume.hpp"
#include "mesh/locate.hpp"
#include "phantom/scene.hpp"

namespace breast {

/// The deformation around one voxel, inverted and linearised at its centre (the error within a
/// voxel is below 0.02 mm: strains change over centimetres).
struct MaterialFrame {
  Vec3 imaged{0, 0, 0}, stress_free{0, 0, 0};
  Mat3 gradient = Mat3::Identity();  ///< ∂(stress-free)/∂(imaged)
  Vec3 at(const Vec3& x) const { return stress_free + gradient * (x - imaged); }
};

/// Finds the frame of every voxel that belongs to a breast: in the mesh, within one voxel of it, or
/// in the nipple (which protrudes from the mesh).
class BreastFrames {
 public:
  BreastFrames(const PhantomBreast& breast, const Grid& grid);
  /// Returns false if the voxel does not belong to this breast.
  bool at(int i, int j, int k, MaterialFrame& frame) const;

 private:
  bool touches(int i, int j, int k) const;
  MaterialFrame frame(const Location& location, const Vec3& x) const;

  const PhantomBreast& breast_;
  Grid grid_;
  Locator locator_;
  std::vector<int> element_;  ///< per voxel of the box below, -1 outside the mesh
  std::array<int, 3> low_, size_;
  Vec3 nipple_;
};

}  // namespace breast
