// SPDX-License-Identifier: GPL-3.0-or-later
// A breast on a wall to slide on, through the programs: what a material set says, what options say,
// and what is refused.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "core/table.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "fixtures/shapes.hpp"
#include "io/mesh_file.hpp"
#include "material/material_set.hpp"

namespace breast {
namespace {

class SlidingTools : public testing::Test {
 protected:
  void SetUp() override {
    write_mesh(folder_ / "mesh.vtkhdf", analytic_breast_mesh(5));
    std::ofstream(folder_ / "soft.tsv")
        << "tissue\tlaw\tdensity_g_per_mm3\ta10_Pa\ta01_Pa\ta20_Pa\ta02_Pa\ta11_Pa\ta_Pa\tb\tc_Pa"
           "\tcompression_percent\tprestretch_percent\tsupport\n"
           "fat\tpolynomial\t0.001\t62\t60\t450\t760\t944\t-\t-\t-\t-\t-\t-\n"
           "fibroglandular\tpolynomial\t0.001\t66\t56\t898\t1544\t1890\t-\t-\t-\t-\t-\t-\n"
           "skin\texponential\t0.001\t-\t-\t-\t-\t-\t92.39\t4.4\t-203.40\t5\t3\t-\n"
           "wall\tsupport\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\tslide:0.02\n"
           "cut\tsupport\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\t-\tspring:0.01\n";
  }
  int run(const std::string& line) {
    said_ = run_line(line, folder_.path());
    return said_.exit_code;
  }
  Report report(const std::string& name) const {
    return Report::parse(read_text(folder_ / name), name);
  }

