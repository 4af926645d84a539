// SPDX-License-Identifier: GPL-3.0-or-later
// What kind of object a DICOM file holds, by its SOP class (PS3.4 annex B).
#pragma once

#include <string>

namespace breast {

/// "presentation state", "structured report", "MR image", ...; of an unknown class "object of class UID".
std::string object_kind(const std::string& sop_class);

/// True for classes of images, whose objects are damaged if they hold no pixels.
bool is_image_class(const std::string& sop_class);

}  // namespace breast
