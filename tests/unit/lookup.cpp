// SPDX-License-Identifier: GPL-3.0-or-later
// The lookup holds what the matcher finds.
#include "matching/lookup.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fixtures/analytic_breast.hpp"
#include "fixtures/squashed.hpp"
#include "meshing/body_mesh.hpp"

using namespace breast;
using namespace breast::fixtures;

namespace {

HexMesh body() {
  HexMesh mesh = body_mesh(analytic_breast(), {.size = dome_near(8)});
  mesh.reference = mesh.imaged;
  return mesh;
}

struct Scene {
  HexMesh cc = squashed(body(), View::cc, 0.5), mlo = squashed(body(), View::mlo, 0.6);
  Matcher matcher{cc, mlo};
  BandModel band{matcher, {}, {}, {{"picking", 1, "mm", ""}, {"fat", 1, "", ""}}};
};

}  // namespace

TEST(Lookup, HoldsTheCurvesOfTheMatcher) {
  const Scene scene;
  const MatchLookup lookup = match_lookup(scene.matcher, &scene.band, 5);
  EXPECT_EQ(lookup.band_without, std::vector<std::string>{"fat"});
  int matched = 0, air = 0;
  for (int j = 0; j < lookup.nv; ++j) {
    for (int i = 0; i < lookup.nu; ++i) {
      const std::size_t node = lookup.node(i, j);
      const MatchedCurve curve = scene.matcher.match(5 * Vec2(i, j));
      EXPECT_EQ(lookup.status[node] == 0, curve.in_air());
      if (curve.in_air()) {
        ++air;
        continue;
      }
      ++matched;
      EXPECT_NEAR(lookup.depth[node], curve.points.back().depth, 1e-4);
      EXPECT_NEAR(lookup.length[node], curve.length, 1e-4);
      for (int k = 0; k < lookup.samples; k += 6) {
        const std::size_t at = node * std::size_t(lookup.samples) + std::size_t(k);
        EXPECT_LT(distance_to_curve(curve, Vec2(lookup.curve[2 * at], lookup.curve[2 * at + 1])),
                  1e-3);
        EXPECT_GT(lookup.deviation[at], 0);
      }
    }
  }
  EXPECT_GT(matched, 50);
  EXPECT_GT(air, 20);
}

TEST(Lookup, TheSameForAnyNumberOfThreads) {
  const Scene scene;
  const int before = threads();
  set_threads(1);
  const MatchLookup one = match_lookup(scene.matcher, &scene.band, 8);
  set_threads(2);
  const MatchLookup two = match_lookup(scene.matcher, &scene.band, 8);
  set_threads(before);
  EXPECT_EQ(one.curve, two.curve);
  EXPECT_EQ(one.deviation, two.deviation);
  EXPECT_THROW(match_lookup(scene.matcher, nullptr, 0), Error);
  EXPECT_THROW(match_lookup(scene.matcher, nullptr, 0.001), Error);
}
