// SPDX-License-Identifier: GPL-3.0-or-later
#include "study/places.hpp"

namespace breast {

namespace fs = std::filesystem;

fs::path variant_of(const fs::path& run, const std::string& study, const std::string& folder,
                    const std::string& variant) {
  const fs::path own = run / "studies" / study;
  return (fs::is_directory(own) ? own : run / folder) / variant;
}

std::string stage_of(const fs::path& variant, const std::string& stage) {
  return fs::is_directory(variant) ? (variant / stage).string() : variant.string() + "-" + stage;
}

}  // namespace breast
