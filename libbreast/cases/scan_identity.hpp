// SPDX-License-Identifier: GPL-3.0-or-later
// Whose run a folder holds, so that two patients' scans never share one.
#pragma once

#include <filesystem>
#include <string>

namespace breast {

// A scan is a file, a folder of slices, or phantom:PRESET. Remembered in RUN/.scan are the side, the SHA-256 of its content (of a
// phantom its name) and a stamp of its files (place on the disk, size, times), by which an unchanged scan is recognised without
// reading it again; no path. Size and time alone would not do: archives unpack two patients' slices with the same of both.

/// Why `scan` may not be run in RUN, a sentence; "" where it may, and where the scan is not there: make says so.
std::string mixed_up(const std::filesystem::path& run, const std::string& side,
                     const std::string& scan);
/// Remembers scan and side in RUN/.scan.
void remember_scan(const std::filesystem::path& run, const std::string& side,
                   const std::string& scan);

}  // namespace breast
