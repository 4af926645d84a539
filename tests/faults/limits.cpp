// SPDX-License-Identifier: GPL-3.0-or-later
// Small limits on stack, memory, files and their size (ulimit -s, -v, -n, -f): a tool does its work or says one line, soon.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdlib>
#include <set>

#include "faults/cases.hpp"
#include "fixtures/scratch_folder.hpp"

namespace breast::faults {
namespace {

namespace fs = std::filesystem;

constexpr rlim_t kb = 1024, mb = 1024 * kb;
constexpr rlim_t hang_s = 300;        // of processor time, since the machine may be busy
constexpr unsigned waiting_s = 1800;  // of the clock, for what waits for ever

struct Limit {
  const char* name;
  __rlimit_resource resource;
  rlim_t value;
  bool mild = false;  ///< most tools do their work: only with BREAST_FAULT_ALLOCATIONS
};
const Limit limits[] = {
    {"stack_128_kB", RLIMIT_STACK, 128 * kb},
    {"stack_1_MB", RLIMIT_STACK, mb, true},
    {"memory_40_MB", RLIMIT_AS, 40 * mb},
    {"memory_150_MB", RLIMIT_AS, 150 * mb},
    {"memory_400_MB", RLIMIT_AS, 400 * mb},
    {"memory_1000_MB", RLIMIT_AS, 1000 * mb, true},
    {"files_4", RLIMIT_NOFILE, 4},
    {"files_6", RLIMIT_NOFILE, 6},
    {"files_10", RLIMIT_NOFILE, 10, true},
    {"file_of_4_kB", RLIMIT_FSIZE, 4 * kb},
    {"file_of_20_kB", RLIMIT_FSIZE, 20 * kb, true},
};

class Limits : public ::testing::TestWithParam<Limit> {
 protected:
  static void SetUpTestSuite() {
    inputs_ = new ScratchFolder;
    write_inputs(inputs_->path());
  }
  static void TearDownTestSuite() { delete inputs_; }
  static inline ScratchFolder* inputs_ = nullptr;
};

// Every tool; those that take minutes as a whole only with BREAST_FAULT_ALLOCATIONS.
TEST_P(Limits, EndInOneLine) {
  const bool full = std::getenv("BREAST_FAULT_ALLOCATIONS") != nullptr;
  if (GetParam().mild && !full) GTEST_SKIP() << "only with BREAST_FAULT_ALLOCATIONS";
  std::set<std::string> tried;
  for (const Case& c : cases()) {
    std::vector<std::string> words = words_of(c.line);
    const std::string tool = words.front();
    const bool long_one = c.stride == 0 || (c.stride > 5 && tried.contains(tool));
    if ((long_one && !full) || !fs::exists(tool_path(tool))) continue;
    tried.insert(tool);
    const ScratchFolder folder;
    for (std::string& word : words) {
      if (fs::exists(inputs_->path() / word)) word = (inputs_->path() / word).string();
    }
    words.erase(words.begin());
    words.insert(words.end(), {"--threads", "1", "--quiet"});
    const ToolResult result = run_tool(tool, words, folder.path(), [] {
      const rlimit limit{GetParam().value, GetParam().value};
      setrlimit(GetParam().resource, &limit);
      const rlimit hang{hang_s, RLIM_INFINITY};
      setrlimit(RLIMIT_CPU, &hang);
      alarm(waiting_s);
    });
    // 127: the loader cannot map the program's libraries, and says so in one line.
    EXPECT_TRUE((result.exit_code >= 0 && result.exit_code <= 3) || result.exit_code == 127)
        << c.name << ": exit " << result.exit_code << " " << result.err;
    EXPECT_EQ(result.error_lines(), result.exit_code == 0 ? 0 : 1) << c.name << ": " << result.err;
    if (result.exit_code != 0) {
      for (const auto& entry : fs::directory_iterator(folder.path())) {
        EXPECT_FALSE(entry.path().filename().string().starts_with("."))
            << c.name << ": " << entry.path();
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Limits, ::testing::ValuesIn(limits),
                         [](const auto& limit) { return std::string(limit.param.name); });

}  // namespace
}  // namespace breast::faults
