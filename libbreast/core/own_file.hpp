// SPDX-License-Identifier: GPL-3.0-or-later
// Recognition of files written by libbreast, so that a result never replaces another program's
// file.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace breast {

/// The word that libbreast writes into files whose format does not name their maker: the comment of
/// a NRRD or MetaImage header, the description of a NIfTI header and the comment of a gzip stream,
/// a text chunk of a PNG, the manufacturer of a DICOM file, the first lines of a deck or page.
inline constexpr std::string_view maker_mark = "libbreast";

/// True when a file's content says that this toolkit wrote it, or when it is empty. HDF5: the seal,
/// or the units that every file of libbreast states; VTK XML: the seal or a history; JSON: a
/// report's first key; tables: the closing line (table.hpp); everything else: maker_mark where the
/// format has a place for it. False also for a file that cannot be read.
bool written_by_us(const std::filesystem::path& file);

/// Throws Error (input) if a file exists at `target` that was not written by libbreast. `label` is
/// the argument that named it.
void check_replaceable(const std::filesystem::path& target, const std::string& label);

/// A PNG file with maker_mark as its "Software" text.
std::string marked_png(std::string_view png);

}  // namespace breast
