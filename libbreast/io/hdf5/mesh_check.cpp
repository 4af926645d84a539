// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5/mesh_check.hpp"

#include <algorithm>
#include <cmath>

#include "io/hdf5/hermite_group.hpp"
#include "io/hdf5/mesh_columns.hpp"

namespace breast {

namespace {

struct CheckedFaces {
  const char* path;
  const std::vector<Face>& faces;
};

// The order by which a number is searched.
void check_ascending(const std::vector<int>& numbers, const char* path, const Complaint& complain) {
  for (std::size_t i = 1; i < numbers.size(); ++i) {
    if (numbers[i] <= numbers[i - 1])
      throw complain("dataset ", path, "[", i, "] is ", numbers[i], ", must be at least ",
                     numbers[i - 1] + 1);
  }
}

// Numbers in a larger mesh: of elements and nodes, or of neither.
void check_numbers(const HexTopology& mesh, const Complaint& complain) {
  const char *of_elements = "/VTKHDF/CellData/element_number",
             *of_nodes = "/VTKHDF/PointData/node_number";
  if (mesh.element_numbers.empty() != mesh.node_numbers.empty())
    throw complain("dataset ", mesh.element_numbers.empty() ? of_elements : of_nodes,
                   " is missing, which a part of a mesh has");
  check_ascending(mesh.element_numbers, of_elements, complain);
  check_ascending(mesh.node_numbers, of_nodes, complain);
}

void check_connectivity(const HexMesh& mesh, const Complaint& complain) {
  const int n = mesh.nodes_per_element();
  if (mesh.connectivity.empty() || mesh.connectivity.size() % std::size_t(n) != 0) {
    throw complain("dataset /VTKHDF/Connectivity has ", mesh.connectivity.size(),
                   " entries, must be a positive multiple of ", n);
  }
  std::vector<char> used(mesh.points.size(), 0);
  std::vector<int> nodes;
  for (int e = 0; e < mesh.elements(); ++e) {
    nodes.assign(mesh.element(e), mesh.element(e) + n);
    std::sort(nodes.begin(), nodes.end());
    if (nodes.front() < 0 || nodes.back() >= mesh.nodes()) {
      throw complain("dataset /VTKHDF/Connectivity element ", e, " uses node ",
                     nodes.front() < 0 ? nodes.front() : nodes.back(), ", must be 0 to ",
                     mesh.nodes() - 1);
    }
    const auto twice = std::adjacent_find(nodes.begin(), nodes.end());
    if (twice != nodes.end()) {
      throw complain("dataset /VTKHDF/Connectivity element ", e, " uses node ", *twice, " twice");
    }
    for (const int node : nodes) used[std::size_t(node)] = 1;
  }
  const auto orphan = std::find(used.begin(), used.end(), 0);
  if (orphan != used.end()) {
    throw complain("dataset /VTKHDF/Points[", orphan - used.begin(), "] belongs to no element");
  }
}

// Every face of the boundary is in exactly one of the three sets, and nothing else is.
void check_face_sets(const HexTopology& mesh, const Complaint& complain) {
  const CheckedFaces sets[] = {{"/breast/sets/skin_faces", mesh.skin_faces},
                               {"/breast/sets/pectoral_faces", mesh.pectoral_faces},
                               {"/breast/sets/cut_faces", mesh.cut_faces}};
  std::vector<int> owner(std::size_t(mesh.elements()) * 6, -1);
  for (int s = 0; s < 3; ++s) {
    for (std::size_t i = 0; i < sets[s].faces.size(); ++i) {
      const Face face = sets[s].faces[i];
      if (!(face.element >= 0 && face.element < mesh.elements() && face.local >= 0 &&
            face.local < 6)) {
        throw complain("dataset ", sets[s].path, "[", i, "] is element ", face.element, " face ",
                       face.local, ", must be below ", mesh.elements(), " and 6");
      }
      int& mine = owner[std::size_t(face.element) * 6 + std::size_t(face.local)];
      if (mine >= 0) {
        throw complain("dataset ", sets[s].path, "[", i, "] (element ", face.element, " face ",
                       face.local, ") is already in ", sets[mine].path,
                       "; the sets must be disjoint");
      }
      mine = s;
    }
  }
  for (const Face& face : boundary_faces(mesh)) {
    int& mine = owner[std::size_t(face.element) * 6 + std::size_t(face.local)];
    if (mine < 0) {
      throw complain(
          "boundary face ", face.local, " of element ", face.element,
          " is in none of skin_faces, pectoral_faces, cut_faces; the sets must cover the "
          "boundary");
    }
    mine = -1;
  }
  const auto inner = std::find_if(owner.begin(), owner.end(), [](int s) { return s >= 0; });
  if (inner != owner.end()) {
    const long at = inner - owner.begin();
    throw complain("dataset ", sets[*inner].path, " holds face ", at % 6, " of element ", at / 6,
                   ", which is not on the boundary");
  }
}

void check_landmarks(const HexMesh& mesh, const Complaint& complain) {
  constexpr double slack = 1e-6;  // rounding of the search that placed them
  for (std::size_t i = 0; i < mesh.landmarks.size(); ++i) {
    const Landmark& landmark = mesh.landmarks[i];
    if (!(landmark.element >= 0 && landmark.element < mesh.elements())) {
      throw complain("dataset /breast/landmarks/element[", i, "] is ", landmark.element,
                     ", must be 0 to ", mesh.elements() - 1);
    }
    if (!(landmark.local.cwiseAbs().maxCoeff() <= 1 + slack)) {
      throw complain("dataset /breast/landmarks/local[", i, "] is ", landmark.local.transpose(),
                     ", must be -1 to 1");
    }
    if (!(landmark.moved >= 0)) {
      throw complain("dataset /breast/landmarks/moved[", i, "] is ", landmark.moved,
                     ", must be 0 or more");
    }
    for (std::size_t j = 0; j < i; ++j) {
      if (mesh.landmarks[j].name == landmark.name) {
        throw complain("dataset /breast/landmarks/name[", i, "] repeats '", landmark.name, "'");
      }
    }
  }
  for (const auto& [path, node] : {std::pair("/breast/sets/tumour", mesh.tumour_node),
                                   std::pair("/breast/sets/nipple", mesh.nipple_node)}) {
    if (!(node >= -1 && node < mesh.nodes())) {
      throw complain("dataset ", path, " is node ", node, ", must be 0 to ", mesh.nodes() - 1);
    }
  }
}

void check_skin(const HexTopology& mesh, const Complaint& complain) {
  const std::vector<double>& thickness = mesh.skin_thickness;
  if (mesh.skin_model == SkinModel::membrane && thickness.empty() && !mesh.skin_faces.empty())
    throw complain("dataset /breast/skin/thickness is missing, which a membrane skin needs");
  if (!thickness.empty() && thickness.size() != mesh.skin_faces.size())
    throw complain("dataset /breast/skin/thickness has ", thickness.size(), " entries, must be ",
                   mesh.skin_faces.size());
  for (std::size_t i = 0; i < thickness.size(); ++i) {
    if (!(thickness[i] >= 0))
      throw complain("dataset /breast/skin/thickness[", i, "] is ", thickness[i],
                     ", must be 0 or more");
  }
}

void check_model(const ModelText& model, const Complaint& complain) {
  for (const auto& [name, text] : model_parts)
    if ((model.*text).empty())
      throw complain("attribute /breast/model@", name,
                     " is empty, must state this part of the model");
}

void check_contact(const ContactRecord& contact, const Complaint& complain) {
  if (contact.path_force_N.size() != contact.path_thickness_mm.size()) {
    throw complain("group /breast/contact has a path of ", contact.path_thickness_mm.size(),
                   " thicknesses and ", contact.path_force_N.size(), " forces");
  }
  if (contact.path_detector_N.size() != contact.path_thickness_mm.size()) {
    throw complain("group /breast/contact has a path of ", contact.path_thickness_mm.size(),
                   " thicknesses and ", contact.path_detector_N.size(), " forces of the detector");
  }
  for (std::size_t p = 0; p < contact.plates.size(); ++p) {
    const PlateRecord& plate = contact.plates[p];
    for (const Vec3& axis : {plate.normal, plate.anterior}) {
      if (!(std::abs(axis.norm() - 1) < 1e-6)) {
        throw complain("dataset /breast/contact/plates entry ", p, " has an axis of length ",
                       axis.norm(), ", must be 1");
      }
    }
  }
}

}  // namespace

void check_mesh(const HexMesh& mesh, const Complaint& complain) {
  if (mesh.order != 1 && mesh.order != 2) {
    throw complain("mesh has order ", mesh.order, ", must be 1 or 2");
  }
  check_connectivity(mesh, complain);
  check_columns(mesh, complain);
  check_numbers(mesh, complain);
  check_face_sets(mesh, complain);
  check_landmarks(mesh, complain);
  check_skin(mesh, complain);
  if (mesh.geometry) check_geometry(*mesh.geometry, complain);
  if (mesh.model) check_model(*mesh.model, complain);
  if (mesh.solve && mesh.reference.empty()) {
    throw complain(
        "dataset /VTKHDF/PointData/reference is missing, which what was solved has "
        "(group /breast/solve)");
  }
  if (!mesh.contact) return;
  check_contact(*mesh.contact, complain);
  if (mesh.contact_pressure.empty()) {
    throw complain(
        "dataset /VTKHDF/PointData/contact_pressure is missing, which a compression has "
        "(group /breast/contact)");
  }
}

}  // namespace breast
