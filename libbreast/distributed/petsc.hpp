// SPDX-License-Identifier: GPL-3.0-or-later
// PETSc's objects owned, its error codes as errors. For the .cpp files of this folder only.
#pragma once

#include <petscksp.h>

#include <utility>

#include "core/error.hpp"

namespace breast {

/// Throws Error (failed) for what a call of PETSc returned other than zero.
inline void ask(PetscErrorCode code) {
  if (code == 0) return;
  const char* text = nullptr;
  PetscErrorMessage(code, &text, nullptr);
  throw failed_error("PETSc: ", text != nullptr ? text : "error", " (code ", int(code), ")");
}

/// A Mat, Vec, KSP or IS, destroyed with its owner.
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
  /// For calls that make the object; what was there before goes.
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
