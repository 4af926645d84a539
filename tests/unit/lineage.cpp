// SPDX-License-Identifier: GPL-3.0-or-later
// Which pairs of files are taken, refused and remarked on, by histories and by what they show.
#include <gtest/gtest.h>

#include <set>

#include "core/error.hpp"
#include "lineage/pairs.hpp"

namespace breast {
namespace {

HistoryEntry made_by(const std::string& tool, const std::vector<std::string>& from) {
  HistoryEntry entry{tool, "0", tool, {}};
  for (const std::string& one : from) entry.inputs.push_back({one + ".file", one});
  return entry;
}

/// The history of a compression of the scan, meshed as `mesh` and solved as `reference`.
History chain(const std::string& scan, const std::string& mesh, const std::string& reference) {
  return {made_by("segment", {scan, "corrected wall"}), made_by("fit-hermite", {scan + " labels"}),
          made_by("hexmesh", {scan + " geometry", scan + " labels"}), made_by("backward", {mesh}),
          made_by("compress", {reference})};
}

PairRule must(std::vector<Shared> agree, std::vector<Shared> may_differ = {}) {
  return {"tool", "A", "B", std::move(agree), std::move(may_differ)};
}

Origin of(const std::string& name, const History& history) {
  return {name + ".file", Stage::result, name, &history};
}

std::string refusal(const PairRule& rule, const Origin& a, const Origin& b,
                    const std::string& accepted = "") {
  try {
    check_pair(rule, a, b, accepted);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Lineage, AScanThatBothComeFromIsOne) {
  const History cc = chain("scan", "mesh", "soft"), mlo = chain("scan", "other mesh", "stiff"),
                elsewhere = chain("other scan", "foreign mesh", "foreign");
  EXPECT_EQ(check_pair(must({Shared::scan}), of("cc", cc), of("mlo", mlo)), "");
  const std::string said = refusal(must({Shared::scan}), of("cc", cc), of("mlo", elsewhere));
  for (const char* part :
       {"cc.file and mlo.file: come from different scans", "scan.file and other scan.file"})
    EXPECT_NE(said.find(part), std::string::npos) << said;
  // A wall that was drawn for another scan, too, does not make the scans one.
  EXPECT_NE(said, "");
}

TEST(Lineage, TheScanItselfIsComparedWithThoseBehindAFile) {
  const History labels{made_by("segment", {"scan"})};
  const Origin made{"labels.vtkhdf", Stage::labels, "labels", &labels};
  EXPECT_EQ(check_pair(must({Shared::scan}), made, origin_of_scan("scan.nrrd", "scan", {})), "");
  EXPECT_NE(refusal(must({Shared::scan}), made, origin_of_scan("other.nrrd", "other", {})), "");
}

TEST(Lineage, MeshAndModelOfAnImageAreThoseOfItsHistory) {
  const History cc = chain("scan", "mesh", "soft"), mesh = chain("scan", "other mesh", "soft too"),
                model = chain("scan", "mesh", "stiff");
  History image = cc;
  image.push_back(made_by("project-mammogram", {"cc"}));
  const PairRule rule = must({Shared::mesh, Shared::model}, {Shared::model});
  EXPECT_EQ(check_pair(rule, of("image", image), of("cc", cc)), "");
  EXPECT_NE(refusal(rule, of("image", image), of("other", mesh)).find("different meshes"),
            std::string::npos);
  EXPECT_NE(refusal(rule, of("image", image), of("stiff", model)).find("--accept-other model"),
            std::string::npos);
  EXPECT_EQ(refusal(rule, of("image", image), of("stiff", model), "model"), "");
  EXPECT_NE(refusal(rule, of("image", image), of("other", mesh), "model"), "");
}

TEST(Lineage, AFileThatSaysNothingIsRemarkedOnAndComparedByPlace) {
  const History cc = chain("scan", "mesh", "soft"), none;
  Origin here = of("cc", cc), foreign = of("foreign", none);
  here.place.extend(Vec3(0, 0, 0)).extend(Vec3(100, 80, 100));
  foreign.place.extend(Vec3(10, 0, 0)).extend(Vec3(110, 80, 100));
  const std::string remark = check_pair(must({Shared::scan}), here, foreign);
  EXPECT_EQ(remark.find("foreign.file: does not say"), 0u) << remark;
  foreign.place = Eigen::AlignedBox3d(Vec3(-150, 0, 0), Vec3(-50, 80, 100));
  EXPECT_NE(refusal(must({Shared::scan}), here, foreign).find("different places"),
            std::string::npos);
  foreign.place = here.place;
  here.nipple = Vec3(50, 0, 50), foreign.nipple = Vec3(50, 0, 70);
  EXPECT_NE(refusal(must({Shared::scan}), here, foreign).find("nipples 20 mm apart"),
            std::string::npos);
}

TEST(Lineage, SidesAndPatientsMustAgreeWhereBothStateThem) {
  const History none;
  Origin a = of("a", none), b = of("b", none);
  const PairRule rule = must({Shared::side, Shared::patient});
  a.side = Side::left, a.patient = "7", b.patient = "7";
  EXPECT_EQ(check_pair(rule, a, b), "") << "a file without a side";
  b.side = Side::right;
  EXPECT_NE(refusal(rule, a, b).find("left and right"), std::string::npos);
  b.side = Side::left, b.patient = "8";
  EXPECT_NE(refusal(rule, a, b).find("patients"), std::string::npos);
  b.patient = "";
  EXPECT_EQ(check_pair(rule, a, b).find("b.file: states no Patient ID"), 0u);
}

TEST(Lineage, EachFileIsRemarkedOnOnce) {
  const History cc = chain("scan", "mesh", "soft"), none;
  std::vector<std::string> remarks;
  Pairs pairs("render", [&](const std::string& text) { remarks.push_back(text); });
  for (int i = 0; i < 2; ++i) pairs.check("first FILE", of("cc", cc), "FILE", of("foreign", none));
  EXPECT_EQ(remarks.size(), 1u);
  EXPECT_THROW(pairs.check("no", of("cc", cc), "row", of("cc", cc)), std::logic_error);
}

TEST(Lineage, TheTableHasEveryPairOnce) {
  std::set<std::string> seen;
  for (const PairRule& rule : pair_rules()) {
    EXPECT_TRUE(seen.insert(rule.tool + "|" + rule.first + "|" + rule.second).second) << rule.tool;
    EXPECT_FALSE(rule.must_agree.empty());
    for (const Shared what : rule.may_differ)
      EXPECT_NE(std::find(rule.must_agree.begin(), rule.must_agree.end(), what),
                rule.must_agree.end());
  }
}

}  // namespace
}  // namespace breast
