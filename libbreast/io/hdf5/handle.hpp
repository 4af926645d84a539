// SPDX-License-Identifier: GPL-3.0-or-later
// HDF5 identifiers that close themselves; included by what reads and writes HDF5 only.
#pragma once

#include <hdf5.h>

#include <mutex>
#include <utility>

namespace breast {

class Handle {
 public:
  Handle(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }
  /// Closes the identifier; returns false if HDF5 fails to (data not flushed).
  bool close() { return close_(std::exchange(id_, -1)) >= 0; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Debian's serial HDF5 is not thread-safe.
inline std::mutex& hdf5_mutex() {
  static std::mutex mutex;
  return mutex;
}
/// Switches off HDF5's printing of its error stack; the error message of libbreast suffices.
inline void silence_hdf5() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

}  // namespace breast
