// SPDX-License-Identifier: GPL-3.0-or-later
// A writer or a tool killed at any moment, or a full disk, leaves no file that could be taken
// for a result.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <map>
#include <thread>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "fixtures/chain_files.hpp"
#include "fixtures/run_tool.hpp"
#include "fixtures/samples.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/mesh_file.hpp"

namespace breast {
namespace {

namespace fs = std::filesystem;

long visible_files(const ScratchFolder& folder) {
  long count = 0;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    count += !entry.path().filename().string().starts_with(".mesh.vtkhdf.part-");
  }
  return count;
}

TEST(KilledWriter, LeavesTheOldFileOrTheNew) {
  const HexMesh mesh = samples::full_mesh(10);
  const ScratchFolder folder;
  const auto start = std::chrono::steady_clock::now();
  write_mesh(folder / "mesh.vtkhdf", mesh);
  const auto once = std::chrono::steady_clock::now() - start;
  const std::string content = read_mesh(folder / "mesh.vtkhdf").content_sha256;
  fs::remove(folder / "mesh.vtkhdf");
  int interrupted = 0;
  constexpr int kills = 20;
  for (int i = 0; i < kills; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      write_mesh(folder / "mesh.vtkhdf", mesh);
      _exit(0);
    }
    std::this_thread::sleep_for(once * i / kills);
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    interrupted += WIFSIGNALED(status);
    EXPECT_LE(visible_files(folder), 1);
    if (fs::exists(folder / "mesh.vtkhdf")) {
      EXPECT_EQ(read_mesh(folder / "mesh.vtkhdf").content_sha256, content);
      fs::remove(folder / "mesh.vtkhdf");
    }
  }
  EXPECT_GT(interrupted, 0);
  write_mesh(folder / "mesh.vtkhdf", mesh);  // and the leftovers go
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

bool is_part(const fs::path& file) {
  const std::string name = file.filename().string();
  return name.starts_with(".") && name.find(".part-") != std::string::npos;
}

class KilledTool : public testing::TestWithParam<int> {};

// Whatever the moment, only the whole result or nothing shows; the next run removes what is hidden.
TEST_P(KilledTool, LeavesTheResultOrNothing) {
  const ScratchFolder folder;
  fixtures::write_chain(folder.path(), 6);
  const std::vector<std::string> line = {"cc.vtkhdf", "out.vti", "--quiet", "--png",
                                         "out.png",   "--pixel", "0.25"};
  const auto start = std::chrono::steady_clock::now();
  const ToolResult whole = run_tool("project-mammogram", line, folder.path());
  const auto once = std::chrono::steady_clock::now() - start;
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  std::map<std::string, std::string> expected;
  for (const auto& entry : fs::directory_iterator(folder.path())) {
    expected[entry.path().filename().string()] = read_text(entry.path());
  }
  ASSERT_TRUE(expected.contains("out.vti") && expected.contains("out.png"));
  int interrupted = 0;
  constexpr int kills = 10;
  for (int i = 0; i < kills; ++i) {
    fs::remove(folder / "out.vti");
    fs::remove(folder / "out.png");
    const pid_t child = fork();
    if (child == 0) become_tool("project-mammogram", line, folder.path());
    std::this_thread::sleep_for(once * (i + 1) / (kills + 1));
    kill(child, GetParam());
    int status = 0;
    waitpid(child, &status, 0);
    interrupted += WIFSIGNALED(status);
    for (const auto& entry : fs::directory_iterator(folder.path())) {
      const std::string name = entry.path().filename().string();
      if (is_part(entry.path())) continue;
      ASSERT_TRUE(expected.contains(name)) << name;
      EXPECT_TRUE(read_text(entry.path()) == expected.at(name)) << name << ", kill " << i;
    }
  }
  EXPECT_GT(interrupted, 0);
  const ToolResult again = run_tool("project-mammogram", line, folder.path());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), long(expected.size()));
}
INSTANTIATE_TEST_SUITE_P(Signals, KilledTool, testing::Values(SIGKILL, SIGTERM, SIGINT));

TEST(FullDisk, FailsInOneLineAndLeavesNothing) {
  const ScratchFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{20000, 20000};
    setrlimit(RLIMIT_FSIZE, &limit);
    int code = 1;
    try {
      fixtures::write_chain(folder.path(), 6);
    } catch (const Error& error) {
      const bool one_line = std::string(error.what()).find('\n') == std::string::npos;
      code = error.kind() == ErrorKind::failed && one_line ? 0 : 2;
    }
    _exit(code);
  }
  int status = 0;
  waitpid(child, &status, 0);
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace breast
