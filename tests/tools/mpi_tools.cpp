// SPDX-License-Identifier: GPL-3.0-or-later
// forward-mpi and backward-mpi against forward and backward, on one process and on several; what they
// refuse, every process together.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "core/atomic_file.hpp"
#include "core/report.hpp"
#include "fixtures/analytic_mesh.hpp"
#include "fixtures/block.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "fixtures/standing_block.hpp"
#include "io/mesh_file.hpp"

namespace breast {
namespace {

class MpiTools : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    // Open MPI asks for these where a container's only user is root.
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    setenv("OMPI_MCA_mpi_yield_when_idle", "1", 1);
  }
  int run(const std::string& line) {
    said_ = run_line(line, folder_.path());
    return said_.exit_code;
  }
  int run_on(int ranks, const std::string& line) {
    const std::size_t end = line.find(' ');
    return run(std::string(MPIRUN_PROGRAM) + " --oversubscribe -n " + std::to_string(ranks) + " " +
               tool_path(line.substr(0, end)).string() + line.substr(end));
  }
  Report report(const std::string& name) const {
    return Report::parse(read_text(folder_ / name), name);
  }
  double distance(const std::string& one, const std::string& other) const {
    const HexMesh a = read_mesh(folder_ / one), b = read_mesh(folder_ / other);
    double most = 0;
    for (int i = 0; i < a.nodes(); ++i) most = std::max(most, (a.points[i] - b.points[i]).norm());
    return most;
  }
  // Lines of the tool itself, without what mpirun says of an exit code.
  long own_lines(const std::string& tool) const {
    long count = 0;
    std::istringstream in(said_.err);
    for (std::string line; std::getline(in, line);) count += line.rfind(tool + ":", 0) == 0 ? 1 : 0;
    return count;
  }

  ScratchFolder folder_;
  ToolResult said_;
};

TEST_F(MpiTools, ForwardIsThatOfOneProcess) {
  fixtures::BlockSettings settings;
  settings.elements = {3, 2, 3};
  settings.distortion = 0.2;
  settings.skin_mm = 1.5;
  write_mesh(folder_ / "block.vtkhdf", fixtures::block(settings));
  const std::string load = " --materials seed2008 --gravity 0,0,-9810 ";
  ASSERT_EQ(run("forward block.vtkhdf one.vtkhdf --estimate none --report one.json" + load), 0)
      << said_.err;
  for (const int ranks : {1, 2, 4}) {
    ASSERT_EQ(run_on(ranks, "forward-mpi block.vtkhdf many.vtkhdf --report many.json" + load), 0)
        << said_.err;
    EXPECT_LT(distance("one.vtkhdf", "many.vtkhdf"), 1e-7) << ranks;
    EXPECT_EQ(report("many.json").number("ranks"), ranks);
    EXPECT_EQ(report("many.json").number("unknowns"), report("one.json").number("unknowns"));
    const HexMesh one = read_mesh(folder_ / "one.vtkhdf"),
                  many = read_mesh(folder_ / "many.vtkhdf");
    for (int e = 0; e < one.elements(); ++e) {
      ASSERT_NEAR(many.pressure[e], one.pressure[e], 1e-4) << e;
      ASSERT_NEAR(many.det_F[e], one.det_F[e], 1e-9) << e;
    }
  }
}

TEST_F(MpiTools, CompressibleQuadraticElements) {
  fixtures::BlockSettings settings;
  settings.elements = {1, 2, 1};
  write_mesh(folder_ / "block.vtkhdf", fixtures::block(settings));
  const std::string how =
      " --materials seed2008 --gravity 0,0,-9810 --element q2p1 --bulk-ratio 50";
  ASSERT_EQ(run("forward block.vtkhdf one.vtkhdf --estimate none" + how), 0) << said_.err;
  ASSERT_EQ(run_on(2, "forward-mpi block.vtkhdf many.vtkhdf" + how), 0) << said_.err;
  EXPECT_LT(distance("one.vtkhdf", "many.vtkhdf"), 1e-7);
}

TEST_F(MpiTools, BackwardIsThatOfOneProcessOnEveryWall) {
  HexMesh breast = analytic_breast_mesh(4);
  breast.side = breast.geometry->side = Side::right;  // the sternum is on its left
  write_mesh(folder_ / "mesh.vtkhdf", breast);
  for (const std::string how :
       {" --wall held",
        " --wall slide --cut spring:0.02,0.1 --gravity -4000,-9000,0",  // the sternum pulls
        " --wall slide:0.02 --cut tissue:0.02,0.1 --gravity -4000,-9000,0",
        " --wall spring:1 --cut roller"}) {
    const std::string with = " --materials seed2008" + how;
    ASSERT_EQ(run("backward mesh.vtkhdf one.vtkhdf --estimate none" + with), 0) << said_.err;
    ASSERT_EQ(run_on(2, "backward-mpi mesh.vtkhdf many.vtkhdf --report many.json" + with), 0)
        << said_.err;
    EXPECT_LT(distance("one.vtkhdf", "many.vtkhdf"), 1e-7) << how;
    // Forward over two processes comes back to the imaged shape.
    EXPECT_LT(report("many.json").number("closure_mm"), 1e-7) << how;
  }
}

