// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/derivative_file.hpp"

#include <algorithm>
#include <limits>

#include "io/hdf5/hermite_group.hpp"
#include "io/hdf5/mesh_check.hpp"
#include "io/hdf5/mesh_columns.hpp"
#include "io/hdf5/records.hpp"
#include "io/hdf5/sets_group.hpp"
#include "io/hdf5/thorax_group.hpp"
#include "io/hdf5/vtkhdf.hpp"

namespace breast {

namespace {

constexpr std::uint8_t vtk_hexahedron = 12, vtk_triquadratic_hexahedron = 29;
const std::string point_data = "/VTKHDF/PointData/", cell_data = "/VTKHDF/CellData/";
const std::string reference = point_data + "reference",
                  from_stress_free = point_data + "displacement_from_stress_free",
                  from_scan = point_data + "displacement_from_scan";
const std::string wall_seconds = "/VTKHDF/FieldData/wall_seconds";
const std::string derivative = point_data + "derivative_", influence = cell_data + "influence_";
const std::string derivative_list = "/breast/derivatives/parameters",
                  influence_list = "/breast/derivatives/landmarks";

void put_grid(Document& document, const HexMesh& mesh) {
  const std::size_t n = std::size_t(mesh.nodes_per_element()),
                    elements = std::size_t(mesh.elements());
  Integers offsets(elements + 1);
  for (std::size_t e = 0; e <= elements; ++e) offsets[e] = std::int64_t(e * n);
  const Bytes types(elements, mesh.order == 1 ? vtk_hexahedron : vtk_triquadratic_hexahedron);
  put_unstructured_grid(document, mesh.points,
                        Integers(mesh.connectivity.begin(), mesh.connectivity.end()), offsets,
                        types);
}

void get_grid(Fields& fields, HexMesh& mesh) {
  check_unstructured_grid(fields);
  const Bytes types = fields.bytes("/VTKHDF/Types", {Fields::any});
  if (types[0] != vtk_hexahedron && types[0] != vtk_triquadratic_hexahedron) {
    throw fields.complain()("dataset /VTKHDF/Types[0] is ", int(types[0]), ", must be ",
                            int(vtk_hexahedron), " or ", int(vtk_triquadratic_hexahedron));
  }
  mesh.order = types[0] == vtk_hexahedron ? 1 : 2;
  const std::int64_t n = mesh.nodes_per_element();
  const Integers offsets = fields.integers("/VTKHDF/Offsets", {types.size() + 1});
  for (std::size_t e = 0; e < types.size(); ++e) {
    if (types[e] != types[0]) {
      throw fields.complain()("dataset /VTKHDF/Types[", e, "] is ", int(types[e]), ", must be ",
                              int(types[0]), " like the first");
    }
    if (offsets[e + 1] - offsets[e] != n) {
      throw fields.complain()("dataset /VTKHDF/Offsets gives element ", e, " ",
                              offsets[e + 1] - offsets[e], " nodes, must be ", n);
    }
  }
  mesh.points = fields.places("/VTKHDF/Points");
  const Integers ids = fields.integers("/VTKHDF/Connectivity", {Fields::any});
  mesh.connectivity.assign(ids.begin(), ids.end());
}

std::vector<Vec3> difference(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  std::vector<Vec3> difference(a.size());
  for (std::size_t i = 0; i < a.size(); ++i) difference[i] = a[i] - b[i];
  return difference;
}

// Displacements are there for viewing; one that contradicts its two shapes means an edited file.
void check_displacement(Fields& fields, const std::string& path, const std::vector<Vec3>& points,
                        const std::vector<Vec3>& from, const char* from_name) {
  constexpr double tolerance_mm = 1e-6;
  const auto displacement = fields.vectors(path, points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3 expected = points[i] - from[i];
    if (!((displacement[i] - expected).norm() <= tolerance_mm)) {
      throw fields.complain()("dataset ", path, "[", i, "] is ", displacement[i].transpose(),
                              ", must be Points - ", from_name, " = ", expected.transpose());
    }
  }
}

void put_displacements(Document& document, const HexMesh& mesh) {
  if (mesh.reference.empty()) return;
  document.datasets[from_stress_free] = array_of(difference(mesh.points, mesh.reference));
  document.datasets[from_scan] = array_of(difference(mesh.points, mesh.imaged));
}

void check_displacements(Fields& fields, const HexMesh& mesh) {
  if (fields.has(from_scan))
    check_displacement(fields, from_scan, mesh.points, mesh.imaged, "imaged");
  if (!fields.has(from_stress_free)) return;
  fields.require(reference, {mesh.points.size(), 3});
  check_displacement(fields, from_stress_free, mesh.points, mesh.reference, "reference");
}

// Where no voxels were averaged, elements are of one tissue each.
Floats fractions(const HexTopology& mesh) {
  Floats list;
  for (const Tissue t : mesh.tissue) list.push_back(t == Tissue::fibroglandular ? 1.0F : 0.0F);
  return list;
}

void put_geometry(Document& document, const HexMesh& mesh) {
  put_hermite(document, *mesh.geometry);
  if (!has_sheets(*mesh.geometry)) return;
  document.attributes["/breast/hermite@content_sha256"] = array_of(mesh.geometry->content_sha256);
}

void get_optional_groups(Fields& fields, HexMesh& mesh) {
  if (fields.has_group("/breast/hermite")) {
    mesh.geometry = get_hermite(fields);
    mesh.geometry->side = mesh.side;
    mesh.geometry->content_sha256 = fields.text("/breast/hermite@content_sha256");
  } else if (has_thorax(fields)) {
    mesh.geometry.emplace().side = mesh.side;
    mesh.geometry->thorax = get_thorax(fields);
  }
  if (fields.has_group("/breast/model")) mesh.model = get_model(fields);
  if (fields.has_group("/breast/solve")) mesh.solve = get_solve(fields);
  if (fields.has_group("/breast/contact")) mesh.contact = get_contact(fields);
}

void check_needs(const HexMesh& mesh, const MeshNeeds& needs, const std::string& file) {
  if (needs.reference && mesh.reference.empty()) {
    throw input_error(file, ": has no stress-free shape (dataset ", reference,
                      "); make it with backward");
  }
  if (needs.geometry && !(mesh.geometry && has_sheets(*mesh.geometry))) {
    throw input_error(file,
                      ": has no Hermite sheets (group /breast/hermite); make it with hexmesh");
  }
  if (needs.contact && !mesh.contact) {
    throw input_error(file,
                      ": has no compression record (group /breast/contact); make it with compress");
  }
}

}  // namespace

HexMesh read_mesh(const std::filesystem::path& file, const MeshNeeds& needs) {
  Document document = load_document(file, "mesh/1", "hexmesh");
  const Complaint complain{ErrorKind::input, file.string(), "; make it again"};
  Fields fields(document, complain);
  HexMesh mesh;
  mesh.content_sha256 = content_sha256(document);
  const FileHeader header = get_header(fields);
  mesh.side = header.side;
  mesh.history = header.history;
  get_grid(fields, mesh);
  get_columns(fields, mesh);
  check_displacements(fields, mesh);
  mesh.wall_seconds = fields.doubles(wall_seconds, {1}).front();
  get_sets(fields, mesh);
  get_landmarks(fields, mesh);
  get_skin(fields, mesh);
  mesh.gravity = fields.vector("/breast@gravity");
  mesh.template_name = fields.text("/breast/template@name");
  const Integers size = fields.integer_list("/breast/template@size", 4);
  for (std::size_t i = 0; i < 4; ++i) {
    if (!(size[i] >= 0 && size[i] <= std::numeric_limits<int>::max())) {
      throw complain("attribute /breast/template@size[", i, "] is ", size[i],
                     ", must be 0 or more");
    }
    mesh.template_size[i] = int(size[i]);
  }
  get_optional_groups(fields, mesh);
  check_mesh(mesh, complain);
  check_node_sets(fields, mesh);
  check_needs(mesh, needs, file.string());
  return mesh;
}

namespace {

Document mesh_document(const std::filesystem::path& file, HexMesh mesh) {
  const Complaint complain{ErrorKind::failed, file.string(), ""};
  if (mesh.fibroglandular_fraction.empty()) mesh.fibroglandular_fraction = fractions(mesh);
  check_mesh(mesh, complain);
  if (mesh.geometry && mesh.geometry->side != mesh.side) {
    throw complain("mesh is of the ", side_name(mesh.side), " breast, but its geometry of the ",
                   side_name(mesh.geometry->side));
  }
  Document document;
  put_header(document, {"mesh/1", mesh.side, mesh.history});
  document.attributes["/breast@gravity"] = array_of(mesh.gravity);
  document.attributes["/breast/template@name"] = array_of(mesh.template_name);
  document.attributes["/breast/template@size"] =
      array_of(Integers(mesh.template_size.begin(), mesh.template_size.end()));
  put_grid(document, mesh);
  put_columns(document, mesh);
  put_displacements(document, mesh);
  document.datasets[wall_seconds] = array_of(Doubles{mesh.wall_seconds});
  put_sets(document, mesh);
  put_landmarks(document, mesh);
  put_skin(document, mesh);
  if (mesh.geometry) put_geometry(document, mesh);
  if (mesh.model) put_model(document, *mesh.model);
  if (mesh.solve) put_solve(document, *mesh.solve);
  if (mesh.contact) put_contact(document, *mesh.contact);
  return document;
}

// The names that the file lists; the datasets that begin with `prefix` must be theirs, so that none
// can be lost without notice. A file without derivatives has no list.
Texts listed(Fields& fields, const Document& document, const std::string& list,
             const std::string& prefix) {
  const Texts names = fields.has(list) ? fields.texts(list, {Fields::any}) : Texts{};
  for (const auto& [path, array] : document.datasets) {
    if (!path.starts_with(prefix)) continue;
    const std::string name = path.substr(prefix.size());
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw fields.complain()("dataset ", list, " does not name ", name, ", of which there is ",
                              path);
  }
  return names;
}

// The derivatives by their names, and the list of these names.
template <class Values>
void put_derivatives(Document& document, const std::map<std::string, Values>& derivatives,
                     const std::string& list, const std::string& prefix) {
  Texts names;
  for (const auto& [name, values] : derivatives) {
    names.push_back(name);
    document.datasets[prefix + name] = array_of(Values(values));
  }
  document.datasets[list] = array_of(std::move(names));
}

}  // namespace

void write_mesh(const std::filesystem::path& file, const HexMesh& mesh) {
  save_document(file, mesh_document(file, mesh));
}

void write_mesh(const std::filesystem::path& file, const HexMesh& mesh,
                const Derivatives& derivatives) {
  Document document = mesh_document(file, mesh);
  put_derivatives(document, derivatives.position, derivative_list, derivative);
  put_derivatives(document, derivatives.influence, influence_list, influence);
  save_document(file, document);
}

Derivatives read_derivatives(const std::filesystem::path& file, const HexMesh& mesh) {
  Document document = load_document(file, "mesh/1", "sensitivity");
  Fields fields(document, {ErrorKind::input, file.string(), "; make it again"});
  Derivatives out;
  for (const std::string& parameter : listed(fields, document, derivative_list, derivative)) {
    out.position[parameter] = fields.vectors(derivative + parameter, mesh.points.size());
  }
  for (const std::string& landmark : listed(fields, document, influence_list, influence)) {
    out.influence[landmark] = fields.doubles(influence + landmark, {std::size_t(mesh.elements())});
  }
  return out;
}

}  // namespace breast
