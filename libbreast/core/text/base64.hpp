// SPDX-License-Identifier: GPL-3.0-or-later
// Bytes as text (RFC 4648).
#pragma once

#include <string>
#include <string_view>

namespace breast {

std::string base64(std::string_view bytes);

}  // namespace breast