TEST_F(MpiTools, RefusalsAreOneLineAndNothingIsWritten) {
  fixtures::BlockSettings settings;
  settings.elements = {1, 1, 2};
  HexMesh mesh = fixtures::block(settings);
  write_mesh(folder_ / "block.vtkhdf", mesh);
  mesh.reference.clear();
  write_mesh(folder_ / "imaged.vtkhdf", mesh);
  std::ofstream(folder_ / "broken.vtkhdf") << "no mesh\n";
  for (const std::string line :
       {"forward-mpi block.vtkhdf out.vtkhdf --materials seed2008 --solver direct",
        "forward-mpi imaged.vtkhdf out.vtkhdf", "forward-mpi broken.vtkhdf out.vtkhdf",
        "forward-mpi block.vtkhdf block.vtkhdf", "forward-mpi block.vtkhdf",
        "forward-mpi block.vtkhdf out.vtkhdf --materials seed2008 --wall slide",
        "backward-mpi block.vtkhdf out.vtkhdf --materials seed2008 --wall spring:1",
        "forward-mpi block.vtkhdf out.vtkhdf --materials seed2008",
        "forward-mpi block.vtkhdf out.vtkhdf"}) {
    EXPECT_EQ(run_on(3, line), 2) << line << "\n" << said_.err;
    EXPECT_EQ(own_lines(line.substr(0, line.find(' '))), 1) << line << "\n" << said_.err;
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out.vtkhdf")) << line;
  }
}

// Open MPI itself would say 26 lines, and leave its folder in TMPDIR.
TEST_F(MpiTools, FewOpenFilesEndInOneLineAndLeaveNothing) {
  fixtures::BlockSettings settings;
  settings.elements = {1, 1, 2};
  write_mesh(folder_ / "block.vtkhdf", fixtures::block(settings));
  const ScratchFolder temporary;
  for (const auto& [files, exit_code] :
       {std::pair{4, 1}, std::pair{6, 1}, std::pair{20, 1}, std::pair{64, 0}}) {
    for (const char* tool : {"forward-mpi", "backward-mpi"}) {
      const ToolResult said = run_tool(tool,
                                       {"block.vtkhdf", "out.vtkhdf", "--materials", "seed2008",
                                        "--gravity", "0,0,-9810", "--quiet"},
                                       folder_.path(), [&, &files = files] {
                                         setenv("TMPDIR", temporary.path().c_str(), 1);
                                         // Files that the suite's caller left open would count, too.
                                         close_range(3, ~0U, CLOSE_RANGE_CLOEXEC);
                                         const rlimit limit{rlim_t(files), rlim_t(files)};
                                         setrlimit(RLIMIT_NOFILE, &limit);
                                       });
      EXPECT_EQ(said.exit_code, exit_code) << tool << ", " << files << " files: " << said.err;
      EXPECT_EQ(said.error_lines(), exit_code) << tool << ", " << files << " files: " << said.err;
      EXPECT_TRUE(std::filesystem::is_empty(temporary.path())) << tool << ", " << files << " files";
    }
  }
}

// Debian's PETSc brings HDF5's MPI build into the process beside our serial one: as the loader binds
// them, nothing of one calls the other.
TEST_F(MpiTools, TheTwoBuildsOfHdf5KeepApart) {
  fixtures::BlockSettings settings;
  settings.elements = {1, 1, 1};
  write_mesh(folder_ / "block.vtkhdf", fixtures::block(settings));
  const ToolResult said =
      run_tool("forward-mpi",
               {"block.vtkhdf", "out.vtkhdf", "--materials", "seed2008", "--gravity", "0,0,-9810"},
               folder_.path(), [] {
                 setenv("LD_DEBUG", "bindings", 1);
                 setenv("LD_DEBUG_OUTPUT", "bindings", 1);
                 setenv("OMP_WAIT_POLICY", "passive", 1);
               });
  ASSERT_EQ(said.exit_code, 0) << said.err;
  int serial = 0, crossed = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    if (entry.path().filename().string().rfind("bindings.", 0) != 0) continue;
    std::ifstream in(entry.path());
    // "binding file USER [0] to LIBRARY [0]: normal symbol `H5Fopen' [HDF5_SERIAL_1.8.7]"
    for (std::string line; std::getline(in, line);) {
      const bool of_serial = line.find("[HDF5_SERIAL") != std::string::npos;
      if (!of_serial && line.find("[HDF5_MPI") == std::string::npos) continue;
      const std::size_t to = line.find(" to ");
      const bool from_us = line.find("forward-mpi") != std::string::npos ||
                           line.find("libhdf5_serial") != std::string::npos;
      const bool to_mpi = line.find("libhdf5_openmpi", to) != std::string::npos;
      serial += of_serial ? 1 : 0;
      crossed += of_serial != from_us || (of_serial && to_mpi) ? 1 : 0;
    }
  }
  EXPECT_GT(serial, 50);
  EXPECT_EQ(crossed, 0);
}

// A column of fat that carries itself up to 29 mm (Greenhill 1881, E = 3μ): straight is in balance, but
// a higher one would fall.
TEST_F(MpiTools, AnUnstableEquilibriumIsNoAnswer) {
  for (const auto& [height, exit_code] : {std::pair{20, 0}, std::pair{40, 3}}) {
    write_mesh(folder_ / "column.vtkhdf",
               fixtures::standing_block(Vec3(10, height, 10), {2, height / 5, 2}));
    EXPECT_EQ(run_on(1,
                     "backward-mpi column.vtkhdf out.vtkhdf --materials seed2008 --posture supine "
                     "--report r.json"),
              exit_code)
        << height << " mm: " << said_.err;
    EXPECT_EQ(std::filesystem::remove(folder_ / "out.vtkhdf"), exit_code == 0);
    EXPECT_EQ(report("r.json").text("reason"), exit_code == 0 ? "" : "unstable_equilibrium");
  }
}

}  // namespace
}  // namespace breast
