// Springs under a set of faces as a term, at rest in the stress-free shape: an elastic chest wall.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "mesh/hex_mesh.hpp"
#include "solve/term.hpp"

namespace breast {

/// Stiffness per area of the imaged faces, kPa/mm, along their normal and at right angles to it.
struct SupportStiffness {
  double normal = 0, tangential = 0;
};

class ElasticSupport final : public Term {
 public:
  /// Springs at the nodes of `faces`, each with its share of the imaged area and the mean normal
  /// there. Throws Error (input) unless normal > 0 and tangential ≥ 0.
  ElasticSupport(const HexMesh& mesh, const std::vector<Face>& faces,
                 const SupportStiffness& stiffness);

  std::string name() const override { return "elastic support"; }
  bool add(const State& state, const Request& request, Forces& forces) const override;
  std::vector<int> nodes() const override { return cells_.nodes; }
  /// Its part of r (µN, 3 a node).
  Eigen::VectorXd forces(const State& state) const;
  /// Force of the support on the body, µN.
  Vec3 force_on_body(const State& state) const;

 private:
  Vec3 stretch(const State& state, int spring) const;

  Cells cells_;                  // one node each
  std::vector<Mat3> stiffness_;  // µN/mm
};

}  // namespace breast
