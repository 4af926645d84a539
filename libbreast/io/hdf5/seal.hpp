// The seal: 80 bytes after the end of the HDF5 data, holding a digest of the whole file.
//
// HDF5 ignores what follows its own end, and drops it when it changes the file, so a file edited
// through HDF5 (h5py) is simply unsealed, while a file damaged on disk or in transfer no longer
// agrees with its seal. Sealed files are checked before HDF5 parses them: its 1.10 parser can crash
// on damage.
#pragma once

#include <filesystem>

namespace breast {

/// Appends the seal to a finished HDF5 file.
void seal_file(const std::filesystem::path& file);

/// Throws Error (input) in one line, beginning with `name`, when the file is not HDF5, is
/// truncated, or disagrees with its seal. `advice` ends the message.
void check_seal(const std::filesystem::path& file, const std::string& name,
                const std::string& advice);

}  // namespace breast
