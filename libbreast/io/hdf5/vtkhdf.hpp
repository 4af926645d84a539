// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of the /VTKHDF group in the form that vtkHDFReader of VTK 9.1 requires
// (VTKHDF 1.0).
#pragma once

#include "image/volume.hpp"
#include "io/hdf5/fields.hpp"

namespace breast {

/// offsets: cells + 1 entries; types: VTK cell types.
void put_unstructured_grid(Document& document, const std::vector<Vec3>& points,
                           Integers connectivity, Integers offsets, Bytes types);
/// Checks the counts, offsets and node indices against each other; leaves every dataset in place.
void check_unstructured_grid(Fields& fields);

void put_image_grid(Document& document, const Grid& grid);
Grid get_image_grid(Fields& fields);
void check_grid(const Grid& grid, const Complaint& complain);

}  // namespace breast
