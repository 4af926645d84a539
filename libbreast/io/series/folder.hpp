// SPDX-License-Identifier: GPL-3.0-or-later
// All DICOM images below a folder, such as the export of an archive.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "io/series/image.hpp"

namespace breast {

struct DicomFolder {
  std::vector<DicomImage> images;             ///< in the order of the files' paths
  std::map<std::string, int> without_pixels;  ///< how many objects of each kind
  int copies = 0;                             ///< files that another one repeats byte by byte
  int folders_not_followed = 0;               ///< links
  std::vector<std::filesystem::path> others;  ///< files that are not DICOM
  struct Damage {
    std::string series_uid, text;  ///< series "" if the damage comes before it
  };
  std::vector<Damage> damaged;
};

/// Searches the folder and those below it, or one file; follows links to files, not to folders. Files of other kinds and hidden ones
/// are passed over; one that ends with .dcm and is not DICOM is damage. Throws Error (input)
/// if there are more than 200 000 files.
DicomFolder find_images(const std::filesystem::path& folder);

}  // namespace breast
