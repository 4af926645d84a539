// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/locate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "mesh/lattice.hpp"

namespace breast {

namespace {

constexpr double local_tolerance = 1e-10;

// Control points of the quadratic Bézier form along one lattice direction:
// their hull holds the element.
void to_bezier(Vec3* points, int stride) {
  for (int a = 0; a < 27; ++a) {
    if ((a / stride) % 3 != 1) continue;
    points[a] = 2 * points[a] - 0.5 * (points[a - stride] + points[a + stride]);
  }
}

// Start of the search in an element: its lattice point nearest to `point`.
Vec3 nearest_lattice_point(int order, const Vec3* points, const Vec3& point, int fixed,
                           double value) {
  const int side = order + 1;
  Vec3 best_local = Vec3::Zero();
  double best = std::numeric_limits<double>::infinity();
  for (int a = 0; a < side * side * side; ++a) {
    const Vec3 local =
        Vec3(a % side, (a / side) % side, a / (side * side)) * 2.0 / order - Vec3::Ones();
    if (fixed >= 0 && local[fixed] != value) continue;
    const double distance = (points[a] - point).squaredNorm();
    if (distance < best) best = distance, best_local = local;
  }
  // Off the corner a little, or a search started there could see only one of its sides.
  Vec3 start = 0.9 * best_local;
  if (fixed >= 0) start[fixed] = value;
  return start;
}

// Coordinates whose squares overflow are near to nothing.
Error no_distance(const Vec3& point) {
  return input_error("point location: no distance to (", point.transpose(),
                     ") can be computed: the coordinates of the point or of the mesh are not "
                     "those of a body in mm");
}

}  // namespace

Locator::Locator(const HexTopology& mesh, const std::vector<Vec3>& nodal)
    : order_of_mesh_(mesh.order), per_element_(mesh.nodes_per_element()) {
  if (mesh.elements() == 0) throw input_error("point location: the mesh has no elements");
  for (const int node : mesh.connectivity) {
    if (node < 0 || node >= int(nodal.size()) || !nodal[node].allFinite()) {
      throw input_error("point location: node ", node, " has no finite position (", nodal.size(),
                        " positions given)");
    }
  }
  const int* vtk = lattice::vtk_nodes(order_of_mesh_);
  coordinates_.resize(std::size_t(mesh.elements()) * per_element_);
  std::vector<Eigen::AlignedBox3d> boxes(mesh.elements());
  for (int e = 0; e < mesh.elements(); ++e) {
    Vec3* own = &coordinates_[std::size_t(e) * per_element_];
    for (int a = 0; a < per_element_; ++a) own[a] = nodal[mesh.element(e)[vtk[a]]];
    std::array<Vec3, 27> hull;
    std::copy(own, own + per_element_, hull.begin());
    if (order_of_mesh_ == 2) {
      for (const int stride : {1, 3, 9}) to_bezier(hull.data(), stride);
    }
    for (int a = 0; a < per_element_; ++a) boxes[e].extend(hull[a]);
  }
  tree_ = BoxTree(std::move(boxes));
  slack_ = 1e-9 * (upper() - lower()).norm();
}

// Newton from the centre; nothing when the point is not in the element.
std::optional<Vec3> Locator::invert(int element, const Vec3& point) const {
  Vec3 local = Vec3::Zero(), x;
  Mat3 jacobian;
  for (int iteration = 0; iteration < 40; ++iteration) {
    lattice::evaluate(order_of_mesh_, lattice(element), local, x, jacobian);
    Vec3 step = jacobian.partialPivLu().solve(point - x);
    const double length = step.cwiseAbs().maxCoeff();
    if (!(length < 1e6)) return std::nullopt;  // singular Jacobian, or not finite
    if (length > 1) step /= length;
    local += step;
    if (local.cwiseAbs().maxCoeff() > 4) return std::nullopt;
    if (length < 1e-13 || (iteration > 20 && length < 1e-11)) break;
    if (iteration == 39) return std::nullopt;
  }
  if (local.cwiseAbs().maxCoeff() > 1 + local_tolerance) return std::nullopt;
  return local.cwiseMax(-1.0).cwiseMin(1.0);
}

std::optional<Location> Locator::find(const Vec3& point, int hint) const {
  if (!point.allFinite()) return std::nullopt;
  const auto strictly_inside = [](const Vec3& local) {
    return local.cwiseAbs().maxCoeff() < 1 - 1e-6;
  };
  if (hint >= 0 && hint < tree_.size() && tree_.holds(hint, point, slack_)) {
    const std::optional<Vec3> local = invert(hint, point);
    if (local && strictly_inside(*local)) return Location{hint, *local, 0};
  }
  std::optional<Location> found;
  tree_.containing(point, slack_, [&](int e) {
    if (found && e > found->element) return false;
    const std::optional<Vec3> local = invert(e, point);
    if (!local) return false;
    found = Location{e, *local, 0};
    return strictly_inside(*local);
  });
  return found;
}

Location Locator::nearest(const Vec3& point) const {
  if (const std::optional<Location> inside = find(point)) return *inside;
  if (!point.allFinite()) throw input_error("point location: the given point is not finite");
  Location best;
  double best_squared = std::numeric_limits<double>::infinity();
  tree_.nearest(point, [&](int e) {
    const Vec3 start = nearest_lattice_point(order_of_mesh_, lattice(e), point, -1, 0);
    Vec3 local;
    const double squared =
        lattice::closest_in_element(order_of_mesh_, lattice(e), point, -1, start, local);
    if (squared < best_squared || (squared == best_squared && e < best.element)) {
      best_squared = squared;
      best = {e, local, std::sqrt(squared)};
    }
    return squared;
  });
  if (best.element < 0) throw no_distance(point);
  return best;
}

Vec3 Locator::position(int element, const Vec3& local) const {
  Vec3 x;
  Mat3 jacobian;
  lattice::evaluate(order_of_mesh_, lattice(element), local, x, jacobian);
  return x;
}

Location nearest_on_faces(const HexTopology& mesh, const std::vector<Vec3>& nodal,
                          const std::vector<Face>& faces, const Vec3& point) {
  if (faces.empty()) throw input_error("nearest point on faces: the face set is empty");
  const int* vtk = lattice::vtk_nodes(mesh.order);
  Location best;
  double best_squared = std::numeric_limits<double>::infinity();
  for (const Face& face : faces) {
    std::array<Vec3, 27> own;
    for (int a = 0; a < mesh.nodes_per_element(); ++a) {
      own[a] = nodal[mesh.element(face.element)[vtk[a]]];
    }
    const int fixed = face.local / 2;
    const double value = face.local % 2 == 0 ? -1 : 1;
    const Vec3 start = nearest_lattice_point(mesh.order, own.data(), point, fixed, value);
    Vec3 local;
    const double squared =
        lattice::closest_in_element(mesh.order, own.data(), point, fixed, start, local);
    if (squared < best_squared)
      best_squared = squared, best = {face.element, local, std::sqrt(squared)};
  }
  if (best.element < 0) throw no_distance(point);
  return best;
}

int nearest_node(const std::vector<Vec3>& nodal, const Vec3& point) {
  const auto nearer = [&](const Vec3& a, const Vec3& b) {
    return (a - point).squaredNorm() < (b - point).squaredNorm();
  };
  return int(std::min_element(nodal.begin(), nodal.end(), nearer) - nodal.begin());
}

}  // namespace breast
