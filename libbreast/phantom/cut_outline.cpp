// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/cut_outline.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "core/elementary.hpp"
#include "core/error.hpp"

namespace breast {

namespace {

// Nodes that two sets of faces share.
std::vector<int> shared_nodes(const HexMesh& mesh, const std::vector<Face>& first,
                              const std::vector<Face>& second) {
  const std::vector<int> a = nodes_of(mesh, first), b = nodes_of(mesh, second);
  std::vector<int> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  return both;
}

}  // namespace

CutOutline::CutOutline(const HexMesh& mesh) : middle_(Vec3::Zero()), axis_(Vec3::Zero()) {
  double area = 0;
  for (const Face& face : mesh.pectoral_faces) {
    const std::vector<int> nodes = face_nodes(mesh, face);
    const auto corner = [&](int k) { return mesh.points[std::size_t(nodes[std::size_t(k)])]; };
    // The direction out of the body into the chest.
    const Vec3 out = 0.5 * (corner(2) - corner(0)).cross(corner(3) - corner(1));
    axis_ -= out;
    middle_ += out.norm() * 0.25 * (corner(0) + corner(1) + corner(2) + corner(3));
    area += out.norm();
  }
  middle_ /= area;
  axis_.normalize();
  u_ = axis_.unitOrthogonal();
  v_ = axis_.cross(u_);
  wall_ = curve_through(mesh, shared_nodes(mesh, mesh.cut_faces, mesh.pectoral_faces));
  skin_ = curve_through(mesh, shared_nodes(mesh, mesh.cut_faces, mesh.skin_faces));
}

CutOutline::Corner CutOutline::place_of(const Vec3& x) const {
  const Vec3 from = x - middle_;
  const double u = from.dot(u_), v = from.dot(v_);
  return {elementary::atan2(v, u), std::hypot(u, v), from.dot(axis_)};
}

CutOutline::Curve CutOutline::curve_through(const HexMesh& mesh,
                                            const std::vector<int>& nodes) const {
  Curve curve;
  for (const int node : nodes) curve.push_back(place_of(mesh.points[std::size_t(node)]));
  std::sort(curve.begin(), curve.end(),
            [](const Corner& a, const Corner& b) { return a.azimuth < b.azimuth; });
  if (curve.size() < 8) throw failed_error("phantom: the cut has no outline");
  constexpr double turn = 2 * std::numbers::pi, widest = 0.25 * turn;
  Corner first = curve.front(), last = curve.back();
  first.azimuth += turn, last.azimuth -= turn;
  curve.insert(curve.begin(), last);
  curve.push_back(first);
  for (std::size_t k = 1; k < curve.size(); ++k) {
    if (!(curve[k].azimuth - curve[k - 1].azimuth < widest))
      throw failed_error("phantom: the outline of the cut does not enclose the breast");
  }
  return curve;
}

CutOutline::Corner CutOutline::at(const Curve& curve, double azimuth) {
  const auto above = std::upper_bound(curve.begin() + 1, curve.end() - 1, azimuth,
                                      [](double a, const Corner& c) { return a < c.azimuth; });
  const Corner &b = *above, &a = *(above - 1);
  const double t = b.azimuth > a.azimuth ? (azimuth - a.azimuth) / (b.azimuth - a.azimuth) : 0;
  return {azimuth, a.radius + t * (b.radius - a.radius), a.height + t * (b.height - a.height)};
}

bool CutOutline::inside(const Vec3& x, double margin) const {
  const Corner place = place_of(x), foot = at(wall_, place.azimuth), rim = at(skin_, place.azimuth);
  const double largest = 1.5 * std::max(foot.radius, rim.radius);
  if (place.radius > largest || place.height < -largest) return false;
  const double rise = (place.height - foot.height) / (rim.height - foot.height);
  return place.radius < foot.radius + rise * (rim.radius - foot.radius) - margin;
}

}  // namespace breast
