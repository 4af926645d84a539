// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/path/path_point.hpp"

#include "core/units.hpp"

namespace breast {

PathPoint path_point(const ContactSolver& solver, const PlatePair& plates, const State& state,
                     const ContactStep& step, double paddle_area) {
  PathPoint point;
  point.thickness = plates.thickness();
  point.iterations = int(step.iterations.size());
  for (std::size_t c = 0; c < step.contacts.size(); ++c) {
    const NodalContact& contact = step.contacts[c];
    if (contact.plate < 0) continue;
    const Vec3 x = state.x.segment<3>(3L * solver.candidates()[c]);
    const Plate& plate = plates.plate(contact.plate);
    const double along =
        (contact.normal * plate.gap(x).gradient + contact.tangential).dot(plate.normal());
    (contact.plate == 0 ? point.paddle_N : point.detector_N) += along / micronewton_per_newton;
  }
  point.area_cm2 = paddle_area / mm2_per_cm2;
  if (paddle_area > 0) {
    point.pressure_kPa =
        point.paddle_N * micronewton_per_newton / paddle_area / pascal_per_kilopascal;
  }
  return point;
}

void drop_points_beyond(double thickness, std::vector<PathPoint>& points) {
  while (!points.empty() && points.back().thickness != thickness) points.pop_back();
}

void drop_repeated_point(std::vector<PathPoint>& points) {
  const std::size_t n = points.size();
  if (n >= 2 && points[n - 2].thickness == points[n - 1].thickness) points.erase(points.end() - 2);
}

}  // namespace breast
