// SPDX-License-Identifier: GPL-3.0-or-later
// Typed errors. The kind decides the exit code of a tool; the message is one line saying what, where,
// the value, the bound and what to try.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <sstream>
#include <stdexcept>
#include <string>

namespace breast {

enum class ErrorKind {
  failed,         ///< exit 1: unexpected failure (disk full, library failure)
  input,          ///< exit 2: bad usage or bad input file
  not_converged,  ///< exit 3: the solve stopped without an acceptable solution
};

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }
  int exit_code() const { return static_cast<int>(kind_) + 1; }

 private:
  ErrorKind kind_;
};

/// Anything that can be streamed, for message(): code for a type is compiled once instead of for
/// every message.
class Piece {
 public:
  template <class T>
  Piece(const T& value)
      : value_(&value),
        print_([](std::ostream& out, const void* p) { out << *static_cast<const T*>(p); }) {}
  template <std::size_t N>
  Piece(const char (&text)[N])
      : value_(text),
        print_([](std::ostream& out, const void* p) { out << static_cast<const char*>(p); }) {}
  void print(std::ostream& out) const { print_(out, value_); }

 private:
  const void* value_;
  void (*print_)(std::ostream&, const void*);
};
/// The concatenation of the pieces.
std::string joined(std::initializer_list<Piece> pieces);

/// Message from streamed pieces: input_error("thickness ", t, " mm: must be positive").
template <class... Parts>
std::string message(const Parts&... parts) {
  return joined({Piece(parts)...});
}

template <class... Parts>
Error input_error(const Parts&... parts) {
  return Error(ErrorKind::input, message(parts...));
}
template <class... Parts>
Error failed_error(const Parts&... parts) {
  return Error(ErrorKind::failed, message(parts...));
}
template <class... Parts>
Error not_converged_error(const Parts&... parts) {
  return Error(ErrorKind::not_converged, message(parts...));
}

}  // namespace breast
