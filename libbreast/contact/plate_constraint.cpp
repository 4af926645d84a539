#include "contact/plate_constraint.hpp"

#include <Eigen/Geometry>

namespace breast {

void hold_on_plate(Constraints& all, int node, const Vec3& normal, double increment) {
  const NodeConstraint* held = all.at(node);
  if (held == nullptr) {
    all.hold_normal(node, normal, increment);
    return;
  }
  NodeConstraint both = *held;
  Vec3 rest = normal;
  for (int i = 0; i < 3; ++i) {
    if (held->held[i]) rest -= rest.dot(held->axes.col(i)) * held->axes.col(i);
  }
  const double part = rest.norm();
  if (!(part > 1e-6)) return;  // the plate can move the node nowhere
  // The first free axis turns to the plate's normal, the other follows.
  int first = 0;
  while (held->held[first]) ++first;
  const int second = (first + 1) % 3, third = (first + 2) % 3;
  both.axes.col(first) = rest / part;
  if (held->held[second] != held->held[third]) {
    const int kept = held->held[second] ? second : third,
              free = held->held[second] ? third : second;
    both.axes.col(free) = both.axes.col(first).cross(both.axes.col(kept));
  }
  both.held[first] = true;
  both.increment[first] = increment / part;
  all.set(node, both);
}

}  // namespace breast
