// A writer killed at any moment, or out of disk space, leaves no file that could be taken for a
// result.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "core/error.hpp"
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

TEST(FullDisk, FailsInOneLineAndLeavesNothing) {
  const ScratchFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{20000, 20000};
    setrlimit(RLIMIT_FSIZE, &limit);
    int code = 1;
    try {
      write_mesh(folder / "mesh.vtkhdf", samples::full_mesh(6));
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
