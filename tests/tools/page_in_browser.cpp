// SPDX-License-Identifier: GPL-3.0-or-later
// The page of both views in a real browser: it draws what the matcher finds, in both directions, and
// obeys mouse, keyboard and touch. Needs Chromium (Debian: chromium) and Python.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "core/atomic_file.hpp"
#include "fixtures/chain_files.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "image/volume.hpp"
#include "io/mammogram_file.hpp"
#include "io/volume_file.hpp"
#include "matching/correspondence.hpp"
#include "projection/projection.hpp"

using namespace breast;

namespace {

// A line of truth: view, point, depth, nipple distance, then the curve's ends and its length.
void write_truth(std::ofstream& out, const Matcher& matcher, const Vec2& uv) {
  const MatchedCurve curve = matcher.match(uv);
  ASSERT_FALSE(curve.in_air()) << uv.transpose();
  const Vec2 first = curve.points.front().to_uv, last = curve.points.back().to_uv;
  double posterior = 1e9;
  for (const auto& stretch : matcher.nipple_arc(uv)) {
    for (const Vec2& at : stretch) posterior = std::min(posterior, at.x());
  }
  out << view_name(matcher.from_frame().view) << ' ' << uv.x() << ' ' << uv.y() << ' '
      << curve.points.back().depth << ' ' << matcher.nipple_distance(uv) << ' ' << first.x() << ' '
      << first.y() << ' ' << last.x() << ' ' << last.y() << ' ' << curve.length << ' ' << posterior
      << '\n';
}

Volume<std::int16_t> scan() {
  Grid grid;
  grid.size = {70, 50, 70};
  grid.spacing = Vec3::Constant(3);
  grid.origin = Vec3(-105, -20, -105);
  Volume<std::int16_t> volume(grid);
  for (std::size_t i = 0; i < volume.voxels.size(); ++i)
    volume.voxels[i] = std::int16_t(100 + i % 70);
  return volume;
}

void write_page(const std::filesystem::path& folder, const std::string& name,
                const std::vector<std::string>& scan) {
  std::vector<std::string> words{"page", ".", "--quiet"};
  words.insert(words.begin() + 2, scan.begin(), scan.end());
  const ToolResult page = run_tool("tabulate", words, folder);
  ASSERT_EQ(page.exit_code, 0) << page.err;
  write_text(folder / name, page.out);
}

}  // namespace

class PageInBrowser : public testing::TestWithParam<Side> {};

TEST_P(PageInBrowser, DrawsWhatTheMatcherFindsAndObeysMouseKeysAndTouch) {
  if (std::system("command -v chromium chromium-browser google-chrome > /dev/null") != 0) {
    GTEST_SKIP() << "no Chromium: apt-get install chromium";
  }
  const ScratchFolder folder;
  HexMesh body = fixtures::landmarked_breast(8);
  body.side = body.geometry->side = GetParam();
  const HexMesh cc = fixtures::squashed(body, View::cc, 0.6),
                mlo = fixtures::squashed(body, View::mlo, 0.5);
  write_mesh(folder / "cc.vtkhdf", cc);
  write_mesh(folder / "mlo.vtkhdf", mlo);
  write_volume(folder / "scan.nrrd", scan());
  write_mammogram(folder / "cc.vti", project_mammogram(cc, {.pixel = 0.5}));
  write_mammogram(folder / "mlo.vti", project_mammogram(mlo, {.pixel = 0.5}));
  ASSERT_EQ(
      run_tool("match-lookup", {"cc.vtkhdf", "mlo.vtkhdf", "lookup.h5", "--both-ways", "--quiet"},
               folder.path())
          .exit_code,
      0);
  write_page(folder.path(), "page.html", {"scan.nrrd"});
  write_page(folder.path(), "without.html", {});
  const Matcher there(cc, mlo), back(mlo, cc);
  {
    std::ofstream truth(folder / "truth.txt");
    for (const double u : {0.3, 0.5}) {
      write_truth(truth, there, {u * there.from_frame().width, 0.45 * there.from_frame().height});
      write_truth(truth, back, {u * back.from_frame().width, 0.55 * back.from_frame().height});
    }
  }
  const std::string command =
      "python3 '" BREAST_SOURCE "/tests/page/check_page.py' '" + folder.path().string() + "' >&2";
  EXPECT_EQ(std::system(command.c_str()), 0);
}

INSTANTIATE_TEST_SUITE_P(Sides, PageInBrowser, testing::Values(Side::left, Side::right));
