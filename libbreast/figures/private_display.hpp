// SPDX-License-Identifier: GPL-3.0-or-later
// A private X display: the packaged VTK 9.1 draws only through X and aborts without a display.
#pragma once

#include <sys/types.h>

#include <string>

namespace breast {

/// Starts Xvfb on a free display number and sets DISPLAY to it, whatever DISPLAY was before, so
/// that pictures are the same on a desktop, over ssh and in a container. Several can run at the
/// same time. The server ends with this object, and also when the process is killed.
class PrivateDisplay {
 public:
  /// Throws Error (failed) naming the Debian packages when Xvfb or the software OpenGL driver is
  /// missing, or with Xvfb's own words when it does not start within 30 s.
  PrivateDisplay();
  ~PrivateDisplay();
  PrivateDisplay(const PrivateDisplay&) = delete;
  PrivateDisplay& operator=(const PrivateDisplay&) = delete;

  const std::string& name() const { return name_; }  ///< ":3"

 private:
  pid_t server_ = -1;
  std::string name_;
};

}  // namespace breast
