// SPDX-License-Identifier: GPL-3.0-or-later
// The model that is compared with observations: stress-free shape and second posture, with their
// derivatives with respect to the unknowns.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "identification/observations.hpp"
#include "identification/seen_skin.hpp"
#include "mechanics/mechanics.hpp"
#include "sensitivity/chain.hpp"
#include "surface/rigid_motion.hpp"

namespace breast {

/// The unknowns: logarithms of factors on the named parts of the model and, if requested,
/// shift (mm) and rotation (degrees) of the rib cage between the postures.
struct Sought {
  std::vector<std::string> names;  ///< model_parameters in mechanics/options.hpp
  bool align = false;

  Eigen::Index materials() const { return Eigen::Index(names.size()); }
  Eigen::Index count() const { return materials() + (align ? 6 : 0); }
};

/// `options` with its material set and supports multiplied by exp(x).
MechanicsOptions with_factors(const MechanicsOptions& options, const Sought& sought,
                              const Eigen::VectorXd& x);

class SecondPosture {
 public:
  /// `mesh` was imaged under `imaged_gravity`; `gravity` acts in the second posture (mm/s²). Copies
  /// are kept.
  SecondPosture(HexMesh mesh, const MechanicsOptions& options, const Vec3& imaged_gravity,
                const Vec3& gravity, Observations seen, Sought sought);

  /// (Predicted − observed) / standard deviation: three values per point, then the sampled skin,
  /// then the forces. No value if there is no stable equilibrium; `reason()` then states why.
  std::optional<Eigen::VectorXd> residuals(const Eigen::VectorXd& x);
  /// ∂ residuals / ∂x at the last solution, from the tangent-linear derivatives of both states.
  Eigen::MatrixXd jacobian() const;

  const std::string& reason() const { return reason_; }
  const Observations& seen() const { return seen_; }
  const Sought& sought() const { return sought_; }
  /// The second posture of the last solution, before the motion of the rib cage is applied.
  const HexMesh& mesh() const { return mesh_; }
  /// Number of skin samples with a point of the surface near them in the last solution.
  std::size_t surface_points() const { return surface_points_; }
  RigidMotion motion(const Eigen::VectorXd& x) const;
  int pairs() const { return pairs_; }

 private:
  bool solve(const Eigen::VectorXd& x);
  bool press(const MechanicsOptions& options);
  Vec3 place(const Location& at) const {
    return element_position(mesh_, mesh_.points, at.element, at.local);
  }

  HexMesh mesh_;
  MechanicsOptions base_, options_;
  Vec3 imaged_gravity_, gravity_;
  Observations seen_;
  Sought sought_;
  std::vector<Location> samples_;
  Vec3 centre_;
  // Data of the last solution.
  Eigen::VectorXd x_;
  std::vector<double> imaged_pressure_;
  std::vector<HexMesh> pressed_;
  std::vector<std::optional<SurfaceDistance>> distances_;
  std::size_t surface_points_ = 0;
  std::string reason_;
  int pairs_ = 0;
};

}  // namespace breast
