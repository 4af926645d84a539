// SPDX-License-Identifier: GPL-3.0-or-later
#include "identification/comparison.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

namespace breast {

namespace {

// Puts the mesh into the second posture; returns the reason if there is none.
std::string take_second_posture(HexMesh& mesh, const MechanicsOptions& mechanics,
                                const IdentifyOptions& options) {
  MechanicsOptions quiet = mechanics;
  quiet.seek_remedy = false;
  quiet.estimate = Estimate::none;
  const Equilibrium free = solve_backward(mesh, options.imaged_gravity, quiet);
  if (!free.converged()) return "stress-free: " + free.record.reason;
  store(free, mesh);
  const Equilibrium second = solve_forward(mesh, options.gravity, quiet);
  if (!second.converged()) return "second posture: " + second.record.reason;
  store(second, mesh);
  return "";
}

std::vector<std::string> row_of(const std::string& name, std::vector<double> errors) {
  std::vector<std::string> row{name, std::to_string(errors.size())};
  if (errors.empty() || std::isnan(errors.front())) return row.insert(row.end(), 4, "-"), row;
  std::sort(errors.begin(), errors.end());
  double sum = 0, squares = 0;
  for (const double error : errors) sum += error, squares += error * error;
  const double n = double(errors.size());
  const std::size_t high = std::size_t(std::ceil(0.95 * n)) - 1;
  for (const double value : {sum / n, std::sqrt(squares / n), errors[high], errors.back()})
    row.push_back(format_fixed(value, 2));
  return row;
}

}  // namespace

Table Comparison::summary() const {
  Table table{{"model", "landmarks", "mean_mm", "rms_mm", "p95_mm", "largest_mm"}, {}};
  const auto add = [&](const std::string& name, const auto& of) {
    std::vector<double> errors;
    for (const ComparedLandmark& one : landmarks) errors.push_back(of(one));
    table.rows.push_back(row_of(name, errors));
  };
  add("as scanned", [](const ComparedLandmark& one) { return one.moved; });
  for (std::size_t s = 0; s < sets.size(); ++s)
    add(sets[s], [s](const ComparedLandmark& one) { return one.sets[s]; });
  add("identified, landmark left out", [](const ComparedLandmark& one) { return one.found; });
  return table;
}

Comparison compare_sets(const HexMesh& mesh, const Observations& seen,
                        const std::vector<SeenPoint>& judged, const Identified& found,
                        const std::vector<ComparedSet>& sets, const IdentifyOptions& options,
                        Progress& progress) {
  Comparison out;
  std::vector<const SeenPoint*> points;
  for (const SeenPoint& point : seen.points) points.push_back(&point);
  for (const SeenPoint& point : judged) points.push_back(&point);
  const auto error = [&](const HexMesh& state, const SeenPoint& point) {
    const Vec3 place = element_position(state, state.points, point.at.element, point.at.local);
    return (found.motion(place) - point.seen).norm();
  };
  for (std::size_t i = 0; i < points.size(); ++i) {
    const SeenPoint& point = *points[i];
    ComparedLandmark one;
    one.name = point.name, one.fitted = i < seen.points.size();
    const Vec3 scanned = element_position(mesh, mesh.imaged, point.at.element, point.at.local);
    one.moved = (found.motion(scanned) - point.seen).norm();
    one.found = one.fitted ? found.landmarks[i].left_out : error(found.second, point);
    out.landmarks.push_back(one);
  }
  const auto begin = std::chrono::steady_clock::now();
  for (const ComparedSet& set : sets) {
    progress.update("compare", -1, set.name);
    HexMesh state = mesh;
    out.sets.push_back(set.name);
    out.refusals.push_back(take_second_posture(state, set.mechanics, options));
    for (std::size_t i = 0; i < points.size(); ++i) {
      out.landmarks[i].sets.push_back(out.refusals.back().empty()
                                          ? error(state, *points[i])
                                          : std::numeric_limits<double>::quiet_NaN());
    }
  }
  out.solve_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return out;
}

}  // namespace breast
