// SPDX-License-Identifier: GPL-3.0-or-later
// Notices that a picture is incomplete because memory ran out.
#pragma once

#include <new>

namespace breast {

/// VTK leaves a line or a text out when there is no memory to draw it, and FreeType a letter, both without an error.
/// While this object exists, it watches the requests for memory of operator new and of VTK's FreeType library.
/// One at a time.
class DrawingMemory {
 public:
  DrawingMemory();
  ~DrawingMemory();
  DrawingMemory(const DrawingMemory&) = delete;
  DrawingMemory& operator=(const DrawingMemory&) = delete;

  bool refused() const;  ///< whether a request was refused, so that the picture may lack something

 private:
  std::new_handler before_;
};

}  // namespace breast
