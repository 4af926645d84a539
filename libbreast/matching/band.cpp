// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/band.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

constexpr std::array per_view = {"thickness", "angle", "standoff", "detector"};

const NodalField* field_of(const DerivativeFields& fields, const std::string& name, int nodes) {
  const auto found = fields.find(name);
  if (found == fields.end()) return nullptr;
  if (int(found->second.size()) != nodes) {
    throw input_error("derivative_", name, " has ", found->second.size(), " vectors for ", nodes,
                      " nodes");
  }
  return &found->second;
}

// ∂x/∂ξ in a nodal field, columns by local coordinate.
Mat3 jacobian(const HexTopology& mesh, const std::vector<Vec3>& nodal, const ColumnPoint& point) {
  const HexShape shape = hex_shape(mesh.order, point.local);
  const int* nodes = mesh.element(point.element);
  Mat3 j = Mat3::Zero();
  for (int a = 0; a < mesh.nodes_per_element(); ++a) {
    j += nodal[std::size_t(nodes[a])] * shape.gradients.col(a).transpose();
  }
  return j;
}

// Derivative of the projection at a point: the change of (u,v) when the point moves by d.
Vec2 projected(const ViewPose& pose, const Vec3& at, const Vec3& d) {
  constexpr double step = 1e-3;  // mm: exact for the parallel beam, 1e-9 for the cone
  return (pose.project(at + step * d) - pose.project(at - step * d)) / (2 * step);
}

// Unit vectors across the curve at each point, of which separate pieces have their own: over a millimetre
// to either side, and along the pieces of the polyline before and after it. At a sharp corner the first is
// partly along the curve.
struct Across {
  std::vector<Vec2> smooth;
  std::vector<std::array<Vec2, 2>> beside;
};
Across across(const MatchedCurve& curve) {
  const auto& points = curve.points;
  const auto joined = [&](std::size_t a, std::size_t b) {
    return points[a].stretch == points[b].stretch;
  };
  const auto normal = [&](std::size_t a, std::size_t b, const Vec2& without) {
    const Vec2 along = points[b].to_uv - points[a].to_uv;
    return along.norm() > 1e-6 ? Vec2(Vec2(-along.y(), along.x()).normalized()) : without;
  };
  Across found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto near = [&](std::size_t k) { return (points[k].to_uv - points[i].to_uv).norm() < 1; };
    std::size_t a = i, b = i;
    while (a > 0 && joined(a - 1, i) && near(a)) --a;
    while (b + 1 < points.size() && joined(b + 1, i) && near(b)) ++b;
    found.smooth.push_back(normal(a, b, Vec2(1, 0)));
    const bool first = i == 0 || !joined(i - 1, i),
               last = i + 1 == points.size() || !joined(i, i + 1);
    const Vec2 before = first ? found.smooth[i] : normal(i - 1, i, found.smooth[i]),
               after = last ? before : normal(i, i + 1, before);
    found.beside.push_back({first ? after : before, after});
  }
  return found;
}

}  // namespace

BandModel::BandModel(const Matcher& matcher, const DerivativeFields& from,
                     const DerivativeFields& to, std::vector<Prior> priors)
    : matcher_(matcher),
      from_centre_(turning_centre(matcher.from().points)),
      to_centre_(turning_centre(matcher.to().points)) {
  const int nodes = matcher.from().nodes();
  for (const Prior& prior : priors) {
    if (prior.parameter == "repositioning") {
      in_first_.emplace_back("repositioning in " + view_name(matcher.from_frame().view),
                             prior.deviation);
      in_second_.emplace_back("repositioning in " + view_name(matcher.to_frame().view),
                              prior.deviation);
      continue;
    }
    if (prior.parameter == "chain") {
      in_second_.emplace_back(prior.parameter, prior.deviation);
      continue;
    }
    if (prior.parameter == "picking" || prior.parameter == "alignment_from") {
      in_first_.emplace_back(prior.parameter == "picking"
                                 ? "picking"
                                 : "alignment in " + view_name(matcher.from_frame().view),
                             prior.deviation);
      continue;
    }
    if (prior.parameter == "marking" || prior.parameter == "alignment_to") {
      in_second_.emplace_back(prior.parameter == "marking"
                                  ? "marking"
                                  : "alignment in " + view_name(matcher.to_frame().view),
                              prior.deviation);
      continue;
    }
    const NodalField *first = field_of(from, prior.parameter, nodes),
                     *second = field_of(to, prior.parameter, nodes);
    if (first == nullptr || second == nullptr) {
      without_.push_back(prior.parameter);
    } else if (std::find(per_view.begin(), per_view.end(), prior.parameter) != per_view.end()) {
      const bool turns = prior.parameter == "angle";
      causes_.push_back({prior.parameter + " in " + view_name(matcher.from_frame().view),
                         prior.deviation, first, nullptr, turns});
      causes_.push_back({prior.parameter + " in " + view_name(matcher.to_frame().view),
                         prior.deviation, nullptr, second, turns});
    } else {
      causes_.push_back({prior.parameter, prior.deviation, first, second});
    }
  }
}

