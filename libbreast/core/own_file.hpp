// SPDX-License-Identifier: GPL-3.0-or-later
// Recognition of files written by libbreast, so that a result never replaces another program's
// file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace breast {

/// The word that libbreast writes into files of formats that do not name their maker: the comment
/// of a NRRD or MetaImage header, the description of a NIfTI header, the comment of a gzip stream,
/// a text chunk of a PNG, the manufacturer of a DICOM file, and the first lines of an input file or
/// page.
inline constexpr std::string_view maker_mark = "libbreast";

/// True if the content of a file shows that libbreast wrote it, or if it is empty. The criterion is
/// for HDF5 the seal, or the units stated in every file of libbreast; for VTK XML the seal or a
/// history; for JSON the first key of a report; for tables the closing line (table.hpp); for other
/// formats maker_mark, if the format has a place for it. False also for a file that cannot be read.
bool written_by_us(const std::filesystem::path& file);

/// Throws Error (input) if a file exists at `target` that was not written by libbreast. `label` is
/// the argument that named it.
void check_replaceable(const std::filesystem::path& target, const std::string& label);

/// A PNG file with maker_mark as its "Software" text.
std::string marked_png(std::string_view png);

}  // namespace breast
