// SPDX-License-Identifier: GPL-3.0-or-later
// A volume's header: checks before a library reads the file, and the grid; private to io/volume.
//
// ITK's readers fill missing data with zeros (MetaImage), ignore the checksum (NRRD), and assume 1 mm,
// the patient's axes, origin 0 and mm if the header states none or another. Where the voxels are must
// not be guessed, so the grid is read here, and ITK is asked for the voxels alone.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>

#include "image/volume.hpp"

namespace breast {

/// Largest number of voxels of a volume, which take a gigabyte as float.
inline constexpr double most_voxels = double(std::size_t(1) << 28);

/// Voxel size 0.01 to 50 mm, origin within 1e5 mm, axes orthonormal within 1e-3 (left-handed ones
/// are allowed); throws Error (input) beginning with `name` otherwise, also for values not finite.
void check_scan_grid(const std::string& name, const Grid& grid);

/// Sets spacing and direction from three axis vectors; their lengths are the voxel sizes.
void set_axes(Grid& grid, const Mat3& axes);

/// Voxel size, origin (mm) and directions (LPS) as the header of a NRRD or MetaImage states them; the
/// number of voxels along the axes is left to the reader of the voxels. Throws Error (input) unless the
/// data, which may be in another file of the same folder, agree with the header (sizes, checksums), and
/// the header states a grid that check_scan_grid accepts.
Grid nrrd_grid(const std::filesystem::path& file);
Grid meta_grid(const std::filesystem::path& file);

/// Reads a NIfTI in a single file, plain or gzip, after the same checks of its header and data.
Volume<float> read_nifti(const std::filesystem::path& file);

/// mm of a unit of length by its symbol (m, cm, mm, um); nothing for another text.
std::optional<double> unit_mm(const std::string& symbol);

/// Throws Error (input) unless a file holds exactly the bytes of voxels that its header announces:
/// of a longer file it is unknown which of them are the volume.
void check_voxel_bytes(const std::string& name, double found, double announced);

/// Notes in the header of a NRRD file ("key:=value").
struct NrrdNotes {
  int dimension = 0;
  std::map<std::string, std::string> values;
};
NrrdNotes nrrd_notes(const std::filesystem::path& file);

/// The file that a header names as the one with its voxels. Throws Error (input) unless it is a
/// regular file named relative to the header's folder and without "..".
std::filesystem::path detached_data(const std::filesystem::path& header, const std::string& name);

/// Throws Error (input) unless `sizes` along the axes are those of one volume: three, and 1 along others.
void check_volume_sizes(const std::string& name, const std::vector<double>& sizes);

/// Throws Error (input) if there are more than most_voxels, or no voxels.
void check_voxel_count(const std::string& name, double voxels);

/// The next line without its '\n'; false at the end. Of a line longer than `longest` no more than one byte beyond that is
/// read, so that a file without line ends does not fill memory.
bool next_line(std::istream& in, std::string& line, std::size_t longest);

/// The numbers of a text such as "(1,0,0)" or "1 0 0"; empty if it contains anything else.
std::vector<double> header_numbers(std::string text);

}  // namespace breast
