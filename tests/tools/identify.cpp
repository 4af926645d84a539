// SPDX-License-Identifier: GPL-3.0-or-later
// identify as a program: the set it writes runs the chain and narrows the band; slips in landmarks are named.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "core/table.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "fixtures/seen_skin.hpp"
#include "io/mesh_file.hpp"
#include "io/surface_file.hpp"

namespace breast {
namespace {

// A set with a covariance, that makes this small breast move.
const std::string set_text =
    "tissue\tlaw\tdensity_g_per_mm3\ta10_Pa\ta01_Pa\ta20_Pa\ta02_Pa\ta11_Pa\ta_Pa\tb\tc_Pa"
    "\tcompression_percent\tprestretch_percent\tsupport\tln_sd\tcorrelation_stiffness"
    "\tcorrelation_wall\n"
    "fat\tpolynomial\t0.001\t62\t60\t450\t760\t944\t-\t-\t-\t-\t-\t-\t-\t-\t-\n"
    "fibroglandular\tpolynomial\t0.001\t66\t56\t898\t1544\t1890\t-\t-\t-\t-\t-\t-\t-\t-\t-\n"
    "skin\texponential\t0.001\t-\t-\t-\t-\t-\t92.39\t4.4\t-203.40\t5\t3\t-\t-\t-\t-\n"
    "wall\tsupport\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\tslide:0.01\t-\t-\t-\n"
    "cut\tsupport\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\tspring:0.01\t-\t-\t-\n"
    "stiffness\tuncertainty\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\t0.7\t1\t-0.2\n"
    "wall\tuncertainty\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\t0.7\t-0.2\t1\n";

struct Mark {
  std::string name;
  Vec3 prone, supine;
};

class IdentifyTool : public testing::Test {
 protected:
  void SetUp() override {
    write_mesh(folder_ / "mesh.vtkhdf", analytic_breast_mesh(5));
    write_text(folder_ / "set.tsv", set_text);
  }
  int run(const std::string& line) {
    said_ = run_line(line, folder_.path());
    return said_.exit_code;
  }
  Report report(const std::string& name) const {
    return Report::parse(read_text(folder_ / name), name);
  }
  // Marks of the breast moved with another set: fat and gland at 70 %, a wall of 0.016 kPa/mm.
  std::vector<Mark> marks() {
    const std::string other =
        " --materials set.tsv --scale fat=70 --scale fibroglandular=70 --wall slide:0.016";
    EXPECT_EQ(run("backward mesh.vtkhdf other.vtkhdf --estimate none" + other), 0) << said_.err;
    EXPECT_EQ(run("forward other.vtkhdf supine.vtkhdf --estimate none" + other), 0) << said_.err;
    const HexMesh supine = read_mesh(folder_ / "supine.vtkhdf", {.reference = true});
    std::vector<Mark> list;
    for (int k = 0; k < 12; ++k) {
      const int e = (k * 11 + 2) % supine.elements();
      const Vec3 local(0.1, 0.2, -0.3);
      list.push_back({"m" + std::to_string(k), element_position(supine, supine.imaged, e, local),
                      element_position(supine, supine.points, e, local)});
    }
    return list;
  }
  void write_marks(const std::vector<Mark>& marks) const {
    Table table{{"landmark", "prone_x_mm", "prone_y_mm", "prone_z_mm", "supine_x_mm", "supine_y_mm",
                 "supine_z_mm"},
                {}};
    for (const Mark& mark : marks) {
      std::vector<std::string> row{mark.name};
      for (const Vec3& x : {mark.prone, mark.supine})
        for (const double value : x) row.push_back(format_number(value));
      table.rows.push_back(row);
    }
    write_table(folder_ / "pairs.tsv", table);
  }
  // One line that says `words`, and no set.
  void refused(const std::vector<Mark>& marks, int exit_code, const std::string& words,
               const std::string& more = "") {
    SCOPED_TRACE(words);
    write_marks(marks);
    EXPECT_EQ(
        run("identify mesh.vtkhdf never.tsv --materials set.tsv --quiet --landmarks pairs.tsv " +
            more),
        exit_code);
    EXPECT_NE(said_.err.find(words), std::string::npos) << said_.err;
    EXPECT_EQ(said_.error_lines(), 1) << said_.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "never.tsv"));
  }

