// SPDX-License-Identifier: GPL-3.0-or-later
// Owning handles for PETSc objects, and conversion of PETSc's error codes to errors. For the .cpp
// files of this folder only.
#pragma once

#include <petscksp.h>

#include <utility>

#include "core/error.hpp"

namespace breast {

/// Throws Error (failed) if a call of PETSc returned a code other than zero.
inline void ask(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw failed_error("PETSc: ", text != nullptr ? text : "error", " (code ", int(code), ")");
}

/// A Mat, Vec, KSP or IS that is destroyed with its owner.
template <class T, PetscErrorCode (*destroy)(T*)>
class Owned {
 public:
  Owned() = default;
  explicit Owned(T object) : object_(object) {}
  Owned(Owned&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  Owned& operator=(Owned&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~Owned() { reset(); }
  void reset() {
    if (object_ != nullptr) destroy(&object_);
    object_ = nullptr;
  }
  /// Address for calls that create the object; the previous object is destroyed.
  T* fresh() {
    reset();
    return &object_;
  }
  operator T() const { return object_; }

 private:
  T object_ = nullptr;
};
using OwnedMat = Owned<Mat, MatDestroy>;
using OwnedVec = Owned<Vec, VecDestroy>;
using OwnedKsp = Owned<KSP, KSPDestroy>;

}  // namespace breast
