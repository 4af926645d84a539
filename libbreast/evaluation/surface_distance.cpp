// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/surface_distance.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "surface/triangle_tree.hpp"

namespace breast {

namespace {

std::vector<WeightedDistance> samples_to(const TriMesh& from, const TriangleTree& target) {
  const bool points = from.triangles.empty();
  std::vector<WeightedDistance> samples(points ? from.points.size() : from.triangles.size());
#pragma omp parallel for num_threads(threads()) schedule(dynamic, 256)
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (points) {
      samples[i] = {target.distance(from.points[i]), 1};
      continue;
    }
    const auto& t = from.triangles[i];
    const Vec3 &a = from.points[std::size_t(t[0])], &b = from.points[std::size_t(t[1])],
               &c = from.points[std::size_t(t[2])];
    samples[i] = {target.distance((a + b + c) / 3), (b - a).cross(c - a).norm() / 2};
  }
  return samples;
}

Distances summary(std::vector<WeightedDistance> samples) {
  if (std::none_of(samples.begin(), samples.end(),
                   [](const WeightedDistance& s) { return s.weight > 0; }))
    throw input_error("surface has no area: every triangle is degenerate");
  return summarise(std::move(samples));
}

// Both directions have the same weight, whatever their number of triangles or points.
void normalise(std::vector<WeightedDistance>& samples) {
  double total = 0;
  for (const WeightedDistance& s : samples) total += s.weight;
  for (WeightedDistance& s : samples) s.weight /= total;
}

}  // namespace

SurfaceComparison compare_surfaces(const TriMesh& given, const TriMesh& truth) {
  if (given.points.empty()) throw input_error("the given surface is empty");
  if (truth.points.empty()) throw input_error("the true surface is empty");
  std::vector<WeightedDistance> forth = samples_to(given, TriangleTree(truth));
  std::vector<WeightedDistance> back = samples_to(truth, TriangleTree(given));
  SurfaceComparison result;
  result.to_truth = summary(forth);
  result.from_truth = summary(back);
  normalise(forth);
  normalise(back);
  forth.insert(forth.end(), back.begin(), back.end());
  result.both = summary(std::move(forth));
  return result;
}

}  // namespace breast