  ScratchFolder folder_;
  ToolResult said_;
};

TEST_F(IdentifyTool, ItsSetRunsTheChainAndNarrowsTheBand) {
  write_marks(marks());
  ASSERT_EQ(
      run("identify mesh.vtkhdf mine.tsv --materials set.tsv --parameters stiffness,wall --landmarks "
          "pairs.tsv --observer-error 0.3 --table marks.tsv --second second.vtkhdf --report i.json"),
      0)
      << said_.err;
  const Report found = report("i.json");
  EXPECT_NEAR(found.number("parameters/stiffness/factor"), 0.7, 0.03);
  EXPECT_NEAR(std::log(found.number("parameters/wall/factor")), std::log(1.6),
              found.number("parameters/wall/ln_sd"));
  EXPECT_LT(found.number("left_out_mean_mm"), 0.3);
  EXPECT_LE(found.number("pairs"), 25);
  EXPECT_NE(said_.out.find("known to"), std::string::npos) << said_.out;
  EXPECT_EQ(read_table(folder_ / "marks.tsv").rows.size(), 12u);
  EXPECT_EQ(read_mesh(folder_ / "second.vtkhdf").landmarks.size(),
            read_mesh(folder_ / "mesh.vtkhdf").landmarks.size());
  double width[2] = {0, 0};
  for (const std::string set : {"set", "mine"}) {
    const std::string with = " --materials " + set + ".tsv";
    ASSERT_EQ(run("backward mesh.vtkhdf r.vtkhdf --estimate none" + with), 0) << said_.err;
    for (const std::string view : {"CC", "MLO"}) {
      ASSERT_EQ(run("compress r.vtkhdf " + view +
                    ".vtkhdf --reduction 20 --standoff 10 --estimate none --view " + view + with),
                0)
          << said_.err;
      ASSERT_EQ(run("sensitivity r.vtkhdf " + view + ".vtkhdf " + view + "-d.vtkhdf --table t.tsv" +
                    with),
                0)
          << said_.err;
    }
    ASSERT_EQ(run("cc2mlo CC-d.vtkhdf MLO-d.vtkhdf c.vtp --point 40,67 --band --report b.json"), 0)
        << said_.err;
    const Report band = report("b.json");
    EXPECT_EQ(band.text("band/covariance_of"), set + ".tsv") << "as the files state";
    width[set == "mine"] = std::hypot(band.number("band/deviation_mm/materials_1"),
                                      band.number("band/deviation_mm/materials_2"));
  }
  EXPECT_LT(width[1], 0.6 * width[0]);
  EXPECT_EQ(run("cc2mlo CC-d.vtkhdf MLO-d.vtkhdf c.vtp --point 40,67 --band --materials victre"),
            0);
  EXPECT_NE(said_.err.find("no covariance"), std::string::npos) << said_.err;
}

