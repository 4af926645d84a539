// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/curve_distance.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"

namespace breast {

namespace {

using Curve = std::vector<Vec3>;

// Lines called "curve", by query.
std::map<int, Curve> curves_of(const PolyLines& lines, const std::string& name) {
  const auto queries = lines.point_data.find("query");
  std::map<int, Curve> curves;
  for (std::size_t l = 0; l < lines.lines.size() && l < lines.line_names.size(); ++l) {
    if (lines.line_names[l] != "curve" || lines.lines[l].size() < 2) continue;
    const int first = lines.lines[l].front();
    const int query = queries == lines.point_data.end()
                          ? 0
                          : int(std::lround(queries->second[std::size_t(first)]));
    Curve& curve = curves[query];
    for (const int point : lines.lines[l]) curve.push_back(lines.points[std::size_t(point)]);
  }
  if (curves.empty())
    throw input_error(name, ": has no line 'curve'; such files are written by cc2mlo");
  return curves;
}

// Normal of the plane of the MLO detector, from all points on it.
Vec3 detector_normal(const PolyLines& lines, const std::string& name) {
  const auto on_detector = [](const std::string& line) {
    if (line == "curve" || line == "arc" || line == "chord") return true;
    return line.ends_with(" in MLO") && !line.starts_with("column");  // markers
  };
  Curve points;
  for (std::size_t l = 0; l < lines.lines.size() && l < lines.line_names.size(); ++l) {
    if (!on_detector(lines.line_names[l])) continue;
    for (const int point : lines.lines[l]) points.push_back(lines.points[std::size_t(point)]);
  }
  Vec3 mean = Vec3::Zero();
  for (const Vec3& point : points) mean += point / double(points.size());
  Mat3 spread = Mat3::Zero();
  for (const Vec3& point : points) spread += (point - mean) * (point - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread);
  if (!(axes.eigenvalues()[1] > 1e-6 * axes.eigenvalues()[2])) {
    throw input_error(name, ": its lines on the detector are straight and span no plane");
  }
  return axes.eigenvectors().col(0);
}

double distance_to(const Curve& curve, const Vec3& point) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < curve.size(); ++i) {
    const Vec3 edge = curve[i + 1] - curve[i];
    const double length = edge.squaredNorm();
    const double at = length > 0 ? std::clamp((point - curve[i]).dot(edge) / length, 0.0, 1.0) : 0;
    nearest = std::min(nearest, (curve[i] + at * edge - point).norm());
  }
  return nearest;
}

void flatten(Curve& curve, const Vec3& normal) {
  for (Vec3& point : curve) point -= point.dot(normal) * normal;
}

}  // namespace

CurveComparison compare_curves(const PolyLines& given, const PolyLines& truth,
                               const std::string& given_name, const std::string& truth_name) {
  std::map<int, Curve> ours = curves_of(given, given_name);
  std::map<int, Curve> theirs = curves_of(truth, truth_name);
  const Vec3 normal = detector_normal(truth, truth_name);
  std::vector<double> distances;
  for (auto& [query, curve] : ours) {
    const auto other = theirs.find(query);
    if (other == theirs.end()) {
      throw input_error(truth_name, ": has no curve for query ", query, " of ", given_name);
    }
    flatten(curve, normal);
    flatten(other->second, normal);
    for (const Vec3& point : curve) distances.push_back(distance_to(other->second, point));
    for (const Vec3& point : other->second) distances.push_back(distance_to(curve, point));
  }
  return {summarise(distances), int(ours.size())};
}

}  // namespace breast
