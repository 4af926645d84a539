// SPDX-License-Identifier: GPL-3.0-or-later
// Attributes of an object, checked in the bytes of the file before HDF5 reads them.
//
// HDF5 1.10 takes the lengths in an attribute's message as they are, and copies from beyond the message, and from
// beyond its own memory, when they are damaged (H5O__attr_decode). No call of HDF5 shows the lengths.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace breast {

/// What is wrong with the attributes of the object whose header begins at byte `header` of the HDF5 file
/// `file`; empty when nothing is. Headers of version 2 have a checksum, which HDF5 compares.
/// Layout: HDF5 File Format Specification 3.0, sections IV.A.1.a and IV.A.2.m.
std::string wrong_attributes(std::string_view file, std::uint64_t header);

}  // namespace breast