TEST_F(IdentifyTool, SlipsInLandmarksAreNamed) {
  const std::vector<Mark> good = marks();
  const auto changed = [&](const std::function<void(Mark&)>& change) {
    std::vector<Mark> list = good;
    for (Mark& mark : list) change(mark);
    return list;
  };
  const auto ras = [](const Vec3& x) { return Vec3(-x.x(), -x.y(), x.z()); };
  refused(changed([](Mark& m) { m.prone += Vec3(0, 60, 0), m.supine += Vec3(0, 60, 0); }), 2,
          "outside the body");
  refused(changed([](Mark& m) {
            const Vec3 far(0, 150, 0);  // as after a breast that moves far
            m.supine = m.prone, m.prone += far;
          }),
          2, "seem to be interchanged");
  refused(changed([&](Mark& m) { m.prone = ras(m.prone), m.supine = ras(m.supine); }), 2, "RAS");
  refused(changed([](Mark& m) { m.prone /= 1000, m.supine /= 1000; }), 2, "metres");
  refused(changed([](Mark& m) { m.supine += Vec3(500, 0, 0); }), 2, "would have moved");
  std::vector<Mark> list = good;
  list[3].prone += Vec3(0, -300, 0);
  refused(list, 2, "landmark 'm3' lies");
  refused({}, 2, "no landmark");
  list = good;
  list[4].name = "m5";
  refused(list, 2, "appears twice");
  list = good;
  list[5].prone = list[4].prone, list[5].supine = list[4].supine + Vec3(0, 0, 60);
  refused(list, 2, "contradict each other");
  refused({good[0]}, 2, "too few data", "--prior none");
  list = good;
  std::swap(list[2].supine, list[7].supine);
  refused(list, 2, "seem to be interchanged");
  list = good;
  list[6].supine += Vec3(40, 20, 40);
  refused(list, 3, "landmark 'm6' lies");
  EXPECT_EQ(run("identify mesh.vtkhdf never.tsv"), 2);
  EXPECT_EQ(
      run("identify mesh.vtkhdf never.tsv --nipple 1,2,3 --parameters stiffnes --materials invivo"),
      2);
  EXPECT_EQ(
      run("identify mesh.vtkhdf never.tsv --nipple 1,2,3 --parameters wall --wall held --materials invivo"),
      2);
}

TEST_F(IdentifyTool, PairsMarkedInSlicerAreTakenWhicheverWayTheyAreKept) {
  const std::vector<Mark> good = marks();
  const auto list = [](const std::string& prefix, const std::vector<Mark>& marks, bool supine,
                       bool ras) {
    std::string points;
    for (std::size_t k = 0; k < marks.size(); ++k) {
      Vec3 x = supine ? marks[k].supine : marks[k].prone;
      if (ras) x = Vec3(-x.x(), -x.y(), x.z());
      points += std::string(k > 0 ? "," : "") + "{\"label\":\"" + prefix + marks[k].name +
                "\",\"position\":[" + format_number(x.x()) + "," + format_number(x.y()) + "," +
                format_number(x.z()) + "]}";
    }
    return "{\"type\":\"Fiducial\",\"coordinateSystem\":\"" + std::string(ras ? "RAS" : "LPS") +
           "\",\"controlPoints\":[" + points + "]}";
  };
  const auto file = [&](const std::string& name, const std::string& lists) {
    write_text(
        folder_ / name,
        "{\"@schema\":\"https://raw.githubusercontent.com/slicer/slicer/master/Modules/Loadable/Markups/Resources/"
        "Schema/markups-schema-v1.0.3.json#\",\"markups\":[" +
            lists + "]}");
  };
  write_marks(good);
  file("prone.mrk.json", list("prone-", good, false, false));
  file("supine.mrk.json", list("supine-", good, true, true));
  file("both.mrk.json", list("", good, false, true) + "," + list("", good, true, false));
  const std::string line =
      "identify mesh.vtkhdf mine.tsv --materials set.tsv --parameters stiffness --compare seed2008 "
      "--table marks.tsv --report i.json ";
  std::vector<double> factors;
  for (const char* landmarks :
       {"--landmarks pairs.tsv", "--landmarks prone.mrk.json --second-landmarks supine.mrk.json",
        "--landmarks both.mrk.json"}) {
    ASSERT_EQ(run(line + landmarks), 0) << landmarks << said_.err;
    factors.push_back(report("i.json").number("parameters/stiffness/factor"));
  }
  EXPECT_NEAR(factors[1], factors[0], 1e-6);
  EXPECT_NEAR(factors[2], factors[0], 1e-6);
  const Table table = read_table(folder_ / "marks.tsv");
  for (std::size_t row = 0; row < table.rows.size(); ++row)
    EXPECT_LT(table.number(row, "left_out_mm"), table.number(row, "seed2008_mm"))
        << table.cell(row, "landmark");
  EXPECT_NE(said_.out.find("identified, landmark left out\t12"), std::string::npos) << said_.out;
  std::vector<Mark> fewer = good;
  fewer.pop_back();
  file("fewer.mrk.json", list("supine-", fewer, true, false));
  const auto refused_line = [&](const std::string& more, const std::string& words) {
    EXPECT_EQ(run("identify mesh.vtkhdf never.tsv --quiet --materials set.tsv " + more), 2) << more;
    EXPECT_NE(said_.err.find(words), std::string::npos) << said_.err;
    EXPECT_EQ(said_.error_lines(), 1) << said_.err;
  };
  refused_line("--landmarks prone.mrk.json --second-landmarks fewer.mrk.json",
               "'m11' has no mark of the other posture");
  refused_line("--landmarks prone.mrk.json", "no mark of the other posture");
  refused_line("--landmarks pairs.tsv --second-landmarks supine.mrk.json",
               "goes with points of 3D Slicer");
  refused_line("--landmarks prone.mrk.json --second-landmarks prone.mrk.json --labels mesh.vtkhdf",
               "must be given together");
  refused_line("--nipple 1,2,3 --second-landmarks supine.mrk.json", "needs --landmarks");
}

