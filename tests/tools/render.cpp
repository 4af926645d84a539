// SPDX-License-Identifier: GPL-3.0-or-later
// render as a user runs it: every figure, with and without DISPLAY, several at a
// time, nothing left behind.
#include <gtest/gtest.h>

#include <csignal>
#include <cstdlib>
#include <thread>

#include "core/atomic_file.hpp"
#include "fixtures/chain_files.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/surface_file.hpp"

using namespace breast;
namespace fs = std::filesystem;

namespace {

class Render : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new ScratchFolder;
    fixtures::write_chain(folder_->path());
    TriMesh points;
    for (int i = 0; i < 60; ++i) {
      points.points.push_back(Vec3(30 * std::cos(i), i, 30 * std::sin(i)));
      points.point_data["surface"].push_back(i % 2);
    }
    write_surface(*folder_ / "points.vtp", points);
    for (const char* view : {"cc", "mlo"}) {
      const std::string name = view;
      run("project-mammogram", {name + ".vtkhdf", name + ".vti", "--pixel", "1"});
    }
    run("cc2mlo", {"cc.vtkhdf", "mlo.vtkhdf", "curve.vtp", "--landmark", "tumour"});
  }
  static void TearDownTestSuite() { delete folder_; }
  static ToolResult run(const std::string& tool, const std::vector<std::string>& arguments) {
    return run_tool(tool, arguments, folder_->path());
  }
  static fs::path file(const std::string& name) { return *folder_ / name; }
  static const fs::path& folder() { return folder_->path(); }

 private:
  static inline ScratchFolder* folder_ = nullptr;
};

// X servers whose parent is (or was) this test or a child of it: those started by our renders.
int servers_of(pid_t parent) {
  int count = 0;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    std::ifstream stat(entry.path() / "stat");
    std::string id, name, state;
    pid_t owner = 0;
    if (stat >> id >> name >> state >> owner) count += name == "(Xvfb)" && owner == parent;
  }
  return count;
}

bool is_png(const fs::path& file) {
  return fs::exists(file) && read_text(file).substr(1, 3) == "PNG";
}

}  // namespace

TEST_F(Render, EveryFigureIsDrawn) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> figures = {
      {"points", {"points.vtp"}},
      {"geometry", {"geometry.vtkhdf"}},
      {"mesh", {"mesh.vtkhdf"}},
      {"tissues", {"mesh.vtkhdf"}},
      {"compression", {"cc.vtkhdf", "mlo.vtkhdf"}},
      {"pressure", {"cc.vtkhdf", "mlo.vtkhdf"}},
      {"force-thickness", {"cc.vtkhdf", "mlo.vtkhdf"}},
      {"mammogram", {"cc.vti", "mlo.vti", "curve.vtp"}},
      {"matching", {"cc.vtkhdf", "mlo.vtkhdf", "curve.vtp"}},
      {"matching", {"mlo.vtkhdf", "curve.vtp"}},
      {"summary",
       {"mesh.vtkhdf", "reference.vtkhdf", "supine.vtkhdf", "cc.vtkhdf", "mlo.vtkhdf", "cc.vti",
        "mlo.vti", "curve.vtp"}},
      {"summary",  // a case without a tumour has no curve
       {"mesh.vtkhdf", "reference.vtkhdf", "supine.vtkhdf", "cc.vtkhdf", "mlo.vtkhdf", "cc.vti",
        "mlo.vti"}}};
  for (const auto& [name, inputs] : figures) {
    std::vector<std::string> arguments = inputs;
    arguments.insert(arguments.end(), {"--figure", name, "-o", name + ".png"});
    const ToolResult result = run("render", arguments);
    EXPECT_EQ(result.exit_code, 0) << name << ": " << result.err;
    ASSERT_TRUE(is_png(file(name + ".png"))) << name;
    EXPECT_GT(fs::file_size(file(name + ".png")), 20000u) << name << " is all but empty";
  }
}

TEST_F(Render, DisplayMakesNoDifference) {
  const char* before = std::getenv("DISPLAY");
  const std::string kept = before != nullptr ? before : "";
  setenv("DISPLAY", ":987", 1);  // nobody there
  ASSERT_EQ(run("render", {"mesh.vtkhdf", "-o", "a.png"}).exit_code, 0);
  unsetenv("DISPLAY");
  ASSERT_EQ(run("render", {"mesh.vtkhdf", "-o", "b.png"}).exit_code, 0);
  if (before != nullptr) setenv("DISPLAY", kept.c_str(), 1);
  EXPECT_EQ(read_text(file("a.png")), read_text(file("b.png")));
}

TEST_F(Render, TwoAtATimeGiveTheSamePicture) {
  ScratchFolder other;
  fs::copy_file(file("mesh.vtkhdf"), other / "mesh.vtkhdf");
  ToolResult second;
  std::thread beside([&] {
    second = run_tool("render", {"mesh.vtkhdf", "-o", "c.png"}, other.path());
  });
  const ToolResult first = run("render", {"mesh.vtkhdf", "-o", "c.png"});
  beside.join();
  ASSERT_EQ(first.exit_code, 0) << first.err;
  ASSERT_EQ(second.exit_code, 0) << second.err;
  EXPECT_EQ(read_text(file("c.png")), read_text(other / "c.png"));
}

TEST_F(Render, AKilledRenderLeavesNoServerAndNoPicture) {
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(folder().c_str()) == 0) {
      execl(tool_path("render").c_str(), "render", "cc.vtkhdf", "mlo.vtkhdf", "--figure",
            "compression", "-o", "killed.png", "--quiet", static_cast<char*>(nullptr));
    }
    _exit(127);
  }
  for (int wait = 0; wait < 500 && servers_of(child) == 0; ++wait) usleep(20000);
  ASSERT_EQ(servers_of(child), 1);
  pid_t server = 0;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    std::ifstream stat(entry.path() / "stat");
    std::string name, state;
    pid_t id = 0, owner = 0;
    if (stat >> id >> name >> state >> owner && name == "(Xvfb)" && owner == child) server = id;
  }
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  bool gone = false;
  for (int wait = 0; wait < 500 && !gone; ++wait) {
    usleep(20000);
    // A zombie waits for its reaper only: it serves nobody any more.
    std::ifstream stat("/proc/" + std::to_string(server) + "/stat");
    std::string id, name, state;
    gone = !(stat >> id >> name >> state) || state == "Z";
  }
  EXPECT_TRUE(gone);
  EXPECT_FALSE(fs::exists(file("killed.png")));
}

TEST_F(Render, MissingServerIsSaidWithThePackages) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  const ToolResult result = run("render", {"mesh.vtkhdf", "-o", "no.png"});
  setenv("PATH", path.c_str(), 1);
  EXPECT_EQ(result.exit_code, 1);
  EXPECT_EQ(result.error_lines(), 1) << result.err;
  EXPECT_NE(result.err.find("xvfb xauth libgl1-mesa-dri"), std::string::npos) << result.err;
}

TEST_F(Render, MissingInputsAreNamed) {
  const ToolResult result =
      run("render", {"mesh.vtkhdf", "curve.vtp", "--figure", "matching", "-o", "no.png"});
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("compressed"), std::string::npos) << result.err;
  EXPECT_EQ(run("render", {"mesh.vtkhdf", "--figure", "heatmap", "-o", "no.png"}).exit_code, 2);
  EXPECT_EQ(run("render", {"mesh.vtkhdf", "--figure", "compression", "-o", "no.png"}).exit_code, 2);
  EXPECT_FALSE(fs::exists(file("no.png")));
}
