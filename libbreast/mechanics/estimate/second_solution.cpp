// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/estimate/second_solution.hpp"

#include <algorithm>

#include "mesh/element_order.hpp"

namespace breast {

void estimate_by_second_solution(
    const HexMesh& mesh, MechanicsOptions options, Equilibrium& solved,
    const std::function<Equilibrium(const HexMesh&, const MechanicsOptions&)>& solve) {
  if (!solved.converged() || mesh.landmarks.empty()) return;
  if (mesh.order != 1) {
    solved.doubts.push_back("discretisation error not estimated: 27-node elements already");
    return;
  }
  Timer::Scope phase(solved.timer, "error estimate");
  options.element = Element::q2p1;
  options.estimate = Estimate::none;
  const HexMesh richer = raise_order(mesh);
  const Equilibrium second = solve(richer, options);
  if (!second.converged()) {
    solved.doubts.push_back("discretisation error not estimated: with 27-node elements " +
                            second.record.reason);
    return;
  }
  solved.error_estimate_mm = 0;
  solved.error_estimate_how =
      "a second solution with 27-node elements on the same geometry: discretisation only, not "
      "geometry, labels or laws";
  for (const Landmark& landmark : mesh.landmarks) {
    const Vec3 error = landmark_position(richer, second.points, landmark) -
                       landmark_position(mesh, solved.points, landmark);
    solved.landmark_error_mm[landmark.name] = error;
    solved.error_estimate_mm = std::max(solved.error_estimate_mm, error.norm());
  }
}

}  // namespace breast
