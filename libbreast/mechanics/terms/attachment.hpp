// SPDX-License-Identifier: GPL-3.0-or-later
// An attachment by skin and fascia as a term: it pulls tissue back that moves away from it, but does
// not push tissue that moves towards it, since a loose sheet bears no compression.
#pragma once

#include <vector>

#include "mechanics/terms/node_springs.hpp"
#include "mesh/hex_mesh.hpp"
#include "mesh/nodal_faces.hpp"

namespace breast {

/// Per area of the imaged faces the energy is s ψ(d), where d = (X − x)·m is the distance by which
/// tissue has moved from its stress-free place X against the direction m of the attachment, and
///
///     ψ' = 0 for d ≤ 0,   d² / 2w for 0 < d < w,   d − w/2 beyond:
///
/// stress-free tissue is without force, and the stiffness rises from zero to s over the width w.
/// ψ is convex, so that an attachment cannot itself make a body unstable.
class Attachment final : public NodeSprings {
 public:
  /// The width w, mm.
  static constexpr double toe_mm = 1;

  /// At the nodes of `faces`, each with its share of the imaged area; `stiffness` s in kPa/mm > 0,
  /// `towards` the unit vector m. `factor` multiplies s by a function of place and outward normal of a
  /// face. Throws Error (input) for another stiffness.
  Attachment(const HexMesh& mesh, const std::vector<Face>& faces, double stiffness,
             const Vec3& towards, const FaceWeight& factor);

  std::string name() const override { return "attachment"; }

 private:
  std::optional<Spring> spring(const State& state, int i) const override;

  Vec3 towards_;
  std::vector<double> stiffness_;  // µN/mm
};

}  // namespace breast
