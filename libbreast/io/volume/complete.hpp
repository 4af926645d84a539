// Is a volume file whole? ITK's readers fill what is missing with zeros (NIfTI, MetaImage), do not
// look at the checksum (NRRD) or abort the program (GDCM built with assertions), so completeness is
// checked before they see the file.
#pragma once

#include <filesystem>

namespace breast {

/// Throws Error (input) when a .nii, .nii.gz, .mha or .mhd file holds fewer bytes than its header
/// announces, or the compressed stream of a NIfTI or NRRD file does not end with the checksum and
/// length of what it holds. Other endings pass.
void check_complete(const std::filesystem::path& file);

}  // namespace breast
