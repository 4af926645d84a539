// SPDX-License-Identifier: GPL-3.0-or-later
// Every tool under failing writes and failing allocations: exit 1, 2 or 3 with one line, or exit 0 with the
// right files; no part of a file, no hidden file, nothing left in the temporary folder, no hang.
//
//   faults                                  output calls and a few allocations of the quick tools
//   BREAST_FAULT_ALLOCATIONS=200 faults     as many allocations a tool, every output call in both ways, all tools
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cstdlib>
#include <functional>
#include <memory>
#include <random>
#include <set>

#include "core/atomic_file.hpp"
#include "faults/branches.hpp"
#include "faults/cases.hpp"
#include "faults/outputs.hpp"
#include "fixtures/scratch_folder.hpp"

namespace breast::faults {
namespace {

namespace fs = std::filesystem;

constexpr int few_allocations = 2;

int allocations_wanted() {
  const char* text = std::getenv("BREAST_FAULT_ALLOCATIONS");
  return text == nullptr ? few_allocations : std::atoi(text);
}
bool full() {
  return allocations_wanted() > few_allocations;
}

class Faults : public ::testing::TestWithParam<Case> {
 protected:
  static void SetUpTestSuite() {
    setenv("GOMP_SPINCOUNT", "1000", 0);  // or every tool starts itself anew
    inputs_ = new ScratchFolder;
    write_inputs(inputs_->path());
  }
  static void TearDownTestSuite() { delete inputs_; }

  void SetUp() override {
    if (GetParam().stride == 0 && !full()) GTEST_SKIP() << "only with BREAST_FAULT_ALLOCATIONS";
    if (!fs::exists(tool_path(tool()))) GTEST_SKIP() << tool() << " is not built";
    for (const auto& entry : fs::directory_iterator(inputs_->path())) {
      fs::create_symlink(entry.path(), work_ / entry.path().filename().string());
    }
    for (const auto& entry : fs::directory_iterator(work_.path())) {
      given_.insert(entry.path().filename().string());
    }
    setenv("TMPDIR", temporary_.path().c_str(), 1);
    const ToolResult whole = run("", 0, "");
    ASSERT_EQ(whole.exit_code, 0) << whole.err;
    reference_out_ = whole.out;
    move_outputs(reference_.path());
  }
  void TearDown() override { unsetenv("TMPDIR"); }

  static bool heavy() { return GetParam().stride > 5; }
  static std::string tool() {
    const std::string line = GetParam().line;
    return line.substr(0, line.find(' '));
  }
  static std::vector<std::string> arguments() {
    std::vector<std::string> words =
        words_of(std::string(GetParam().line) + " --report out.json --threads 1 --quiet");
    words.erase(words.begin());
    return words;
  }
  // PROGRAM:KIND:N:REASON of the shim.
  static std::string plan(const std::string& kind, long nth, const std::string& reason) {
    return tool() + ':' + kind + ':' + std::to_string(nth) + reason;
  }
  // What the shim finds in the environment of the next runs.
  void set_shim(const std::string& plan) {
    fs::remove(mark());
    if (!plan.empty()) setenv("BREAST_FAULT", plan.c_str(), 1);
    setenv("BREAST_FAULT_MARK", mark().c_str(), 1);
    setenv("LD_PRELOAD", BREAST_SHIM, 1);
  }
  static void unset_shim() {
    for (const char* name : {"BREAST_FAULT", "BREAST_FAULT_MARK", "LD_PRELOAD"}) unsetenv(name);
  }
  static bool branches() { return GetParam().branches_at > 0; }
  std::unique_ptr<BranchedRun> branched(const std::vector<long>& allocations = {}) {
    set_shim("");
    auto run = std::make_unique<BranchedRun>(tool(), arguments(), work_.path(), marks_.path(),
                                             GetParam().branches_at, allocations);
    unset_shim();
    return run;
  }
  BranchedRun& at_output() {
    if (!at_output_) {
      at_output_ = branched();
      if (!at_output_->reached()) throw failed_error(GetParam().name, ": ended before its output");
    }
    return *at_output_;
  }
  // The case with the `nth` call of that kind failing; nothing fails when `kind` is empty.
  ToolResult run(const std::string& kind, long nth, const std::string& reason) {
    const long passed = kind == "output" ? GetParam().branches_at - 1 : 0;  // before the branch
    if (branches() && !kind.empty() && nth > passed) {
      BranchedRun& from = at_output();
      fs::remove(mark());
      return from.attempt(plan(kind, nth - passed, reason));
    }
    if (!kind.empty()) set_shim(plan(kind, nth, reason));
    const ToolResult result = run_tool(tool(), arguments(), work_.path());
    unset_shim();
    return result;
  }
  // The case with files no longer than `bytes`. What it says comes through a pipe, which has no such limit.
  ToolResult run_on_full_disk(rlim_t bytes) {
    if (branches()) return at_output().attempt(plan("output", 0, ""), long(bytes));
    int said[2];
    if (pipe2(said, O_CLOEXEC | O_NONBLOCK) != 0) throw failed_error("no pipe");
    ToolResult result = run_tool(tool(), arguments(), work_.path(), [&] {
      dup2(said[1], STDERR_FILENO);
      signal(SIGXFSZ, SIG_IGN);
      const rlimit limit{bytes, bytes};
      setrlimit(RLIMIT_FSIZE, &limit);
    });
    result.err = text_in(said[0]);
    close(said[0]);
    close(said[1]);
    return result;
  }
  fs::path mark() const { return marks_ / "mark"; }
  std::string marked() const { return fs::exists(mark()) ? read_text(mark()) : ""; }