std::string BandModel::what_is_missing() const {
  std::string names;
  for (const std::string& name : without_) names += " " + name;
  return "the band does not include" + names +
         ": there is no derivative in both files (see sensitivity)";
}

Vec3 BandModel::moved(const HexTopology& mesh, const ImageFrame& frame, const Vec3& centre,
                      const NodalField& field, const ColumnPoint& point, const Vec3& at,
                      bool turns) const {
  Vec3 moved = element_position(mesh, field, point.element, point.local);
  if (turns) {
    constexpr double step = 0.5;  // degrees
    const ViewPose& pose = frame.pose;
    const auto turned = [&](double by) {
      return view_pose(mesh.side, pose.angle_deg + by, pose.turn_deg, pose.lean_deg, pose.bend_deg);
    };
    const ViewPose more = turned(step), less = turned(-step);
    const Vec3 from_centre = (at - centre) / (2 * step);
    moved += from_centre.dot(more.e_u - less.e_u) * pose.e_u +
             from_centre.dot(more.e_v - less.e_v) * pose.e_v;
  }
  return moved;
}

Vec2 BandModel::shift(const ColumnPoint& point, const Mat3& carry, const Cause& cause) const {
  Vec3 moved = Vec3::Zero();
  if (cause.to != nullptr) {
    moved += this->moved(matcher_.to(), matcher_.to_frame(), to_centre_, *cause.to, point, point.to,
                         cause.turns);
  }
  if (cause.from != nullptr) {
    moved -= carry * this->moved(matcher_.from(), matcher_.from_frame(), from_centre_, *cause.from,
                                 point, point.from, cause.turns);
  }
  return cause.deviation * projected(matcher_.to_frame().pose, point.to, moved);
}

Band BandModel::band(const MatchedCurve& curve) const {
  Band band;
  const Across normals = across(curve);
  const ViewPose& first = matcher_.from_frame().pose;
  std::map<std::string, double> squares;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const ColumnPoint& point = curve.points[i];
    const Mat3 carry = jacobian(matcher_.to(), matcher_.to().points, point) *
                       jacobian(matcher_.from(), matcher_.from().points, point).inverse();
    double variance = 0;
    const auto add = [&](const std::string& cause, double square) {
      variance += square;
      squares[cause] += square;
    };
    const auto count = [&](const std::string& cause, const Vec2& shift) {
      for (const Vec2& normal : normals.beside[i]) add(cause, 0.5 * std::pow(normal.dot(shift), 2));
    };
    for (const Cause& cause : causes_) count(cause.name, shift(point, carry, cause));
    for (const auto& [cause, deviation] : in_second_) add(cause, deviation * deviation);
    for (const Vec3& axis : {first.e_u, first.e_v}) {
      const double magnified = projected(first, point.from, axis).norm();
      for (const auto& [cause, deviation] : in_first_) {
        count(cause, projected(matcher_.to_frame().pose, point.to,
                               carry * (deviation / magnified * axis)));
      }
    }
    band.points.push_back({point.to_uv, normals.smooth[i], std::sqrt(variance)});
  }
  for (std::size_t i = 1; i < band.points.size(); ++i) {
    if (curve.points[i - 1].stretch != curve.points[i].stretch) continue;
    const BandPoint &before = band.points[i - 1], &at = band.points[i];
    band.area_95 += half_width_95 * (before.deviation + at.deviation) * (at.uv - before.uv).norm();
  }
  for (const auto& [cause, sum] : squares) {
    if (sum > 0) band.by_cause[cause] = std::sqrt(sum / double(curve.points.size()));
  }
  return band;
}

double standardised_distance(const Band& band, const Vec2& uv) {
  double nearest = std::numeric_limits<double>::infinity(), standardised = nearest;
  for (const BandPoint& point : band.points) {
    const double apart = (uv - point.uv).norm();
    if (!(apart < nearest)) continue;
    nearest = apart;
    standardised = (uv - point.uv).dot(point.normal) / point.deviation;
  }
  return standardised;
}

Vec3 turning_centre(const std::vector<Vec3>& points) {
  Vec3 low = points.front(), high = low;
  for (const Vec3& x : points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  return 0.5 * (low + high);
}

}  // namespace breast
