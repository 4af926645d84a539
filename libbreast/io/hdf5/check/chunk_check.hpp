// SPDX-License-Identifier: GPL-3.0-or-later
// Chunks of a dataset, checked in the bytes of the file before HDF5 reads them.
//
// HDF5 1.10 copies a whole chunk from its buffer without asking how many bytes it holds. When the type was damaged
// after the chunks were laid out, or when a compressed chunk inflates to less than its shape asks for, the rest comes
// from beyond that buffer (H5D__chunk_lock).
#pragma once

#include <hdf5.h>

#include <string>
#include <string_view>

namespace breast {

/// What is wrong with the chunks of `dataset`, as words that follow its name; empty when nothing is. `layout` are its
/// creation properties, `value_bytes` the size of one value of its type, `file` the bytes of the HDF5 file. Every chunk
/// must hold, once the filters deflate, shuffle and fletcher32 are undone, as many bytes as its shape and type ask for.
std::string wrong_chunks(hid_t dataset, hid_t layout, std::size_t value_bytes,
                         std::string_view file);

}  // namespace breast