  std::vector<fs::path> outputs() const {
    std::vector<fs::path> list;
    for (const auto& entry : fs::directory_iterator(work_.path())) {
      if (!given_.contains(entry.path().filename().string())) list.push_back(entry.path());
    }
    return list;
  }
  void move_outputs(const fs::path& to) {
    for (const fs::path& file : outputs()) fs::rename(file, to / file.filename());
  }

  // What is wrong with a run, and the outputs and temporary files it left; empty when nothing is.
  std::string complaint(const ToolResult& result) {
    std::string wrong;
    const auto add = [&](const std::string& text) { wrong += (wrong.empty() ? "" : "; ") + text; };
    if (result.exit_code < 0 || result.exit_code > 3)
      add("exit " + std::to_string(result.exit_code));
    if (result.exit_code > 0 && result.error_lines() != 1) {
      add(std::to_string(result.error_lines()) + " lines on stderr: '" + result.err.substr(0, 400) +
          "'");
    }
    if (result.exit_code == 0 && result.out != reference_out_) add("exit 0 with another stdout");
    std::set<std::string> found;
    for (const fs::path& output : outputs()) {
      for (const fs::path& file : files_of(output)) {
        const fs::path name = fs::relative(file, work_.path());
        found.insert(name.string());
        if (!fs::exists(reference_.path() / name)) {
          add("left " + name.string());
        } else {
          try {
            if (!equal_but_for_time(file, reference_.path() / name)) add("wrong " + name.string());
          } catch (const std::exception& error) {
            add("unreadable " + name.string() + " (" + error.what() + ")");
          }
        }
      }
    }
    if (result.exit_code == 0) {
      for (const auto& [name, content] : files_in(reference_.path())) {
        if (!found.contains(name)) add("exit 0 without " + name);
      }
    }
    for (const auto& entry : fs::directory_iterator(temporary_.path())) {
      add("left in the temporary folder: " + entry.path().filename().string());
    }
    return wrong;
  }
  static std::vector<fs::path> files_of(const fs::path& output) {
    if (!fs::is_directory(output)) return {output};
    std::vector<fs::path> list;
    for (const auto& entry : fs::recursive_directory_iterator(output)) {
      if (!entry.is_directory()) list.push_back(entry.path());
    }
    return list;
  }
  long every_call(const std::string& kind, const std::string& reason, long stride);
  long allocations();
  void fail_at(const std::vector<long>& chosen,
               const std::function<void(long, const ToolResult&)>& judge);
  void clear() {
    for (const fs::path& file : outputs()) fs::remove_all(file);
    for (const auto& entry : fs::directory_iterator(temporary_.path()))
      fs::remove_all(entry.path());
  }

