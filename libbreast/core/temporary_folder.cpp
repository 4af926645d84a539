#include "core/temporary_folder.hpp"

#include <unistd.h>

#include <cstdlib>

#include "core/error.hpp"
#include "core/leftovers.hpp"

namespace breast {

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "breast-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw failed_error(name, ": no temporary folder");
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
