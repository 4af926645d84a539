// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/progress.hpp"

namespace breast {

namespace {
class Silent final : public Progress {
  void update(std::string_view, double, std::string_view) override {}
  void note(std::string_view) override {}
};
}  // namespace

Progress& no_progress() {
  static Silent silent;
  return silent;
}

}  // namespace breast
