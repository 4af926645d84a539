#include "mechanics/second_solution.hpp"

#include <algorithm>

#include "mesh/element_order.hpp"

namespace breast {

void estimate_by_second_solution(
    const HexMesh& solved, MechanicsOptions options, SolveSummary& summary,
    const std::function<SolveSummary(HexMesh&, const MechanicsOptions&)>& solve) {
  if (!summary.converged() || solved.landmarks.empty()) return;
  if (solved.order != 1) {
    summary.doubts.push_back("discretisation error not estimated: 27-node elements already");
    return;
  }
  Timer::Scope phase(summary.timer, "error estimate");
  options.element = Element::q2p1;
  options.estimate = Estimate::none;
  HexMesh richer = raise_order(solved);
  richer.contact.reset();
  richer.contact_pressure.clear();
  const SolveSummary second = solve(richer, options);
  if (!second.converged()) {
    summary.doubts.push_back("discretisation error not estimated: with 27-node elements " +
                             second.record.reason);
    return;
  }
  summary.error_estimate_mm = 0;
  summary.error_estimate_how =
      "a second solution with 27-node elements on the same geometry: discretisation only, not "
      "geometry, labels or laws";
  for (const Landmark& landmark : solved.landmarks) {
    const Vec3 error = landmark_position(richer, richer.points, landmark) -
                       landmark_position(solved, solved.points, landmark);
    summary.landmark_error_mm[landmark.name] = error;
    summary.error_estimate_mm = std::max(summary.error_estimate_mm, error.norm());
  }
}

}  // namespace breast
