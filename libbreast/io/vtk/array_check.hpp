// SPDX-License-Identifier: GPL-3.0-or-later
// Checks of what the arrays of a VTK XML file state about their own bytes.
#pragma once

#include <string>
#include <string_view>

class vtkXMLDataElement;

namespace breast {

/// What is impossible in the compressed arrays that stand in base64 between their tags in `text`,
/// the file of that root element: more blocks than are there, blocks longer than their file or
/// larger than they can become, or fewer bytes than the values that the array must have. Empty when
/// nothing is. VTK allocates what these numbers state before it looks.
std::string impossible_array(vtkXMLDataElement* root, std::string_view text);

}  // namespace breast