  static inline ScratchFolder* inputs_ = nullptr;
  ScratchFolder work_, reference_, temporary_, marks_;
  std::set<std::string> given_;
  std::string reference_out_;
  std::unique_ptr<BranchedRun> at_output_;
};

// Lets one call after the other fail until none is left; returns how many that were.
long Faults::every_call(const std::string& kind, const std::string& reason, long stride) {
  constexpr long most = 5000;
  for (long n = 1, tried = 0; n <= most; n += stride, ++tried) {
    const ToolResult result = run(kind, n, reason);
    const std::string failed = marked();
    EXPECT_EQ(complaint(result), "")
        << kind << " " << n << reason << ", " << failed.substr(0, failed.find('\n'));
    clear();
    if (failed.find("failed") == std::string::npos) return tried;
  }
  ADD_FAILURE() << "more than " << most << " calls";
  return most;
}

TEST_P(Faults, EveryOutputCallFailsOnce) {
  const long tried =
      every_call("output", ":28+", full() ? 1 : GetParam().stride);  // ENOSPC, from there on
  const long again = full() ? every_call("output", ":5", 1) : 0;     // EIO, this once
  std::printf("%s: %ld failing output calls\n", GetParam().name, tried + again);
  EXPECT_GT(tried, 0);
}

TEST_P(Faults, LostBytesAreMissed) {
  if (heavy() && !full()) GTEST_SKIP() << "only with BREAST_FAULT_ALLOCATIONS";
  std::printf("%s: %ld lost writes\n", GetParam().name,
              every_call("loss", "", full() ? 1 : GetParam().stride));
}

TEST_P(Faults, DamagedBytesAreNoticed) {
  if (heavy() && !full()) GTEST_SKIP() << "only with BREAST_FAULT_ALLOCATIONS";
  std::printf("%s: %ld damaged writes\n", GetParam().name,
              every_call("damage", "", full() ? 1 : GetParam().stride));
}

// No file may be longer than so many bytes, as on a disk that is full there: 64 lengths from 0 to that of the largest output.
TEST_P(Faults, DiskFullAtAnyByte) {
  std::uintmax_t largest = 0;
  for (const auto& [name, content] : files_in(reference_.path()))
    largest = std::max<std::uintmax_t>(largest, content.size());
  const int counts = full() ? 64 : heavy() ? 1 : 3;
  for (int n = 0; n < counts; ++n) {
    const rlim_t bytes = largest * rlim_t(n) / rlim_t(counts);
    const ToolResult result = run_on_full_disk(bytes);
    EXPECT_EQ(complaint(result), "") << bytes << " of " << largest;
    clear();
  }
  std::printf("%s: full at %d sizes below %ju bytes\n", GetParam().name, counts, largest);
}

long Faults::allocations() {
  set_shim(plan("allocation", 0, ""));
  run_tool(tool(), arguments(), work_.path());
  unset_shim();
  clear();
  const std::string counted = marked();
  const std::size_t at = counted.find("counted ");
  return at == std::string::npos ? 0 : std::stol(counted.substr(at + 8));
}

// These allocations (in order) fail, each in a run of its own or from a branch of one run.
void Faults::fail_at(const std::vector<long>& chosen,
                     const std::function<void(long, const ToolResult&)>& judge) {
  if (!branches()) {
    for (const long n : chosen) judge(n, run("allocation", n, ""));
    return;
  }
  const auto from = branched(chosen);
  std::size_t next = 0;
  while (next < chosen.size()) {
    const std::optional<BranchedRun::Branch> here = from->reached();
    ASSERT_TRUE(here.has_value()) << "ended before allocation " << chosen[next];
    const bool last = here->at == "output";  // all others are tried from here
    do {
      judge(chosen[next],
            from->attempt(plan("allocation", last ? chosen[next] - here->allocations : 1, "")));
      ++next;
    } while (last && next < chosen.size());
    if (!last) from->go();
  }
}

TEST_P(Faults, SampledAllocationsFail) {
  const long all = allocations();
  ASSERT_GT(all, 0);
  std::mt19937 random(1);
  int lines = 0, unharmed = 0;
  const int wanted = heavy() && !full() ? 1 : allocations_wanted();
  std::set<long> chosen;
  while (int(chosen.size()) < std::min<long>(wanted, all))
    chosen.insert(std::uniform_int_distribution<long>(1, all)(random));
  fail_at({chosen.begin(), chosen.end()}, [&](long n, const ToolResult& result) {
    const std::string wrong = complaint(result);
    EXPECT_EQ(wrong, "") << "allocation " << n << " of " << all << ", exit " << result.exit_code
                         << ", " << result.err;
    (result.exit_code == 0 ? unharmed : lines) += 1;
    clear();
  });
  std::printf("%s: %ld allocations, %d sampled: %d end in one line, %d did no harm\n",
              GetParam().name, all, lines + unharmed, lines, unharmed);
}

INSTANTIATE_TEST_SUITE_P(Tools, Faults, ::testing::ValuesIn(cases()),
                         [](const auto& tool) { return std::string(tool.param.name); });

}  // namespace
}  // namespace breast::faults
