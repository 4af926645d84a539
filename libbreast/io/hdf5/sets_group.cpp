// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5/sets_group.hpp"

#include <array>

#include "mesh/cut_border.hpp"

namespace breast {

namespace {

struct NamedFaces {
  const char* name;
  std::vector<Face> HexMesh::*member;
};
const NamedFaces face_sets[] = {{"skin", &HexMesh::skin_faces},
                                {"pectoral", &HexMesh::pectoral_faces},
                                {"cut", &HexMesh::cut_faces}};
struct SingleNode {
  const char* name;
  int HexMesh::*member;
};
constexpr SingleNode single_nodes[] = {{"tumour", &HexMesh::tumour_node},
                                       {"nipple", &HexMesh::nipple_node}};
constexpr std::array<const char*, 3> skin_models = {"none", "membrane", "layer"};

std::string faces_path(const NamedFaces& set) {
  return std::string("/breast/sets/") + set.name + "_faces";
}
std::string nodes_path(const NamedFaces& set) {
  return std::string("/breast/sets/") + set.name + "_nodes";
}

}  // namespace

void put_sets(Document& document, const HexMesh& mesh) {
  for (const NamedFaces& set : face_sets) {
    const std::vector<Face>& faces = mesh.*set.member;
    Integers flat;
    for (const Face& face : faces) flat.insert(flat.end(), {face.element, face.local});
    document.datasets[faces_path(set)] = reshaped(array_of(std::move(flat)), {faces.size(), 2});
    const std::vector<int> nodes = nodes_of(mesh, faces);
    document.datasets[nodes_path(set)] = array_of(Integers(nodes.begin(), nodes.end()));
  }
  Bytes borders;
  for (const RimBorder border : cut_borders(mesh)) borders.push_back(std::uint8_t(border));
  if (!borders.empty()) document.datasets["/breast/sets/cut_border"] = array_of(std::move(borders));
  for (const auto& [name, member] : single_nodes) {
    const int node = mesh.*member;
    document.datasets[std::string("/breast/sets/") + name] =
        array_of(node < 0 ? Integers{} : Integers{node});
  }
}

void get_sets(Fields& fields, HexMesh& mesh) {
  for (const NamedFaces& set : face_sets) {
    // The larger bound of the two columns; check_mesh refuses a local face beyond 5.
    const auto flat =
        fields.indices(faces_path(set), {Fields::any, 2}, 0, std::max(mesh.elements(), 6));
    for (std::size_t i = 0; i + 1 < flat.size(); i += 2) {
      (mesh.*set.member).push_back({flat[i], flat[i + 1]});
    }
  }
  for (const auto& [name, member] : single_nodes) {
    const std::string path = std::string("/breast/sets/") + name;
    const std::vector<int> nodes = fields.indices(path, {Fields::any}, 0, mesh.nodes());
    if (nodes.size() > 1) {
      throw fields.complain()("dataset ", path, " has ", nodes.size(), " nodes, must be 0 or 1");
    }
    mesh.*member = nodes.empty() ? -1 : nodes.front();
  }
}

void check_node_sets(Fields& fields, const HexMesh& mesh) {
  for (const NamedFaces& set : face_sets) {
    const std::vector<int> nodes = fields.indices(nodes_path(set), {Fields::any}, 0, mesh.nodes());
    if (nodes != nodes_of(mesh, mesh.*set.member)) {
      throw fields.complain()("dataset ", nodes_path(set), " are not the sorted nodes of ",
                              faces_path(set));
    }
  }
}

void put_landmarks(Document& document, const HexMesh& mesh) {
  Texts names;
  std::vector<Vec3> imaged, local;
  Integers elements;
  Doubles moved;
  for (const Landmark& landmark : mesh.landmarks) {
    names.push_back(landmark.name);
    imaged.push_back(landmark.imaged);
    elements.push_back(landmark.element);
    local.push_back(landmark.local);
    moved.push_back(landmark.moved);
  }
  auto& sets = document.datasets;
  sets["/breast/landmarks/name"] = array_of(std::move(names));
  sets["/breast/landmarks/imaged"] = array_of(imaged);
  sets["/breast/landmarks/element"] = array_of(std::move(elements));
  sets["/breast/landmarks/local"] = array_of(local);
  sets["/breast/landmarks/moved"] = array_of(std::move(moved));
}

void get_landmarks(Fields& fields, HexMesh& mesh) {
  const Texts names = fields.texts("/breast/landmarks/name", {Fields::any});
  const auto imaged = fields.places("/breast/landmarks/imaged", names.size());
  const auto elements =
      fields.indices("/breast/landmarks/element", {names.size()}, 0, mesh.elements());
  const auto local = fields.vectors("/breast/landmarks/local", names.size());
  const Doubles moved = fields.doubles("/breast/landmarks/moved", {names.size()});
  for (std::size_t i = 0; i < names.size(); ++i) {
    fields.check_name("/breast/landmarks/name", i, names[i]);
    mesh.landmarks.push_back({names[i], imaged[i], elements[i], local[i], moved[i]});
  }
}

void put_skin(Document& document, const HexMesh& mesh) {
  document.attributes["/breast/skin@model"] =
      array_of(std::string(skin_models[std::size_t(mesh.skin_model)]));
  document.datasets["/breast/skin/thickness"] = array_of(Doubles(mesh.skin_thickness));
}

void get_skin(Fields& fields, HexMesh& mesh) {
  const std::string model = fields.text("/breast/skin@model");
  std::size_t code = 0;
  while (code < skin_models.size() && skin_models[code] != model) ++code;
  if (code == skin_models.size()) {
    throw fields.complain()("attribute /breast/skin@model is '", model,
                            "', must be 'none', 'membrane' or 'layer'");
  }
  mesh.skin_model = static_cast<SkinModel>(code);
  mesh.skin_thickness = fields.doubles("/breast/skin/thickness", {Fields::any});
}

}  // namespace breast
