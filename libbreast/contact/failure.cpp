// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/failure.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "contact/compressed_shape.hpp"
#include "core/error.hpp"

namespace breast {

namespace {

Vec3 centre(const HexMesh& mesh, const Eigen::VectorXd& x, int element) {
  Vec3 sum = Vec3::Zero();
  for (int a = 0; a < 8; ++a) sum += x.segment<3>(3 * mesh.element(element)[a]);
  return sum / 8;
}

/// The parts of the scene between which an element is caught.
StopReason surroundings(const HexMesh& mesh, const Eigen::VectorXd& x, int element,
                        const PlatePair& plates) {
  const std::vector<int> wall_list = nodes_of(mesh, mesh.pectoral_faces);
  const std::set<int> wall(wall_list.begin(), wall_list.end());
  bool on_wall = false;
  for (int a = 0; a < mesh.nodes_per_element(); ++a) {
    on_wall = on_wall || wall.count(mesh.element(element)[a]) > 0;
  }
  const double behind =
      plates.paddle.edge_start - centre(mesh, x, element).dot(plates.paddle.anterior);
  const bool at_edge = std::abs(behind) <= std::max(10.0, 1.5 * plates.paddle.edge_radius);
  if (on_wall && at_edge) {
    return {"between_edge_and_wall", "pinched between the plate edge and the chest wall"};
  }
  if (on_wall) return {"on_chest_wall", "on the chest wall"};
  if (at_edge) return {"at_plate_edge", "pinched at the plate edge"};
  if (behind > 0) return {"behind_plates", "behind the plates"};
  return {"between_plates", "between the plates"};
}

}  // namespace

StopReason explain_stop(const HexMesh& mesh, const Eigen::VectorXd& good, const PathResult& path,
                        const PlatePair& plates) {
  if (path.end == PathEnd::solve_limit) {
    return {"solve_limit", message("the limit of ", path.solves, " plate positions is reached")};
  }
  if (path.end == PathEnd::cost_limit) {
    return {"cost_limit",
            message("no step begins after ", path.iterations,
                    " iterations at this place of the plates; --most-iterations allows more")};
  }
  if (path.end == PathEnd::out_of_reach) {
    return {"out_of_reach",
            message("the plates would have to close to ", path.failed_thickness, " mm")};
  }
  const bool have_trial = path.failed_trial.size() == good.size() && path.failed_trial.allFinite();
  const std::vector<double> det = smallest_det_F(mesh, have_trial ? path.failed_trial : good);
  const int worst = int(std::min_element(det.begin(), det.end()) - det.begin());
  const auto folded = std::count_if(det.begin(), det.end(), [](double d) { return !(d > 0); });
  const StopReason where = surroundings(mesh, good, worst, plates);
  StopReason reason;
  reason.id = path.last_failure == NewtonStop::folded
                  ? (folded > 0 ? "folds_" : "shrinks_") + where.id
                  : std::string(stop_name(path.last_failure));
  const Vec3 at = centre(mesh, good, worst);
  reason.sentence = message(
      "the step to ", path.failed_thickness, " mm fails, ", describe(path.last_failure), "; ",
      folded > 0 ? message("the next step folds ", folded, folded == 1 ? " element" : " elements",
                           ", worst element ")
                 : std::string("the most strained element is "),
      worst, " at (", std::round(at.x() * 10) / 10, ", ", std::round(at.y() * 10) / 10, ", ",
      std::round(at.z() * 10) / 10, ") mm, ", tissue_name(mesh.tissue[std::size_t(worst)]),
      ", smallest det F ", det[worst], ", ", where.sentence);
  return reason;
}

}  // namespace breast
