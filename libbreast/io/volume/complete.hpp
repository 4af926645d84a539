// Is a volume file whole? ITK's readers fill what is missing with zeros (NIfTI, MetaImage), do not
// look at the checksum (NRRD) or abort the program (GDCM built with assertions), so completeness is
// checked before they see the file.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace breast {

/// Throws Error (input) when a .nii, .nii.gz, .mha or .mhd file holds fewer bytes than its header
/// announces, or the compressed stream of a NIfTI or NRRD file does not end with the checksum and
/// length of what it holds. Other endings pass.
void check_complete(const std::filesystem::path& file);

/// Elements of a DICOM file at top level, as text; key "GGGG|EEEE" in lower-case hex.
/// Only elements of at most 256 bytes are kept.
using DicomHeader = std::map<std::string, std::string>;

/// Walks through all elements of a DICOM file. Returns false when the file is not DICOM at all;
/// throws Error (input) when it is but is damaged, truncated, or in a transfer syntax we do not
/// read.
bool read_dicom_header(const std::filesystem::path& file, DicomHeader& header);

}  // namespace breast
