// SPDX-License-Identifier: GPL-3.0-or-later
// The scan and the side to which the run in a folder belongs, so that the scans of two patients
// never share a folder.
#pragma once

#include <filesystem>
#include <string>

namespace breast {

// A scan is a file, a folder of slices, or phantom:PRESET. The file RUN/.scan contains the side,
// the SHA-256 hash of the scan's content (for a phantom its name), and a stamp of its files
// (device, inode, size and times), by which an unchanged scan is recognised without reading it
// again. It contains no path. Size and modification time alone are not sufficient, because archives
// may unpack the slices of two patients with equal sizes and times.

/// A sentence that says why `scan` and `side` must not be used in RUN, which holds another run;
/// "" if they may be used. Returns "" also if the scan does not exist, which make reports. Throws
/// Error (input) if a file of the scan cannot be read.
std::string mixed_up(const std::filesystem::path& run, const std::string& side,
                     const std::string& scan);
/// Records the scan and the side in RUN/.scan; creates the folder RUN if it does not exist. Throws
/// Error (input) if a file of the scan cannot be read.
void remember_scan(const std::filesystem::path& run, const std::string& side,
                   const std::string& scan);

}  // namespace breast
