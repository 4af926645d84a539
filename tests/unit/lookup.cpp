// The lookup holds what the matcher finds; the page holds the lookup.
#include "matching/lookup.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fixtures/analytic_breast.hpp"
#include "fixtures/squashed.hpp"
#include "meshing/body_mesh.hpp"
#include "page/page.hpp"
#include "projection/projection.hpp"

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

TEST(Page, IsOneFileWithImagesAndCurves) {
  const Scene scene;
  const MatchLookup lookup = match_lookup(scene.matcher, &scene.band, 5);
  const Mammogram cc = project_mammogram(scene.cc, {.pixel = 1}),
                  mlo = project_mammogram(scene.mlo, {.pixel = 1});
  const std::string page = lookup_page(lookup, cc, mlo, scene.cc);
  EXPECT_EQ(page.find("\"DATA\""), std::string::npos);
  EXPECT_NE(page.find("</html>"), std::string::npos);
  for (const char* outside : {"http:", "https:", "src=", "href=", "fetch("}) {
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  }
  // Base64 of the curves: four characters for three bytes.
  const auto start = page.find("\"curve\":\"") + 9;
  const auto end = page.find('"', start);
  EXPECT_EQ(end - start, 4 * ((lookup.curve.size() * sizeof(float) + 2) / 3));
  EXPECT_THROW(lookup_page(lookup, mlo, cc, scene.cc), Error);
}

// Names come from files: none of their bytes may end a string or the script.
TEST(Page, NamesCannotBecomeCode) {
  Scene scene;
  const Mammogram simulated = project_mammogram(scene.cc, {.pixel = 2});
  const Mammogram mlo = project_mammogram(scene.mlo, {.pixel = 2});
  const MatchLookup whole = match_lookup(scene.matcher, &scene.band, 8);
  const std::size_t scripts = [&] {
    const std::string page = lookup_page(whole, simulated, mlo, scene.cc);
    return page.find("</script>");
  }();
  ASSERT_NE(scripts, std::string::npos);
  for (const std::string hostile :
       {"</script><script>alert(\"1\")</script>\\'&\n", "<!--<script>", "]]>", "\xe2\x80\xa8 and \xe2\x80\xa9", "\x01\x7f\r",
        "\xff\xfe no UTF-8 \xc3", "${x}`x`$(x)", "{{x}}", "\"};x();//", "\xf0\x9f\x98\x80"}) {
    MatchLookup lookup = whole;
    lookup.band_without = {hostile};
    const std::string page = lookup_page(lookup, simulated, mlo, scene.cc);
    EXPECT_EQ(page.find(hostile), std::string::npos) << hostile;
    EXPECT_EQ(page.find("</script>"), page.rfind("</script>")) << hostile;
    for (const char c : page) {
      const auto byte = static_cast<unsigned char>(c);
      ASSERT_TRUE((byte >= ' ' && byte < 0x7f) || c == '\n' || byte >= 0x80) << int(byte);
    }
    for (const char* raw : {"\xe2\x80\xa8", "\xff", "\xf0\x9f"}) EXPECT_EQ(page.find(raw), std::string::npos) << raw;
    EXPECT_NE(page.find("Content-Security-Policy"), std::string::npos);
  }
  MatchLookup lookup = whole;
  lookup.band_without = {"CC</script>\xc3\xa9\xf0\x9f\x98\x80\xff"};
  EXPECT_NE(lookup_page(lookup, simulated, mlo, scene.cc).find("CC\\u003c\\u002fscript\\u003e\\u00e9\\ud83d\\ude00\\ufffd"),
            std::string::npos);
}
