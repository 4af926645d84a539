// SPDX-License-Identifier: GPL-3.0-or-later
// Interface for progress reports: the library never prints, and tools show a bar or occasional
// lines.
#pragma once

#include <string>
#include <string_view>

namespace breast {

class Progress {
 public:
  virtual ~Progress() = default;
  /// `fraction` in [0,1] of the current stage, negative when unknown; `detail` is short
  /// ("step 4, residual 3e-7, 42 % reduction").
  virtual void update(std::string_view stage, double fraction, std::string_view detail) = 0;
  /// A remark that the user should see once (a warning, a decision).
  virtual void note(std::string_view text) = 0;
};

/// Silent sink: the default of every library call.
Progress& no_progress();

}  // namespace breast
