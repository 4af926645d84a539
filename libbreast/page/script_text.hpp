// SPDX-License-Identifier: GPL-3.0-or-later
// Values as JavaScript literals inside an HTML page: text that cannot end the script, and bytes in
// base64.
#pragma once

#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace breast {

/// A text as a JavaScript string. Names may come from files written by anybody, so only letters,
/// digits and harmless punctuation are kept as they are, and no byte can end the string, the line
/// or the script element. Bytes that are not valid UTF-8 become U+FFFD.
std::string script_text(const std::string& text);

/// Bytes in base64, in double quotes.
std::string script_bytes(std::string_view bytes);

/// The memory of an array of numbers in base64, in double quotes; little-endian on every supported
/// processor.
template <class T>
std::string script_array(const std::vector<T>& values) {
  static_assert(std::is_arithmetic_v<T>);
  return script_bytes({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
}

}  // namespace breast
