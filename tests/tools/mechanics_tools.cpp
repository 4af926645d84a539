// SPDX-License-Identifier: GPL-3.0-or-later
// backward, forward and laws as programs: exit codes, reports, files.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "core/table.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "fixtures/shapes.hpp"
#include "io/mesh_file.hpp"

namespace breast {
namespace {

class MechanicsTools : public testing::Test {
 protected:
  void SetUp() override {
    HexMesh mesh = fixtures::cap({.elements = 6});
    mesh.reference.clear();
    write_mesh(folder_ / "mesh.vtkhdf", mesh);
  }

  // Exit code of "tool arguments", run in the folder; what it said is in said_.
  int run(const std::string& line) {
    said_ = run_line(line, folder_.path());
    return said_.exit_code;
  }
  Report report(const std::string& name) const {
    return Report::parse(read_text(folder_ / name), name);
  }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  ScratchFolder folder_;
  ToolResult said_;
};

TEST_F(MechanicsTools, BackwardThenForwardReturnsToTheScan) {
  ASSERT_EQ(
      run("backward mesh.vtkhdf reference.vtkhdf --materials seed2008 --report backward.json"), 0)
      << said_.err;
  const Report backward = report("backward.json");
  EXPECT_EQ(backward.text("status"), "converged");
  EXPECT_LT(backward.number("closure_mm"), 1e-8);
  EXPECT_LT(backward.number("max_volume_error"), 1e-9);
  EXPECT_LE(backward.number("newton_iterations"), 8);
  EXPECT_GT(backward.number("error_estimate_mm"), 0);
  EXPECT_LT(backward.number("error_estimate_mm"), 1);
  EXPECT_NEAR(backward.number("materials/fat/shear_modulus_Pa"), 1220, 1e-9);
  ASSERT_EQ(run("forward reference.vtkhdf prone.vtkhdf --posture prone --report f.json"), 0);
  const HexMesh prone = read_mesh(folder_ / "prone.vtkhdf", {.reference = true});
  for (int i = 0; i < prone.nodes(); ++i) {
    EXPECT_LT((prone.points[i] - prone.imaged[i]).norm(), 1e-8);
  }
  EXPECT_EQ(prone.history.size(), 2u);
  EXPECT_EQ(said_.out, "");
  ASSERT_EQ(run("forward reference.vtkhdf supine.vtkhdf --report s.json"), 0);
  EXPECT_GT(report("s.json").number("landmarks/nipple/distance_mm"), 1);
}

// What was solved, how, at what cost and how well: for people on stderr, nothing under --quiet.
TEST_F(MechanicsTools, EndWithASummary) {
  ASSERT_EQ(run("backward mesh.vtkhdf reference.vtkhdf --materials seed2008 --scale fat=50"), 0)
      << said_.err;
  for (const char* part :
       {"elements", "unknowns", "fat: polynomial", "μ0 610 Pa", "ρgL/μ0", "Newton iterations",
        "residual", "peak", "at the landmarks about", "forward returns to the scan within"}) {
    EXPECT_NE(said_.err.find(part), std::string::npos) << part << "\n" << said_.err;
  }
  ASSERT_EQ(run("forward reference.vtkhdf supine.vtkhdf --quiet"), 0);
  EXPECT_EQ(said_.err, "");
}

// The file of the stress-free shape states the model: laws, scales, supports, elements.
TEST_F(MechanicsTools, LaterToolsTakeTheModelOfTheFile) {
  const std::string model =
      " --materials wellman --scale fat=70 --wall spring:0.3,0.1 --cut roller --invariants plain "
      "--bulk-ratio 300";
  ASSERT_EQ(run("backward mesh.vtkhdf reference.vtkhdf" + model), 0) << said_.err;
  ASSERT_EQ(run("forward reference.vtkhdf stated.vtkhdf --report s.json"), 0) << said_.err;
  EXPECT_EQ(said_.err.find("instead of"), std::string::npos) << said_.err;
  ASSERT_EQ(run("forward reference.vtkhdf given.vtkhdf" + model), 0) << said_.err;
  EXPECT_EQ(said_.err.find("instead of"), std::string::npos) << said_.err;
  const HexMesh stated = read_mesh(folder_ / "stated.vtkhdf"),
                given = read_mesh(folder_ / "given.vtkhdf");
  EXPECT_EQ(stated.points, given.points) << "to the last digit";
  ASSERT_TRUE(stated.model);
  EXPECT_EQ(stated.model, read_mesh(folder_ / "reference.vtkhdf").model);
  EXPECT_EQ(report("s.json").text("wall"), "spring:0.3,0.1");
  EXPECT_EQ(report("s.json").number("bulk_ratio"), 300);
  ASSERT_EQ(run("sensitivity reference.vtkhdf stated.vtkhdf d.vtkhdf --table d.tsv"), 0)
      << said_.err;
  EXPECT_EQ(said_.err.find("instead of"), std::string::npos) << said_.err;
}

TEST_F(MechanicsTools, AnotherModelThanTheFilesIsNamedInOneLine) {
  ASSERT_EQ(run("backward mesh.vtkhdf reference.vtkhdf --materials seed2008"), 0) << said_.err;
  ASSERT_EQ(
      run("forward reference.vtkhdf other.vtkhdf --scale fat=200 --cut roller --report o.json"), 0)
      << said_.err;
  EXPECT_NE(said_.err.find("forward: warning: model: stiffness of fat 200 instead of 100 %, --cut "
                           "roller instead of free; reference.vtkhdf was solved with the latter\n"),
            std::string::npos)
      << said_.err;
  EXPECT_EQ(report("o.json").text("cut"), "roller");
  EXPECT_EQ(report("o.json").text("wall"), "held");
  const HexMesh other = read_mesh(folder_ / "other.vtkhdf");
  EXPECT_EQ(other.model->cut, "roller");
}

TEST_F(MechanicsTools, AFileThatStatesNoModelNeedsOne) {
  HexMesh mesh = fixtures::cap({.elements = 4});
  write_mesh(folder_ / "foreign.vtkhdf", mesh);
  for (const std::string line : {"forward foreign.vtkhdf out.vtkhdf",
                                 "compress foreign.vtkhdf out.vtkhdf --view CC --reduction 20",
                                 "sensitivity foreign.vtkhdf foreign.vtkhdf out.vtkhdf",
                                 "export-deck foreign.vtkhdf out.inp"}) {
    EXPECT_EQ(run(line), 2) << line;
    EXPECT_EQ(said_.error_lines(), 1) << said_.err;
    EXPECT_NE(said_.err.find("foreign.vtkhdf: does not state the model"), std::string::npos)
        << said_.err;
    EXPECT_NE(said_.err.find("--materials"), std::string::npos) << said_.err;
  }
  EXPECT_EQ(run("forward foreign.vtkhdf out.vtkhdf --materials seed2008 --gravity 0,0,0"), 0)
      << said_.err;
  mesh.model = ModelText{"odd", "no table", "q1p0", "isochoric", "incompressible", "held", "free"};
  write_mesh(folder_ / "odd.vtkhdf", mesh);
  EXPECT_EQ(run("forward odd.vtkhdf out.vtkhdf"), 2);
  EXPECT_EQ(said_.error_lines(), 1) << said_.err;
  EXPECT_NE(said_.err.find("/breast/model"), std::string::npos) << said_.err;
}

TEST_F(MechanicsTools, QuadraticElementsOnTheSameMesh) {
  ASSERT_EQ(
      run("backward mesh.vtkhdf reference.vtkhdf --materials seed2008 --element q2p1 --cut roller "
          "--report b.json"),
      0)
      << said_.err;
  EXPECT_LT(report("b.json").number("closure_mm"), 1e-8);
  EXPECT_EQ(read_mesh(folder_ / "reference.vtkhdf").order, 2);
  ASSERT_EQ(run("forward reference.vtkhdf supine.vtkhdf"), 0) << said_.err;
  EXPECT_EQ(run("forward reference.vtkhdf other.vtkhdf --element q1p0"), 2);
  EXPECT_FALSE(exists("other.vtkhdf"));
}

TEST_F(MechanicsTools, RefuseWhatTheyCannotDo) {
  EXPECT_EQ(run("forward mesh.vtkhdf out.vtkhdf"), 2);  // no stress-free shape yet
  EXPECT_NE(said_.err.find("backward"), std::string::npos) << said_.err;
  EXPECT_EQ(run("backward mesh.vtkhdf out.vtkhdf --materials nothing"), 2);
  EXPECT_EQ(run("backward mesh.vtkhdf out.vtkhdf --scale fat=-3"), 2);
  EXPECT_EQ(run("backward mesh.vtkhdf out.vtkhdf --element q3"), 2);
  EXPECT_EQ(run("backward mesh.vtkhdf out.vtkhdf --gravity 0,1"), 2);
  EXPECT_EQ(run("backward mesh.vtkhdf out.vtkhdf --solver lu"), 2);
  EXPECT_EQ(run("backward absent.vtkhdf out.vtkhdf"), 2);
  EXPECT_FALSE(exists("out.vtkhdf"));
}

// Far beyond what the law can carry: exit 3 and nothing written, unless it is asked for.
TEST_F(MechanicsTools, NotConvergedIsExitThree) {
  // A hundred times as heavy as water, and twenty times as soft as mira2018.
  std::ofstream(folder_ / "heavy.tsv")
      << "tissue\tlaw\tdensity_g_per_mm3\ta10_Pa\nfat\tneo_hookean\t0.1\t2.27\n"
      << "fibroglandular\tneo_hookean\t0.1\t2.27\nskin\tneo_hookean\t0.1\t36.3\n"
      << "muscle\tneo_hookean\t0.1\t1090\ntumour\tneo_hookean\t0.1\t2.27\n";
  const std::string load = " --gravity 0,16320,10880 --materials heavy.tsv";
  ASSERT_EQ(run("backward mesh.vtkhdf reference.vtkhdf --materials heavy.tsv --gravity 0,0,0"), 0)
      << said_.err;
  EXPECT_EQ(run("forward reference.vtkhdf far.vtkhdf" + load + " --report far.json"), 3)
      << said_.err;
  EXPECT_FALSE(exists("far.vtkhdf"));
  EXPECT_EQ(report("far.json").text("status"), "not_converged");
  EXPECT_EQ(run("forward reference.vtkhdf far.vtkhdf --keep-unconverged" + load), 3);
  ASSERT_TRUE(exists("far.vtkhdf"));
  EXPECT_EQ(read_mesh(folder_ / "far.vtkhdf").solve->status, SolveStatus::not_converged);
}

// The states on the way are meshes that every tool reads; the last is the result; a run without them
// leaves none of an older result.
TEST_F(MechanicsTools, StatesOfTheTurn) {
  ASSERT_EQ(run("backward mesh.vtkhdf reference.vtkhdf --materials seed2008"), 0) << said_.err;
  ASSERT_EQ(run("forward reference.vtkhdf supine.vtkhdf --states 5 --report s.json"), 0)
      << said_.err;
  const Table table = read_table(folder_ / "supine-states/states.tsv");
  ASSERT_EQ(table.rows.size(), 5u);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(table.cell(k, "status"), "converged");
    EXPECT_LT(table.number(k, "residual"), 1e-9);
    EXPECT_NEAR(table.number(k, "way_percent"), 25.0 * double(k), 1e-9);
    const HexMesh state = read_mesh(folder_ / "supine-states" / table.cell(k, "file"));
    EXPECT_EQ(state.gravity.y(), table.number(k, "gravity_y_mm_s2"));
    EXPECT_EQ(landmark_position(state, state.points, state.landmarks.at(0)),
              table.point(k, state.landmarks.at(0).name + "_"));
    EXPECT_TRUE(state.model);
  }
  EXPECT_LT(report("s.json").number("states/turned_to_result_mm"), 1e-6);
  const HexMesh result = read_mesh(folder_ / "supine.vtkhdf"),
                last = read_mesh(folder_ / "supine-states/state_005.vtkhdf");
  EXPECT_EQ(result.content_sha256, last.content_sha256);
  EXPECT_NE(read_text(folder_ / "supine-states/states.vtkhdf.series").find("state_005.vtkhdf"),
            std::string::npos);
  ASSERT_EQ(run("forward reference.vtkhdf supine.vtkhdf --states 2"), 0) << said_.err;
  EXPECT_FALSE(exists("supine-states/state_003.vtkhdf"));
  EXPECT_TRUE(exists("supine-states/state_002.vtkhdf"));
  ASSERT_EQ(run("forward reference.vtkhdf supine.vtkhdf"), 0) << said_.err;
  EXPECT_FALSE(exists("supine-states"));
  EXPECT_EQ(read_mesh(folder_ / "supine.vtkhdf").content_sha256, result.content_sha256)
      << "the states leave the result as it is";
}

TEST_F(MechanicsTools, StatesThatCannotBe) {
  ASSERT_EQ(run("backward mesh.vtkhdf reference.vtkhdf --materials seed2008"), 0) << said_.err;
  EXPECT_EQ(run("forward reference.vtkhdf out.vtkhdf --states 1"), 2);
  EXPECT_EQ(run("forward reference.vtkhdf out.vtkhdf --states 3 --posture prone"), 2);
  EXPECT_NE(said_.err.find("--states-from"), std::string::npos) << said_.err;
  std::filesystem::create_directory(folder_ / "out-states");
  std::ofstream(folder_ / "out-states/notes.txt") << "mine\n";
  EXPECT_EQ(run("forward reference.vtkhdf out.vtkhdf --states 3"), 2);
  EXPECT_NE(said_.err.find("notes.txt"), std::string::npos) << said_.err;
  EXPECT_FALSE(exists("out.vtkhdf"));
  ASSERT_EQ(run("forward reference.vtkhdf out.vtkhdf"), 0) << said_.err;
  EXPECT_TRUE(exists("out-states/notes.txt"));
}

TEST_F(MechanicsTools, LawsPrintsATable) {
  ASSERT_EQ(run("laws seed2008 --scale fat=50"), 0) << said_.err;
  EXPECT_NE(said_.out.find("fat\tpolynomial a10 155 Pa"), std::string::npos) << said_.out;
  EXPECT_EQ(run("laws seed2008 --curves"), 0);
  EXPECT_EQ(run("laws nowhere.tsv"), 2);
  std::ofstream(folder_ / "bad.tsv") << "tissue\tlaw\tdensity_g_per_mm3\ta10_Pa\n"
                                     << "fat\tneo_hookean\t0.001\t-5\n";
  EXPECT_EQ(run("laws bad.tsv"), 2);
  EXPECT_NE(said_.err.find("fat"), std::string::npos);
}

}  // namespace
}  // namespace breast
