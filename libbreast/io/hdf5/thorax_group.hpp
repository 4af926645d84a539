// SPDX-License-Identifier: GPL-3.0-or-later
// The surface the breast slides on, <-> group /breast/thorax of geometry and mesh files.
#pragma once

#include "io/hdf5/fields.hpp"
#include "surface/thorax.hpp"

namespace breast {

void put_thorax(Document& document, const ThoraxSurface& thorax);
/// Throws through `fields` for values that are no surface.
ThoraxSurface get_thorax(Fields& fields);
bool has_thorax(const Fields& fields);

}  // namespace breast