  ScratchFolder folder_;
  ToolResult said_;
};

TEST_F(SlidingTools, WholeChainWithWhatTheMaterialSetSays) {
  ASSERT_EQ(run("backward mesh.vtkhdf reference.vtkhdf --materials soft.tsv --report b.json"), 0)
      << said_.err;
  const Report backward = report("b.json");
  EXPECT_EQ(backward.text("wall"), "slide:0.02");
  EXPECT_EQ(backward.text("cut"), "spring:0.01");
  EXPECT_NE(backward.text("model").find("slides on the chest wall"), std::string::npos);
  EXPECT_LT(backward.number("closure_mm"), 1e-8);
  EXPECT_LE(backward.number("newton_iterations"), 15);
  ASSERT_EQ(run("forward reference.vtkhdf supine.vtkhdf --report s.json"), 0) << said_.err;
  const HexMesh supine =
      read_mesh(folder_ / "supine.vtkhdf", {.reference = true, .geometry = true});
  double slid = 0, off = 0;
  for (const int node : nodes_of(supine, supine.pectoral_faces)) {
    const auto before = supine.geometry->thorax->at(supine.imaged[std::size_t(node)]),
               after = supine.geometry->thorax->at(supine.points[std::size_t(node)]);
    ASSERT_TRUE(before && after);
    off = std::max(off, std::abs(after->value - before->value));
    slid = std::max(slid,
                    (supine.points[std::size_t(node)] - supine.imaged[std::size_t(node)]).norm());
  }
  EXPECT_GT(slid, 2);
  EXPECT_LT(off, 1e-9);
  ASSERT_EQ(run("sensitivity reference.vtkhdf supine.vtkhdf d.vtkhdf --table d.tsv"), 0)
      << said_.err;
  const Table table = read_table(folder_ / "d.tsv");
  int supports = 0;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const std::string& parameter = table.cell(r, "parameter");
    supports += parameter == "wall" || parameter == "cut";
  }
  EXPECT_GE(supports, 2);
  // At this reduction the paddle hardly touches the breast, which is said.
  ASSERT_EQ(run("compress reference.vtkhdf cc.vtkhdf --view CC --reduction 20 --report c.json"), 3)
      << said_.err;
  EXPECT_EQ(report("c.json").text("status"), "not_gripped");
  EXPECT_LT(report("c.json").number("force_balance"), 1e-6);
  EXPECT_EQ(report("c.json").text("contact_points"), "surface") << "the clinic's plates";
  ASSERT_EQ(run("compress reference.vtkhdf far.vtkhdf --view CC --reduction 5 --standoff 10 "
                "--report f.json"),
            0)
      << said_.err;
  EXPECT_EQ(report("f.json").text("contact_points"), "nodes");
  ASSERT_EQ(run("population supine.vtkhdf --table motion.tsv --summary mean.tsv"), 0) << said_.err;
  EXPECT_NEAR(read_table(folder_ / "motion.tsv").number(0, "nipple_moved_mm"),
              report("s.json").number("landmarks/nipple/distance_mm"), 0.06);
}

TEST_F(SlidingTools, ACalibratedSetIsReadByTheOtherTools) {
  const std::string header = "quantity\tmean\tsd\tunmodelled_sd\n";
  write_text(folder_ / "women.tsv", header +
                                        "nipple_lateral_mm\t6\t3\t0\nnipple_posterior_mm\t5\t3\t1\n"
                                        "ribs_change_mm\t-1\t1\t0\nnipple_caudal_mm\t9\t1\t-\n");
  const std::string line =
      "calibrate-softness mesh.vtkhdf --women women.tsv --set set.tsv --expected 20,50,100 "
      "--wall slide:0.05,L=9 --cut spring:0.05,medial=0.1 --expected-ln-sd 0.2 ";
  ASSERT_EQ(run(line + "--pressed mesh.vtkhdf --reduction 30 --report k.json"), 0) << said_.err;
  EXPECT_GT(report("k.json").number("softness/wall"), 0.01);
  EXPECT_LT(report("k.json").number("softness/cut.medial_ln_sd"), 0.21);
  EXPECT_LT(report("k.json").number("softness/wall_ln_sd"), 0.2);
  EXPECT_GT(report("k.json").number("data/pressure_kPa/found"), 0);
  EXPECT_GT(report("k.json").number("data/nipple_posterior_mm/sd"), 3);
  EXPECT_EQ(run("backward mesh.vtkhdf r.vtkhdf --materials set.tsv"), 0) << said_.err;
  EXPECT_EQ(run(line + "--from victre"), 2);
  EXPECT_NE(said_.err.find("quadratic"), std::string::npos) << said_.err;
  write_text(folder_ / "women.tsv", header + "nipple_lateral_mm\t6\t3\t-\n");
  EXPECT_EQ(run(line), 2);
  EXPECT_NE(said_.err.find("unmodelled_sd"), std::string::npos) << said_.err;
  write_text(folder_ / "women.tsv", header + "nipple_sideways_mm\t6\t3\t0\n");
  EXPECT_EQ(run(line), 2);
  EXPECT_NE(said_.err.find("no quantity 'nipple_sideways_mm'"), std::string::npos) << said_.err;
}

// Two breasts of different women: each is predicted by the fit without her. Both sides of one scan are one woman.
TEST_F(SlidingTools, ACalibrationLeavesOutEachWoman) {
  write_text(
      folder_ / "women.tsv",
      "quantity\tmean\tsd\tunmodelled_sd\nnipple_lateral_mm\t6\t3\t0\nnipple_posterior_mm\t5\t3\t0\n");
  std::filesystem::create_directory(folder_ / "a");
  std::filesystem::create_directory(folder_ / "b");
  for (const char* place : {"a", "b"})
    std::filesystem::copy_file(folder_ / "mesh.vtkhdf", folder_ / place / "mesh.vtkhdf");
  ASSERT_EQ(
      run("calibrate-softness a/mesh.vtkhdf b/mesh.vtkhdf --women women.tsv --set set.tsv --expected 20,50,100 "
          "--wall slide:0.05 --cut spring:0.05 --expected-ln-sd 0.2 --report k.json"),
      0)
      << said_.err;
  // The women are alike, so that the fit without one is nearly that with both.
  EXPECT_NEAR(report("k.json").number("without/a/wall_factor"), 1, 0.05);
  EXPECT_NEAR(report("k.json").number("without/b/nipple_lateral_mm"),
              report("k.json").number("breasts/a/nipple_lateral_mm"), 0.3);
}

// The one default is that of the pipeline, and only backward has it.
TEST_F(SlidingTools, AChainBeginsWithTheDefaultSet) {
  ASSERT_EQ(run("backward mesh.vtkhdf r.vtkhdf --report b.json"), 0) << said_.err;
  EXPECT_EQ(report("b.json").text("materials/name"), default_material_set);
  const std::string wall = load_materials(default_material_set).wall;
  EXPECT_EQ(report("b.json").text("wall"), wall);
  ASSERT_EQ(run("forward r.vtkhdf s.vtkhdf --report s.json"), 0) << said_.err;
  EXPECT_EQ(report("s.json").text("wall"), wall);
  EXPECT_EQ(run("identify mesh.vtkhdf never.tsv --nipple 1,2,3"), 2);
  EXPECT_NE(said_.err.find("--materials"), std::string::npos) << said_.err;
}

TEST_F(SlidingTools, OptionsWinOverTheSet) {
  ASSERT_EQ(run("backward mesh.vtkhdf r.vtkhdf --materials soft.tsv --wall held --cut free "
                "--skin-compression 100 --skin-prestretch 0 --report b.json"),
            0)
      << said_.err;
  EXPECT_EQ(report("b.json").text("wall"), "held");
  EXPECT_EQ(report("b.json").text("cut"), "free");
  EXPECT_EQ(report("b.json").number("skin_law/compression_percent"), 100);
}

TEST_F(SlidingTools, RefusalsNameTheRemedy) {
  write_mesh(folder_ / "flat.vtkhdf", fixtures::cap({.elements = 4}));
  EXPECT_EQ(run("backward flat.vtkhdf r.vtkhdf --materials seed2008 --wall slide"), 2);
  EXPECT_NE(said_.err.find("fit-hermite"), std::string::npos) << said_.err;
  EXPECT_EQ(run("backward mesh.vtkhdf r.vtkhdf --wall slide:-1"), 2);
  EXPECT_EQ(run("backward mesh.vtkhdf r.vtkhdf --cut loose"), 2);
  EXPECT_EQ(run("backward mesh.vtkhdf r.vtkhdf --materials seed2008 --skin-compression 5"), 2);
  EXPECT_NE(said_.err.find("pre-stretch"), std::string::npos) << said_.err;
  ASSERT_EQ(run("backward mesh.vtkhdf reference.vtkhdf --materials seed2008"), 0) << said_.err;
  EXPECT_EQ(run("export-deck reference.vtkhdf o.inp --wall slide --bulk-ratio 100 --without-skin"),
            2);
  EXPECT_NE(said_.err.find("--wall held"), std::string::npos) << said_.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "r.vtkhdf"));
}

}  // namespace
}  // namespace breast
