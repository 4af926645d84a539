// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/temporary_folder.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>

#include "core/error.hpp"

namespace breast {

namespace {

struct Slot {
  std::atomic<pid_t> owner{0};  ///< 0: free
  char path[1024];
};
Slot slots[8];

}  // namespace

void note_leftover(const char* folder) noexcept {
  if (std::strlen(folder) >= sizeof slots[0].path) return;
  for (Slot& slot : slots) {
    pid_t nobody = 0;
    if (!slot.owner.compare_exchange_strong(nobody, -1)) continue;
    std::strcpy(slot.path, folder);
    slot.owner = getpid();
    return;
  }
}

void forget_leftover(const char* folder) noexcept {
  for (Slot& slot : slots) {
    if (slot.owner == getpid() && std::strcmp(slot.path, folder) == 0) slot.owner = 0;
  }
}

void remove_leftovers() noexcept {
  for (Slot& slot : slots) {
    if (slot.owner != getpid()) continue;
    // Another program does it: nothing in this process can be relied on any more.
    const pid_t child = vfork();
    if (child == 0) {
      execl("/bin/rm", "rm", "-rf", "--", slot.path, static_cast<char*>(nullptr));
      _exit(1);
    }
    if (child > 0) waitpid(child, nullptr, 0);
  }
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "breast-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr)
    throw failed_error(name, ": no temporary folder can be created");
  note_leftover(name.c_str());
  try {
    path_ = name;
  } catch (...) {
    rmdir(name.c_str());
    throw;
  }
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  forget_leftover(path_.c_str());
}

}  // namespace breast
