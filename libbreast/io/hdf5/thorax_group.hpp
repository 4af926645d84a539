// SPDX-License-Identifier: GPL-3.0-or-later
// Reading and writing of /breast/thorax, the surface on which the breast slides, in geometry and
// mesh files.
#pragma once

#include "io/hdf5/fields.hpp"
#include "surface/thorax.hpp"

namespace breast {

void put_thorax(Document& document, const ThoraxSurface& thorax);
/// Throws through `fields` for values that do not describe a surface.
ThoraxSurface get_thorax(Fields& fields);
bool has_thorax(const Fields& fields);

}  // namespace breast
