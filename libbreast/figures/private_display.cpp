// SPDX-License-Identifier: GPL-3.0-or-later
#include "figures/private_display.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "core/error.hpp"
#include "core/guarded_child.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

constexpr int start_milliseconds = 30000;
constexpr const char* packages = "install the Debian packages xvfb xauth libgl1-mesa-dri";

void check_installed() {
  std::string path = std::getenv("PATH") != nullptr ? std::getenv("PATH") : "/usr/bin";
  bool server = false;
  for (std::size_t from = 0; from <= path.size() && !server;) {
    const std::size_t to = std::min(path.find(':', from), path.size());
    server = access((path.substr(from, to - from) + "/Xvfb").c_str(), X_OK) == 0;
    from = to + 1;
  }
  if (!server)
    throw failed_error("render needs the X server Xvfb, which is not installed: ", packages);
  // Without the software driver VTK aborts the process when it opens its window.
  std::error_code ignored;
  bool driver = std::getenv("LIBGL_DRIVERS_PATH") != nullptr;
  for (const char* root : {"/usr/lib", "/usr/local/lib"}) {
    for (const auto& folder : fs::directory_iterator(root, ignored)) {
      driver = driver || fs::exists(folder.path() / "dri" / "swrast_dri.so", ignored);
    }
    driver = driver || fs::exists(fs::path(root) / "dri" / "swrast_dri.so", ignored);
  }
  if (!driver) throw failed_error("render needs the software OpenGL driver: ", packages);
}

// In the child: only calls that are safe between fork and exec.
[[noreturn]] void become_server(pid_t parent, int number_pipe, int log) {
  die_with_parent(parent, SIGTERM);
  dup2(log, STDOUT_FILENO);
  dup2(log, STDERR_FILENO);
  dup2(number_pipe, 3);
  if (number_pipe != 3) close(number_pipe);
  execlp("Xvfb", "Xvfb", "-displayfd", "3", "-screen", "0", "1280x1024x24", "-nolisten", "tcp",
         "-noreset", static_cast<char*>(nullptr));
  _exit(127);
}

// The display number Xvfb writes when it is ready; empty when it ended or did not answer in time.
std::string read_number(int descriptor) {
  std::string text;
  while (text.empty() || text.back() != '\n') {
    pollfd waiting{descriptor, POLLIN, 0};
    const int ready = poll(&waiting, 1, start_milliseconds);
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return {};
    std::array<char, 16> buffer;
    const ssize_t count = read(descriptor, buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return {};
    text.append(buffer.data(), std::size_t(count));
  }
  text.pop_back();
  return text;
}

std::string last_line(int log) {
  std::array<char, 2000> buffer{};
  const off_t size = lseek(log, 0, SEEK_END);
  const off_t from = std::max<off_t>(0, size - off_t(buffer.size()));
  const ssize_t count = pread(log, buffer.data(), buffer.size(), from);
  std::string text(buffer.data(), std::size_t(std::max<ssize_t>(0, count)));
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
  const std::size_t start = text.rfind('\n');
  return start == std::string::npos ? text : text.substr(start + 1);
}

void stop(pid_t server) {
  kill(server, SIGTERM);
  while (waitpid(server, nullptr, 0) < 0 && errno == EINTR) {
  }
}

}  // namespace

PrivateDisplay::PrivateDisplay() {
  check_installed();
  int number[2];
  if (pipe2(number, O_CLOEXEC) != 0) throw failed_error("pipe: ", std::strerror(errno));
  const int log = memfd_create("Xvfb's words", MFD_CLOEXEC);
  const pid_t parent = getpid();
  server_ = fork();
  if (server_ == 0) become_server(parent, number[1], log);
  close(number[1]);
  const std::string display = server_ > 0 ? read_number(number[0]) : std::string();
  close(number[0]);
  const std::string words = log >= 0 ? last_line(log) : std::string();
  if (log >= 0) close(log);
  if (display.empty()) {
    if (server_ > 0) stop(server_);
    throw failed_error("Xvfb did not start (", words.empty() ? "no message" : words, "); ",
                       packages);
  }
  name_ = ":" + display;
  setenv("DISPLAY", name_.c_str(), 1);
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  unsetenv("XAUTHORITY");
}

PrivateDisplay::~PrivateDisplay() {
  if (server_ > 0) stop(server_);
}

}  // namespace breast
