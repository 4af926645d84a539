// SPDX-License-Identifier: GPL-3.0-or-later
// The lookup holds what the matcher finds; the page holds the lookup.
#include "matching/lookup.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fixtures/analytic_breast.hpp"
#include "fixtures/squashed.hpp"
#include "meshing/body_mesh.hpp"
#include "page/page.hpp"
#include "page/parts.hpp"
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
  Matcher reverse{mlo, cc};
  Mammogram cc_image = project_mammogram(cc, {.pixel = 2}),
            mlo_image = project_mammogram(mlo, {.pixel = 2});
  MatchLookup there = match_lookup(matcher, &band, 8), back = match_lookup(reverse, nullptr, 8);
  PageContents contents() const {
    return {.matcher = matcher, .there = there, .back = back, .from = cc_image, .to = mlo_image};
  }
};

// How many bytes an array of the page holds: base64 has four characters for three bytes.
std::size_t bytes_of(const std::string& page, const std::string& name, std::size_t from = 0) {
  const auto start = page.find("\"" + name + "\":\"", from) + name.size() + 4;
  const std::string text = page.substr(start, page.find('"', start) - start);
  return text.size() / 4 * 3 - std::size_t(std::count(text.end() - 2, text.end(), '='));
}

// A scan that covers `mesh` and more.
Volume<float> scan_about(const HexMesh& mesh) {
  Grid grid;
  const Box box = imaged_box(mesh);
  grid.origin = box.low - Vec3::Constant(60);
  for (int c = 0; c < 3; ++c) grid.size[std::size_t(c)] = int((box.high - box.low)[c] + 120) / 3;
  grid.spacing = Vec3::Constant(3);
  Volume<float> scan(grid);
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j) {
      for (int i = 0; i < grid.size[0]; ++i) scan.at(i, j, k) = float(i + 2 * j + 3 * k);
    }
  }
  return scan;
}

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

TEST(Page, IsOneFileWithImagesAndCurvesOfBothDirections) {
  const Scene scene;
  const std::string page = lookup_page(scene.contents());
  EXPECT_EQ(page.find("\"DATA\""), std::string::npos);
  EXPECT_NE(page.find("</html>"), std::string::npos);
  EXPECT_NE(page.find("Research only, not a medical device"), std::string::npos);
  for (const char* outside :
       {"http:", "https:", "src=", "href=", "fetch(", "/*SCRIPT*/", "/*STYLE*/"}) {
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  }
  std::size_t at = page.find("\"lookups\"");
  for (const MatchLookup* lookup : {&scene.there, &scene.back}) {
    const auto air = std::size_t(std::count(lookup->status.begin(), lookup->status.end(), 0));
    const std::size_t nodes = lookup->status.size() - air, samples = std::size_t(lookup->samples);
    EXPECT_GT(nodes, 20u);
    EXPECT_EQ(bytes_of(page, "status", at), lookup->status.size());
    EXPECT_EQ(bytes_of(page, "curve", at), nodes * samples * 2 * sizeof(std::int16_t));
    EXPECT_EQ(bytes_of(page, "imaged", at), nodes * samples * 3 * sizeof(std::int16_t));
    at = page.find("\"imaged\"", at) + 1;
  }
  EXPECT_NE(page.find("\"scan\":null"), std::string::npos);
  PageContents wrong = {.matcher = scene.matcher,
                        .there = scene.there,
                        .back = scene.back,
                        .from = scene.mlo_image,
                        .to = scene.cc_image};
  EXPECT_THROW(lookup_page(wrong), Error);
  EXPECT_THROW(
      lookup_page({scene.matcher, scene.there, scene.there, scene.cc_image, scene.mlo_image}),
      Error);
}

TEST(Page, ShowsOnlyTheBreastOfTheScan) {
  const Scene scene;
  const Volume<float> scan = scan_about(scene.cc);
  PageContents contents{scene.matcher,  scene.there,     scene.back,
                        scene.cc_image, scene.mlo_image, &scan};
  const std::string page = lookup_page(contents);
  const Vec3 extent = imaged_box(scene.cc).high - imaged_box(scene.cc).low + Vec3::Constant(30);
  const auto voxels = double(bytes_of(page, "grey", page.find("\"scan\":{")));
  EXPECT_LT(voxels, 1.05 * (extent.x() + 1) * (extent.y() + 1) * (extent.z() / 2 + 1));
  EXPECT_GT(voxels, 0.2 * extent.x() * extent.y() * extent.z() / 2);
  Volume<float> elsewhere = scan;
  elsewhere.grid.origin += Vec3(1000, 0, 0);
  contents.scan = &elsewhere;
  EXPECT_THROW(lookup_page(contents), Error);
}

// Names come from files: none of their bytes may end a string or the script.
TEST(Page, NamesCannotBecomeCode) {
  Scene scene;
  ASSERT_NE(lookup_page(scene.contents()).find("</script>"), std::string::npos);
  for (const std::string hostile :
       {"</script><script>alert(\"1\")</script>\\'&\n", "<!--<script>", "]]>",
        "\xe2\x80\xa8 and \xe2\x80\xa9", "\x01\x7f\r", "\xff\xfe no UTF-8 \xc3", "${x}`x`$(x)",
        "{{x}}", "\"};x();//", "\xf0\x9f\x98\x80"}) {
    scene.there.band_without = {hostile};
    const std::string page = lookup_page(scene.contents());
    EXPECT_EQ(page.find(hostile), std::string::npos) << hostile;
    EXPECT_EQ(page.find("</script>"), page.rfind("</script>")) << hostile;
    for (const char c : page) {
      const auto byte = static_cast<unsigned char>(c);
      ASSERT_TRUE((byte >= ' ' && byte < 0x7f) || c == '\n' || byte >= 0x80) << int(byte);
    }
    for (const char* raw : {"\xe2\x80\xa8", "\xff", "\xf0\x9f"})
      EXPECT_EQ(page.find(raw), std::string::npos) << raw;
    EXPECT_NE(page.find("Content-Security-Policy"), std::string::npos);
  }
  scene.there.band_without = {"CC</script>\xc3\xa9\xf0\x9f\x98\x80\xff"};
  EXPECT_NE(lookup_page(scene.contents())
                .find("CC\\u003c\\u002fscript\\u003e\\u00e9\\ud83d\\ude00\\ufffd"),
            std::string::npos);
}
