// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/surroundings.hpp"

#include <algorithm>
#include <iterator>

#include "core/error.hpp"
#include "mesh/part.hpp"

namespace breast {

std::vector<int> breast_elements(const HexTopology& mesh) {
  std::vector<int> own;
  for (int e = 0; e < mesh.elements(); ++e)
    if (!is_around_breast(mesh, e)) own.push_back(e);
  if (own.empty() && mesh.elements() > 0)
    throw input_error("mesh: all ", mesh.elements(),
                      " elements are tissue around a breast (other); none is of the breast");
  return own;
}

std::vector<Face> of_breast(const HexTopology& mesh, const std::vector<Face>& faces) {
  std::vector<Face> own;
  std::copy_if(faces.begin(), faces.end(), std::back_inserter(own),
               [&](const Face& face) { return !is_around_breast(mesh, face.element); });
  return own;
}

bool have_same_breast(const HexMesh& a, const HexMesh& b) {
  return have_same_elements(restricted(a, breast_elements), restricted(b, breast_elements));
}

}  // namespace breast
