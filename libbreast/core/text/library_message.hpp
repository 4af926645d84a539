// SPDX-License-Identifier: GPL-3.0-or-later
// Exception texts of ITK and other libraries, as a user reads them.
#pragma once

#include <string>

namespace breast {

/// The text in one line of at most 200 bytes, without "itk::ERROR:" and without addresses in memory
/// ("NrrdImageIO(0x55d1...): "), which say nothing to a reader and differ from run to run.
std::string library_message(const std::string& text);

}  // namespace breast
