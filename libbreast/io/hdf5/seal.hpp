// SPDX-License-Identifier: GPL-3.0-or-later
// The seal: 80 bytes after the end of the HDF5 data, holding a digest of the whole file.
//
// HDF5 ignores what follows its own end, and drops it when it changes the file, so a file edited
// through HDF5 (h5py) is simply unsealed, while a file damaged on disk or in transfer no longer
// agrees with its seal. Sealed files are checked before HDF5 parses them: its 1.10 parser can crash
// on damage.
#pragma once

#include <string>
#include <string_view>

namespace breast {

/// The bytes of a finished HDF5 file with the seal behind them.
std::string sealed(std::string content);

/// Throws Error (input) in one line, beginning with `name`, when a file of these bytes
/// is not HDF5, is truncated, or disagrees with its seal. `advice` ends the message.
void check_seal(std::string_view content, const std::string& name, const std::string& advice);

}  // namespace breast
