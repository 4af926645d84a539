// SPDX-License-Identifier: GPL-3.0-or-later
#include "matching/lookup.hpp"

#include <algorithm>
#include <atomic>

#include "core/error.hpp"
#include "matching/band_edges.hpp"

namespace breast {

namespace {

LookupStatus status_of(const MatchedCurve& curve) {
  if (curve.in_air()) return LookupStatus::air;
  if (curve.through_back) return LookupStatus::through_chest_wall;
  return curve.behind_image > 0 ? LookupStatus::behind_image : LookupStatus::matched;
}

void store(const MatchedCurve& curve, const BandModel* model, std::size_t node,
           MatchLookup& lookup) {
  lookup.status[node] = std::uint8_t(status_of(curve));
  if (curve.in_air()) return;
  const auto& points = curve.points;
  lookup.depth[node] = float(points.back().depth);
  lookup.length[node] = float(curve.length);
  const BandLine band = model != nullptr ? drawn_points(curve, model->band(curve)) : BandLine{};
  std::size_t after = 1;  // the first point at or beyond the sample
  for (int k = 0; k < lookup.samples; ++k) {
    const double depth = points.back().depth * k / (lookup.samples - 1);
    while (after + 1 < points.size() && points[after].depth < depth) ++after;
    const ColumnPoint &a = points[after - 1], &b = points[after];
    const double f = std::clamp((depth - a.depth) / std::max(b.depth - a.depth, 1e-12), 0.0, 1.0);
    const std::size_t at = node * std::size_t(lookup.samples) + std::size_t(k);
    const Vec2 uv = a.to_uv + f * (b.to_uv - a.to_uv);
    const Vec3 imaged = a.imaged + f * (b.imaged - a.imaged);
    for (int c = 0; c < 2; ++c) lookup.curve[2 * at + std::size_t(c)] = float(uv[c]);
    for (int c = 0; c < 3; ++c) lookup.imaged[3 * at + std::size_t(c)] = float(imaged[c]);
    if (model == nullptr) continue;
    lookup.deviation[at] = float((1 - f) * band[after - 1].deviation + f * band[after].deviation);
  }
}

}  // namespace

MatchLookup match_lookup(const Matcher& matcher, const BandModel* band, double pitch, int samples,
                         Progress& progress) {
  const ImageFrame& frame = matcher.from_frame();
  if (!(pitch > 0) || !(frame.width / pitch * (frame.height / pitch) < 1e6)) {
    throw input_error("pitch ", pitch, " mm: must be positive and give at most a million points");
  }
  MatchLookup lookup;
  lookup.from_view = frame.view;
  lookup.to_view = matcher.to_frame().view;
  lookup.side = matcher.from().side;
  lookup.pitch = pitch;
  lookup.nu = 1 + int(frame.width / pitch);
  lookup.nv = 1 + int(frame.height / pitch);
  lookup.samples = samples;
  if (band != nullptr) lookup.band_without = band->without();
  const std::size_t nodes = std::size_t(lookup.nu) * std::size_t(lookup.nv),
                    points = nodes * std::size_t(samples);
  lookup.status.assign(nodes, 0);
  lookup.depth.assign(nodes, 0);
  lookup.length.assign(nodes, 0);
  lookup.curve.assign(2 * points, 0);
  lookup.deviation.assign(points, 0);
  lookup.imaged.assign(3 * points, 0);
  std::atomic<int> done{0};
#pragma omp parallel for schedule(dynamic, 1)
  for (int j = 0; j < lookup.nv; ++j) {
    for (int i = 0; i < lookup.nu; ++i) {
      store(matcher.match(pitch * Vec2(i, j)), band, lookup.node(i, j), lookup);
    }
    const int count = ++done;
#pragma omp critical(lookup_progress)
    progress.update("matching", double(count) / lookup.nv, {});
  }
  return lookup;
}

}  // namespace breast
