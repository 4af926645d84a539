// SPDX-License-Identifier: GPL-3.0-or-later
// Chunks of a dataset, checked in the bytes of the file before HDF5 reads them.
//
// HDF5 1.10 copies a whole chunk out of its buffer without asking how many bytes the buffer holds, and reads beyond its
// end when these are too few (H5D__chunk_lock). They are too few when the type was damaged after the file was written,
// or when a compressed chunk inflates to less than it should.
#pragma once

#include <hdf5.h>

#include <string>
#include <string_view>

namespace breast {

/// Checks how a dataset is laid out in chunks: by filters that every HDF5 has (deflate, shuffle, fletcher32) and in a size
/// that fits in memory. `layout` are the creation properties of the dataset, `value_bytes` is the size of one value.
/// Returns what is wrong, as words that follow the dataset's name, or an empty text.
std::string wrong_layout(hid_t layout, std::size_t value_bytes);

/// Checks that every chunk of a dataset so laid out holds the number of bytes that its shape and type ask for, once the
/// filters are undone; compressed chunks are inflated for it. `file` holds the bytes of the HDF5 file. Returns words like
/// wrong_layout.
std::string wrong_chunks(hid_t dataset, hid_t layout, std::size_t value_bytes,
                         std::string_view file);

}  // namespace breast