TEST_F(IdentifyTool, OfTheNippleAloneItSaysThatMostIsThePrior) {
  marks();
  const HexMesh supine = read_mesh(folder_ / "supine.vtkhdf");
  const Vec3 at = landmark_position(supine, supine.points, *supine.landmark("nipple"));
  const std::string place =
      format_number(at.x()) + "," + format_number(at.y()) + "," + format_number(at.z());
  ASSERT_EQ(run("identify mesh.vtkhdf mine.tsv --materials set.tsv --nipple=" + place), 0)
      << said_.err;
  EXPECT_NE(said_.err.find("mostly the prior"), std::string::npos) << said_.err;
  EXPECT_NE(said_.out.find("not determined by these data"), std::string::npos) << said_.out;
}

TEST_F(IdentifyTool, ASurfaceAndForcesAreTaken) {
  marks();
  const HexMesh supine = read_mesh(folder_ / "supine.vtkhdf", {.reference = true});
  const SeenSurface seen = fixtures::seen_skin(supine, 4);
  TriMesh skin;
  skin.points = seen.points, skin.normals = seen.normals;
  write_surface(folder_ / "skin.vtp", skin);
  ASSERT_EQ(
      run("identify mesh.vtkhdf mine.tsv --materials set.tsv --parameters stiffness,wall --surface "
          "skin.vtp --report i.json"),
      0)
      << said_.err;
  EXPECT_GT(report("i.json").number("surface_points"), 5);
  EXPECT_LT(report("i.json").number("parameters/stiffness/factor"), 0.95);
  ASSERT_EQ(
      run("compress other.vtkhdf cc.vtkhdf --view CC --thickness 60 --standoff 5 --edge-radius 5 --estimate "
          "none --report c.json --materials set.tsv --scale fat=70 --scale fibroglandular=70 --wall slide:0.016"),
      0)
      << said_.err;
  write_text(folder_ / "f.tsv", "thickness_mm\tforce_N\n60\t" +
                                    format_number(report("c.json").number("force_N")) + "\n");
  ASSERT_EQ(
      run("identify mesh.vtkhdf mine.tsv --materials set.tsv --parameters stiffness --force-thickness f.tsv "
          "--report i.json"),
      0)
      << said_.err;
  EXPECT_LT(report("i.json").number("parameters/stiffness/factor"), 0.97);
}

}  // namespace
}  // namespace breast
