// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/surroundings.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "core/error.hpp"

namespace breast {

namespace {

int breast_elements(const HexMesh& mesh) {
  const auto first = std::find(mesh.tissue.begin(), mesh.tissue.end(), Tissue::other);
  const auto later =
      std::find_if(first, mesh.tissue.end(), [](Tissue t) { return t != Tissue::other; });
  if (later != mesh.tissue.end() || (first == mesh.tissue.begin() && mesh.elements() > 0)) {
    throw input_error("mesh: element ", first - mesh.tissue.begin(), " of ", mesh.elements(),
                      " is tissue around the breast (other), which must come after all elements of "
                      "the breast");
  }
  return int(first - mesh.tissue.begin());
}

/// The nodes of the elements, which come first. Throws Error (input) if others are between them.
int first_nodes(const HexMesh& mesh) {
  const std::set<int> used(mesh.connectivity.begin(), mesh.connectivity.end());
  if (*used.rbegin() + 1 != int(used.size()))
    throw input_error("mesh: nodes of tissue around the breast (other) come before node ",
                      *used.rbegin(), " of the breast, but must come after all of its nodes");
  return int(used.size());
}

/// Shortens an array that is present.
template <class Value>
void shorten(std::vector<Value>& values, int count) {
  if (!values.empty()) values.resize(std::size_t(count));
}

/// Leaves out the skin around the breast, and its thickness.
void keep_skin(HexMesh& mesh) {
  std::vector<double> thickness;
  for (std::size_t f = 0; f < mesh.skin_thickness.size(); ++f) {
    if (!is_around_breast(mesh, mesh.skin_faces[f].element))
      thickness.push_back(mesh.skin_thickness[f]);
  }
  mesh.skin_thickness = std::move(thickness);
  mesh.skin_faces = of_breast(mesh, mesh.skin_faces);
}

/// The boundary that is neither skin nor chest wall.
std::vector<Face> cut_of(const HexMesh& mesh) {
  std::set<std::pair<int, int>> others;
  for (const auto* faces : {&mesh.skin_faces, &mesh.pectoral_faces})
    for (const Face& face : *faces) others.insert({face.element, face.local});
  std::vector<Face> cut = boundary_faces(mesh);
  std::erase_if(cut, [&](const Face& f) { return others.contains({f.element, f.local}); });
  return cut;
}

}  // namespace

std::vector<Face> of_breast(const HexMesh& mesh, const std::vector<Face>& faces) {
  std::vector<Face> own;
  std::copy_if(faces.begin(), faces.end(), std::back_inserter(own),
               [&](const Face& face) { return !is_around_breast(mesh, face.element); });
  return own;
}

bool have_same_breast(const HexMesh& a, const HexMesh& b) {
  const int elements = breast_elements(a);
  const auto entries = std::ptrdiff_t(elements) * a.nodes_per_element();
  return a.order == b.order && elements == breast_elements(b) &&
         std::equal(a.connectivity.begin(), a.connectivity.begin() + entries,
                    b.connectivity.begin());
}

HexMesh breast_alone(HexMesh mesh) {
  const int elements = breast_elements(mesh);
  if (elements == mesh.elements()) return mesh;
  keep_skin(mesh);
  mesh.pectoral_faces = of_breast(mesh, mesh.pectoral_faces);
  mesh.connectivity.resize(std::size_t(elements) * std::size_t(mesh.nodes_per_element()));
  shorten(mesh.tissue, elements);
  shorten(mesh.fibroglandular_fraction, elements);
  shorten(mesh.pressure, elements);
  shorten(mesh.det_F, elements);
  shorten(mesh.scaled_jacobian, elements);
  const int nodes = first_nodes(mesh);
  shorten(mesh.points, nodes);
  shorten(mesh.imaged, nodes);
  shorten(mesh.reference, nodes);
  shorten(mesh.contact_pressure, nodes);
  mesh.cut_faces = cut_of(mesh);
  std::erase_if(mesh.landmarks, [&](const Landmark& l) { return l.element >= elements; });
  return mesh;
}

}  // namespace breast
