// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of VTK's error messages, which it prints on stderr, to typed errors.
#pragma once

#include <string>

namespace breast {

/// While an object of this class exists, VTK's messages are collected instead of printed. Not for
/// concurrent use.
class VtkMessages {
 public:
  VtkMessages();
  ~VtkMessages();
  VtkMessages(const VtkMessages&) = delete;
  VtkMessages& operator=(const VtkMessages&) = delete;

  bool error() const;
  /// First error on one line, without source file and pointer values; empty when there was none.
  std::string first() const;
};

}  // namespace breast
