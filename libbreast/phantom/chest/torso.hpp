// SPDX-License-Identifier: GPL-3.0-or-later
// The rigid thorax of the phantom: chest wall, subcutaneous fat, skin, and the tissues behind the
// pectoral muscle.
#pragma once

#include "phantom/matter.hpp"
#include "phantom/parameters.hpp"

namespace breast {

class Torso {
 public:
  Torso(const TorsoParameters& parameters, std::uint64_t seed) : p_(parameters), seed_(seed) {}

  /// First-order signed distance (mm) to the chest-wall surface, positive outside.
  double wall_distance(const Vec3& x) const;
  /// The same to the skin of the chest without breasts; negative inside the body.
  double skin_distance(const Vec3& x) const;
  /// Both at once, for half the cost.
  struct Distances {
    double skin, wall;
  };
  Distances distances(const Vec3& x) const;
  /// Unit outward normal of the level set of wall_distance through x.
  Vec3 wall_normal(const Vec3& x) const;
  /// Point of the anterior chest wall at (x, z).
  Vec3 wall_point(double x, double z) const;
  /// Matter behind the chest wall; `depth` = −wall_distance(x) > 0.
  Matter interior(const Vec3& x, double depth) const;

 private:
  double smooth_distance(const Vec3& x) const;
  double groove(const Vec3& x) const;
  double fat_thickness(const Vec3& x) const;
  double centre(double z) const { return p_.half_depth + p_.tilt * z + p_.bend * z * z; }
  double frontness(const Vec3& x) const;
  Matter bone_layer(const Vec3& x, double depth) const;
  Matter thorax(const Vec3& x) const;

  TorsoParameters p_;
  std::uint64_t seed_;
};

/// Cubic step from 0 at `low` to 1 at `high`.
double smooth_step(double value, double low, double high);

}  // namespace breast
