#include "core/temporary_folder.hpp"

#include <cstdlib>

#include "core/error.hpp"

namespace breast {

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "breast-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw failed_error(name, ": no temporary folder");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace breast
