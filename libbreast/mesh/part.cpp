// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/part.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

namespace breast {

namespace {

constexpr int absent = -1;

/// Numbers in the whole mesh, which a mesh that is no part does not store.
std::vector<int> numbers_or_all(const std::vector<int>& stored, int count) {
  if (!stored.empty()) return stored;
  std::vector<int> all(static_cast<std::size_t>(count));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// The entries of an array, if it is present, at the given places.
template <class Value>
std::vector<Value> taken(const std::vector<Value>& values, const std::vector<int>& places) {
  std::vector<Value> list;
  if (values.empty()) return list;
  list.reserve(places.size());
  for (const int place : places) list.push_back(values[std::size_t(place)]);
  return list;
}

/// Where each of `count` entries comes to lie when only those at `places` are kept.
std::vector<int> inverse(const std::vector<int>& places, int count) {
  std::vector<int> at(static_cast<std::size_t>(count), absent);
  for (std::size_t i = 0; i < places.size(); ++i) at[std::size_t(places[i])] = int(i);
  return at;
}

int renumbered(const std::vector<int>& at, int old) {
  return old < 0 ? absent : at[std::size_t(old)];
}

/// Where each of the ascending numbers is in another ascending list; none if it lacks one.
std::optional<std::vector<int>> places_of(const std::vector<int>& numbers,
                                          const std::vector<int>& list) {
  std::vector<int> places;
  for (const int number : numbers) {
    const auto found = std::lower_bound(list.begin(), list.end(), number);
    if (found == list.end() || *found != number) return {};
    places.push_back(int(found - list.begin()));
  }
  return places;
}

/// The number of nodes, of which each belongs to an element.
int node_count(const HexTopology& mesh) {
  return mesh.connectivity.empty() ? 0 : 1 + *std::ranges::max_element(mesh.connectivity);
}

std::vector<int> nodes_used(const HexTopology& mesh, const std::vector<int>& elements) {
  std::vector<char> used(std::size_t(node_count(mesh)), 0);
  for (const int e : elements)
    for (int a = 0; a < mesh.nodes_per_element(); ++a) used[std::size_t(mesh.element(e)[a])] = 1;
  std::vector<int> nodes;
  for (std::size_t n = 0; n < used.size(); ++n)
    if (used[n]) nodes.push_back(int(n));
  return nodes;
}

std::vector<Face> renumbered(const std::vector<Face>& faces, const std::vector<int>& element_at) {
  std::vector<Face> list;
  for (const Face& face : faces) {
    const int element = element_at[std::size_t(face.element)];
    if (element != absent) list.push_back({element, face.local});
  }
  return list;
}

std::vector<double> kept_thickness(const HexTopology& mesh, const std::vector<int>& element_at) {
  std::vector<double> list;
  for (std::size_t f = 0; f < mesh.skin_thickness.size(); ++f) {
    if (element_at[std::size_t(mesh.skin_faces[f].element)] != absent)
      list.push_back(mesh.skin_thickness[f]);
  }
  return list;
}

/// The boundary that is neither skin nor chest wall.
std::vector<Face> cut_of(const HexTopology& mesh) {
  std::set<std::pair<int, int>> others;
  for (const auto* faces : {&mesh.skin_faces, &mesh.pectoral_faces})
    for (const Face& face : *faces) others.insert({face.element, face.local});
  std::vector<Face> cut = boundary_faces(mesh);
  std::erase_if(cut, [&](const Face& f) { return others.contains({f.element, f.local}); });
  return cut;
}

void restrict_landmarks(HexTopology& mesh, const std::vector<int>& element_at) {
  for (Landmark& landmark : mesh.landmarks)
    landmark.element = element_at[std::size_t(landmark.element)];
  std::erase_if(mesh.landmarks, [](const Landmark& l) { return l.element == absent; });
}

void restrict_contact(ContactRecord& contact, const std::vector<int>& node_at) {
  contact.face_rules.clear();
  for (FrictionRecord& held : contact.friction) held.node = renumbered(node_at, held.node);
  std::erase_if(contact.friction, [](const FrictionRecord& held) { return held.node == absent; });
}

}  // namespace

HexTopology PartIndices::restricted(HexTopology mesh) const {
  const int count = node_count(mesh);
  const std::vector<int> element_at = inverse(elements, mesh.elements());
  const std::vector<int> node_at = inverse(nodes, count);
  mesh.element_numbers = taken(numbers_or_all(mesh.element_numbers, mesh.elements()), elements);
  mesh.node_numbers = taken(numbers_or_all(mesh.node_numbers, count), nodes);
  std::vector<int> connectivity;
  connectivity.reserve(elements.size() * std::size_t(mesh.nodes_per_element()));
  for (const int e : elements)
    for (int a = 0; a < mesh.nodes_per_element(); ++a)
      connectivity.push_back(node_at[std::size_t(mesh.element(e)[a])]);
  mesh.connectivity = std::move(connectivity);
  mesh.tissue = taken(mesh.tissue, elements);
  mesh.fibroglandular_fraction = taken(mesh.fibroglandular_fraction, elements);
  mesh.skin_thickness = kept_thickness(mesh, element_at);
  for (auto* faces : {&mesh.skin_faces, &mesh.pectoral_faces, &mesh.cut_faces})
    *faces = renumbered(*faces, element_at);
  mesh.tumour_node = renumbered(node_at, mesh.tumour_node);
  mesh.nipple_node = renumbered(node_at, mesh.nipple_node);
  restrict_landmarks(mesh, element_at);
  return mesh;
}

MeshShape PartIndices::restricted(MeshShape shape) const {
  const int count = shape.nodes();
  for (auto* field : {&shape.points, &shape.imaged, &shape.reference})
    *field = taken(*field, nodes);
  shape.contact_pressure = taken(shape.contact_pressure, nodes);
  for (auto* field : {&shape.pressure, &shape.det_F, &shape.scaled_jacobian})
    *field = taken(*field, elements);
  if (shape.contact) restrict_contact(*shape.contact, inverse(nodes, count));
  return shape;
}

HexMesh restricted(HexMesh mesh, const std::vector<int>& elements) {
  if (int(elements.size()) == mesh.elements()) return mesh;
  const PartIndices part{elements, nodes_used(mesh, elements)};
  HexTopology& topology = mesh;
  MeshShape& shape = mesh;
  topology = part.restricted(std::move(topology));
  shape = part.restricted(std::move(shape));
  mesh.cut_faces = cut_of(mesh);
  return mesh;
}

HexMesh restricted(HexMesh mesh, std::vector<int> (&elements)(const HexTopology&)) {
  const std::vector<int> chosen = elements(mesh);
  return restricted(std::move(mesh), chosen);
}

Eigen::VectorXd PartIndices::restricted(const Eigen::VectorXd& whole) const {
  Eigen::VectorXd own(3L * long(nodes.size()));
  for (std::size_t n = 0; n < nodes.size(); ++n)
    own.segment<3>(3L * long(n)) = whole.segment<3>(3L * nodes[n]);
  return own;
}

Eigen::VectorXd PartIndices::extended(const Eigen::VectorXd& own, int count) const {
  Eigen::VectorXd whole = Eigen::VectorXd::Zero(3L * count);
  for (std::size_t n = 0; n < nodes.size(); ++n)
    whole.segment<3>(3L * nodes[n]) = own.segment<3>(3L * long(n));
  return whole;
}

std::optional<PartIndices> indices_in(const HexMesh& mesh, const HexMesh& part) {
  if (mesh.order != part.order) return {};
  auto elements = places_of(numbers_or_all(part.element_numbers, part.elements()),
                            numbers_or_all(mesh.element_numbers, mesh.elements()));
  auto nodes = places_of(numbers_or_all(part.node_numbers, part.nodes()),
                         numbers_or_all(mesh.node_numbers, mesh.nodes()));
  if (!elements || !nodes) return {};
  for (int e = 0; e < part.elements(); ++e) {
    const int* there = mesh.element((*elements)[std::size_t(e)]);
    for (int a = 0; a < part.nodes_per_element(); ++a)
      if (there[a] != (*nodes)[std::size_t(part.element(e)[a])]) return {};
  }
  return PartIndices{std::move(*elements), std::move(*nodes)};
}

bool have_same_elements(const HexMesh& a, const HexMesh& b) {
  return a.elements() == b.elements() && a.nodes() == b.nodes() && indices_in(a, b).has_value();
}

}  // namespace breast
