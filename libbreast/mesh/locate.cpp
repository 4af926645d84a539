// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/locate.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "mesh/lattice.hpp"

namespace breast {

namespace {

constexpr double local_tolerance = 1e-10;
constexpr int leaf_size = 4;

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

double Locator::Box::squared_distance(const Vec3& point) const {
  return ((lower - point).cwiseMax(0.0) + (point - upper).cwiseMax(0.0)).squaredNorm();
}

bool Locator::Box::contains(const Vec3& point, double slack) const {
  return ((point - lower).array() >= -slack).all() && ((upper - point).array() >= -slack).all();
}

Locator::Locator(const HexMesh& mesh, const std::vector<Vec3>& nodal)
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
  boxes_.resize(mesh.elements());
  for (int e = 0; e < mesh.elements(); ++e) {
    Vec3* own = &coordinates_[std::size_t(e) * per_element_];
    for (int a = 0; a < per_element_; ++a) own[a] = nodal[mesh.element(e)[vtk[a]]];
    std::array<Vec3, 27> hull;
    std::copy(own, own + per_element_, hull.begin());
    if (order_of_mesh_ == 2) {
      for (const int stride : {1, 3, 9}) to_bezier(hull.data(), stride);
    }
    boxes_[e] = {hull[0], hull[0]};
    for (int a = 1; a < per_element_; ++a) {
      boxes_[e].lower = boxes_[e].lower.cwiseMin(hull[a]);
      boxes_[e].upper = boxes_[e].upper.cwiseMax(hull[a]);
    }
  }
  order_.resize(mesh.elements());
  std::iota(order_.begin(), order_.end(), 0);
  tree_.reserve(2 * order_.size());
  build(0, mesh.elements());
  lower_ = tree_[0].box.lower;
  upper_ = tree_[0].box.upper;
  slack_ = 1e-9 * (upper_ - lower_).norm();
}

int Locator::build(int first, int count) {
  const int self = int(tree_.size());
  tree_.push_back({boxes_[order_[first]], -1, -1, first, count});
  for (int i = first; i < first + count; ++i) {
    tree_[self].box.lower = tree_[self].box.lower.cwiseMin(boxes_[order_[i]].lower);
    tree_[self].box.upper = tree_[self].box.upper.cwiseMax(boxes_[order_[i]].upper);
  }
  if (count <= leaf_size) return self;
  int axis = 0;
  (tree_[self].box.upper - tree_[self].box.lower).maxCoeff(&axis);
  const int half = count / 2;
  std::nth_element(order_.begin() + first, order_.begin() + first + half,
                   order_.begin() + first + count, [&](int a, int b) {
                     const double at_a = boxes_[a].lower[axis] + boxes_[a].upper[axis];
                     const double at_b = boxes_[b].lower[axis] + boxes_[b].upper[axis];
                     return at_a != at_b ? at_a < at_b : a < b;
                   });
  const int left = build(first, half);
  const int right = build(first + half, count - half);
  tree_[self].left = left;
  tree_[self].right = right;
  return self;
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
  if (hint >= 0 && hint < int(boxes_.size()) && boxes_[hint].contains(point, slack_)) {
    const std::optional<Vec3> local = invert(hint, point);
    if (local && local->cwiseAbs().maxCoeff() < 1 - 1e-6) return Location{hint, *local, 0};
  }
  std::optional<Location> found;
  std::array<int, 64> stack;  // a balanced tree of 2^31 elements is 31 deep
  int depth = 0;
  stack[depth++] = 0;
  while (depth > 0) {
    const Branch& branch = tree_[stack[--depth]];
    if (!branch.box.contains(point, slack_)) continue;
    if (branch.left >= 0) {
      stack[depth++] = branch.right;
      stack[depth++] = branch.left;
      continue;
    }
    for (int i = branch.first; i < branch.first + branch.count; ++i) {
      const int e = order_[i];
      if ((found && e > found->element) || !boxes_[e].contains(point, slack_)) continue;
      const std::optional<Vec3> local = invert(e, point);
      if (!local) continue;
      found = Location{e, *local, 0};
      if (local->cwiseAbs().maxCoeff() < 1 - 1e-6) return found;
    }
  }
  return found;
}

Location Locator::nearest(const Vec3& point) const {
  if (const std::optional<Location> inside = find(point)) return *inside;
  Location best;
  double best_squared = std::numeric_limits<double>::infinity();
  if (!point.allFinite()) throw input_error("point location: the given point is not finite");
  std::vector<std::pair<double, int>> stack{{tree_[0].box.squared_distance(point), 0}};
  while (!stack.empty()) {
    const auto [distance, index] = stack.back();
    stack.pop_back();
    if (distance > best_squared) continue;
    const Branch& branch = tree_[index];
    if (branch.left >= 0) {
      std::pair<double, int> near{tree_[branch.left].box.squared_distance(point), branch.left};
      std::pair<double, int> far{tree_[branch.right].box.squared_distance(point), branch.right};
      if (far.first < near.first) std::swap(near, far);
      stack.push_back(far);
      stack.push_back(near);
      continue;
    }
    for (int i = branch.first; i < branch.first + branch.count; ++i) {
      const int e = order_[i];
      if (boxes_[e].squared_distance(point) > best_squared) continue;
      const Vec3 start = nearest_lattice_point(order_of_mesh_, lattice(e), point, -1, 0);
      Vec3 local;
      const double squared =
          lattice::closest_in_element(order_of_mesh_, lattice(e), point, -1, start, local);
      if (squared < best_squared || (squared == best_squared && e < best.element)) {
        best_squared = squared;
        best = {e, local, std::sqrt(squared)};
      }
    }
  }
  if (best.element < 0) throw no_distance(point);
  return best;
}

Vec3 Locator::position(int element, const Vec3& local) const {
  Vec3 x;
  Mat3 jacobian;
  lattice::evaluate(order_of_mesh_, lattice(element), local, x, jacobian);
  return x;
}

Location nearest_on_faces(const HexMesh& mesh, const std::vector<Vec3>& nodal,
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
