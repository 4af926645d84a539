// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of /breast/hermite: the two sheets and the rim, in geometry files and in the
// meshes made from them.
#pragma once

#include "io/hdf5/fields.hpp"
#include "surface/hermite.hpp"

namespace breast {

/// Whether a geometry contains sheets; the geometry of a phantom's mesh contains only the surface
/// on which the breast slides.
bool has_sheets(const BreastGeometry& geometry);

/// Reads or writes sheets and rim, if there are any, and the thorax (thorax_group.hpp).
void put_hermite(Document& document, const BreastGeometry& geometry);
/// Everything but history, side and content_sha256.
BreastGeometry get_hermite(Fields& fields);
/// Shapes and ranges that the sheets must satisfy; throws through `complain`.
void check_geometry(const BreastGeometry& geometry, const Complaint& complain);

}  // namespace breast
