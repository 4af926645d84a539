// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of a volume's header before a library reads the file; private to io/volume.
//
// ITK's readers fill missing data with zeros (NIfTI, MetaImage), ignore the checksum (NRRD), assume
// 1 mm and the patient's axes if the header states neither, and abort on axes that are not
// orthonormal. Voxel size and orientation must not be guessed, because left and right could be
// confused.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <string>

#include "image/volume.hpp"

namespace breast {

/// Largest number of voxels of a volume, which take a gigabyte as float.
inline constexpr double most_voxels = double(std::size_t(1) << 28);

/// Most bytes that may follow the voxels: padding, extensions of other programs.
inline constexpr double slack_bytes = 1 << 20;

/// Throws Error (input) unless the data, which may be in another file of the same folder, agree
/// with the header (sizes, checksums), and the header states a voxel size and orientation that
/// check_scan_grid accepts. The format is chosen by the file extension, ignoring case; files with
/// other extensions pass.
void check_header(const std::filesystem::path& file);

/// Voxel size 0.01 to 50 mm, origin within 1e5 mm, axes orthonormal within 1e-3 (left-handed ones
/// are allowed); throws Error (input) beginning with `name` otherwise, also for values not finite.
void check_scan_grid(const std::string& name, const Grid& grid);

/// Sets spacing and direction from three axis vectors; their lengths are the voxel sizes.
void set_axes(Grid& grid, const Mat3& axes);

/// The checks for the individual formats.
void check_nifti(const std::filesystem::path& file);
void check_nrrd(const std::filesystem::path& file);
void check_meta(const std::filesystem::path& file);

/// Notes in the header of a NRRD file ("key:=value").
struct NrrdNotes {
  int dimension = 0;
  std::map<std::string, std::string> values;
};
NrrdNotes nrrd_notes(const std::filesystem::path& file);

/// The file that a header names as the one with its voxels. Throws Error (input) unless it is a
/// regular file named relative to the header's folder and without "..".
std::filesystem::path detached_data(const std::filesystem::path& header, const std::string& name);

/// Throws Error (input) if there are more than most_voxels, or no voxels.
void check_voxel_count(const std::string& name, double voxels);

/// The next line without its '\n'; false at the end. Of a line longer than `longest` no more than one byte beyond that is
/// read, so that a file without line ends does not fill memory.
bool next_line(std::istream& in, std::string& line, std::size_t longest);

/// The numbers of a text such as "(1,0,0)" or "1 0 0"; empty if it contains anything else.
std::vector<double> header_numbers(std::string text);

}  // namespace breast
