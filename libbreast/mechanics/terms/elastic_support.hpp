// SPDX-License-Identifier: GPL-3.0-or-later
// Springs on a set of faces as a term, unloaded in the stress-free shape X: an elastic chest wall
// or cut. Per area of the imaged faces the energy is
//
//     ½ k_t |x − X|² + ½ (k_n − k_t) (φ(x) − φ(X))² / |∇φ|²
//
// where φ is a level function of the wall surface and its gradient is taken in the imaged shape:
// k_n acts normal and k_t tangential to the wall, whether it is flat or curved.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "mechanics/terms/node_springs.hpp"
#include "mesh/hex_mesh.hpp"
#include "mesh/nodal_faces.hpp"
#include "surface/level_surface.hpp"

namespace breast {

/// Stiffness per area of the imaged faces, kPa/mm, normal and tangential to them.
struct SupportStiffness {
  double normal = 0, tangential = 0;
};

class ElasticSupport final : public NodeSprings {
 public:
  /// Springs at the nodes of `faces`, each with its share of the imaged area. Without a surface
  /// every node has its own plane, with the mean normal of the imaged faces there. `share` multiplies
  /// the stiffness at a place of the imaged faces. Throws Error
  /// (input) unless normal > 0 and tangential ≥ 0, and for a node beyond the surface.
  ElasticSupport(const HexMesh& mesh, const std::vector<Face>& faces,
                 const SupportStiffness& stiffness,
                 std::shared_ptr<const LevelSurface> surface = nullptr,
                 const FaceWeight& share = {});

  std::string name() const override { return "elastic support"; }

 private:
  /// Nothing if a position is beyond the surface.
  std::optional<Spring> spring(const State& state, int i) const override;
  std::optional<Level> level(int i, const Vec3& x) const;

  std::shared_ptr<const LevelSurface> surface_;
  std::vector<double> along_, across_;  // µN/mm: k_t A, (k_n − k_t) A / |∇φ|²
  std::vector<Vec3> normals_;           // without a surface
};

}  // namespace breast
