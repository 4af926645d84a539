#include "contact/friction.hpp"

namespace breast {

FrictionForce Friction::at(const Vec3& x, const Vec3& anchor, const Vec3& normal,
                           double bound) const {
  FrictionForce friction;
  if (!(bound > 0)) {
    friction.slips = true;
    return friction;
  }
  const Mat3 tangential = Mat3::Identity() - normal * normal.transpose();
  const Vec3 trial = -stick * (tangential * (x - anchor));
  const double size = trial.norm();
  if (size <= bound) {
    friction.force = trial;
    friction.stiffness = stick * tangential;
    return friction;
  }
  const Vec3 along = trial / size;
  friction.slips = true;
  friction.force = bound * along;
  friction.stiffness = bound / size * stick * (tangential - along * along.transpose());
  return friction;
}

}  // namespace breast
