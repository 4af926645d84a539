// SPDX-License-Identifier: GPL-3.0-or-later
// Work in a child process: what it hands over, and that it never outlives its tool.
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.hpp"
#include "core/guarded_child.hpp"
#include "fixtures/complaint.hpp"

namespace breast {
namespace {

using fixtures::complaint;

TEST(GuardedChild, HandsOverResultsErrorsAndDeaths) {
  EXPECT_EQ(in_guarded_child("file", [] { return std::string(5'000'000, 'x'); }).size(),
            5'000'000u);
  EXPECT_EQ(in_guarded_child("file", [] { return std::string(); }), "");
  EXPECT_EQ(complaint([] {
              in_guarded_child("file", []() -> std::string { throw input_error("file: is bad"); });
            }),
            "file: is bad");
  EXPECT_THROW(
      in_guarded_child("file", []() -> std::string { throw failed_error("disk: is full"); }),
      Error);
  for (const int fault : {SIGSEGV, SIGABRT, SIGFPE, SIGKILL}) {
    const std::string text = complaint([&] {
      in_guarded_child("file", [&]() -> std::string {
        raise(fault);
        return "";
      });
    });
    EXPECT_NE(text.find("file: damaged"), std::string::npos) << text;
  }
  EXPECT_NE(complaint([] {
              in_guarded_child(
                  "file",
                  []() -> std::string {
                    while (true) pause();
                  },
                  0.5);
            }).find("0.5 s"),
            std::string::npos);
}

// A tool may die before its child has asked to be killed with it. The child here cancels that request,
// which has the same effect, and sends more than a pipe holds.
TEST(GuardedChild, EndsWhenItsToolIsGone) {
  int alive[2];  // ends when no process holds its write end any more
  ASSERT_EQ(pipe(alive), 0);
  const pid_t tool = fork();
  if (tool == 0) {
    in_guarded_child("file", [tool = getpid()] {
      prctl(PR_SET_PDEATHSIG, 0);
      kill(tool, SIGKILL);
      return std::string(5'000'000, 'x');
    });
    _exit(0);
  }
  close(alive[1]);
  int status = 0;
  waitpid(tool, &status, 0);
  EXPECT_TRUE(WIFSIGNALED(status));
  pollfd end{alive[0], POLLIN, 0};
  constexpr int wait_ms = 20000;
  EXPECT_EQ(poll(&end, 1, wait_ms), 1) << "the child waits for a reader that is gone";
  close(alive[0]);
}

}  // namespace
}  // namespace breast
