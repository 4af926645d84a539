// SPDX-License-Identifier: GPL-3.0-or-later
// Which volume of a DICOM folder is read.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "image/volume.hpp"
#include "io/scan_choice.hpp"
#include "io/series/folder.hpp"
#include "io/series/stack.hpp"

namespace breast {

/// A folder's volumes, what else it holds, and the one to be read.
struct ChosenStack {
  int number = 0;  ///< of the list, from 1; 0: none
  DicomStack stack;
  std::vector<std::string> remarks;  ///< what was taken and what was passed over
};

/// The volume asked for, by its number or else the best. Throws Error (input) if there is none, if two are
/// equally good, and if what was asked for is no volume or damaged.
ChosenStack chosen_stack(const std::filesystem::path& folder, const ScanChoice& choice);

/// The table of a folder's series and, as remarks, what else lies below it.
struct SeriesList {
  Table table;
  std::vector<std::string> remarks;
};
SeriesList list_stacks(const std::filesystem::path& folder, const ScanChoice& choice);

/// The voxels of a stack. Throws Error (input) if its pixels cannot be decoded.
Volume<float> read_stack(const DicomStack& stack);

}  // namespace breast
