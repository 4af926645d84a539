// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/hdf5/mesh_columns.hpp"

#include <limits>
#include <optional>

namespace breast {

namespace {

enum class Per { node, element };
enum class Presence { always, may_be_absent };

struct Bounds {
  double least, most;
};

/// An array of the mesh as files hold it. Places have no bounds of their own: they lie within
/// Fields::farthest_mm.
template <class Value>
struct Column {
  const char* path;
  std::vector<Value> HexMesh::*values;
  Per per;
  Presence presence;
  std::optional<Bounds> bounds = {};
};

constexpr double largest_number = std::numeric_limits<int>::max();

/// Calls `visit` with the row of every array, in the order in which files are checked.
template <class Visit>
void for_each_column(const Visit& visit) {
  using enum Per;
  using enum Presence;
  visit(Column<Vec3>{"/VTKHDF/PointData/imaged", &HexMesh::imaged, node, always});
  visit(Column<Vec3>{"/VTKHDF/PointData/reference", &HexMesh::reference, node, may_be_absent});
  visit(Column<double>{"/VTKHDF/PointData/contact_pressure", &HexMesh::contact_pressure, node,
                       may_be_absent});
  visit(Column<int>{"/VTKHDF/PointData/node_number", &HexMesh::node_numbers, node, may_be_absent,
                    Bounds{0, largest_number}});
  visit(Column<int>{"/VTKHDF/CellData/element_number", &HexMesh::element_numbers, element,
                    may_be_absent, Bounds{0, largest_number}});
  visit(Column<Tissue>{"/VTKHDF/CellData/tissue", &HexMesh::tissue, element, always,
                       Bounds{0, n_tissues - 1}});
  visit(Column<float>{"/VTKHDF/CellData/fibroglandular_fraction", &HexMesh::fibroglandular_fraction,
                      element, always, Bounds{0, 1}});
  visit(Column<double>{"/VTKHDF/CellData/pressure", &HexMesh::pressure, element, may_be_absent});
  visit(Column<double>{"/VTKHDF/CellData/det_F", &HexMesh::det_F, element, may_be_absent});
  visit(Column<double>{"/VTKHDF/CellData/scaled_jacobian", &HexMesh::scaled_jacobian, element,
                       may_be_absent});
}

template <class Value>
std::size_t full_length(const HexMesh& mesh, const Column<Value>& column) {
  return column.per == Per::node ? mesh.points.size() : std::size_t(mesh.elements());
}

template <class Value>
Array stored(const std::vector<Value>& values) {
  if constexpr (std::is_same_v<Value, Tissue>) {
    Bytes codes;
    for (const Tissue tissue : values) codes.push_back(std::uint8_t(tissue));
    return array_of(std::move(codes));
  } else if constexpr (std::is_same_v<Value, int>) {
    return array_of(Integers(values.begin(), values.end()));
  } else {
    return array_of(std::vector<Value>(values));
  }
}

template <class Value>
std::vector<Value> fetched(Fields& fields, const std::string& path, std::size_t count) {
  if constexpr (std::is_same_v<Value, Vec3>) {
    return fields.places(path, count);
  } else if constexpr (std::is_same_v<Value, Tissue>) {
    std::vector<Tissue> list;
    for (const std::uint8_t code : fields.bytes(path, {count}))
      list.push_back(static_cast<Tissue>(code));
    return list;
  } else if constexpr (std::is_same_v<Value, int>) {
    return fields.indices(path, {count}, 0, std::numeric_limits<int>::max());
  } else if constexpr (std::is_same_v<Value, float>) {
    return fields.floats(path, {count});
  } else {
    return fields.doubles(path, {count});
  }
}

}  // namespace

void check_columns(const HexMesh& mesh, const Complaint& complain) {
  for_each_column([&]<class Value>(const Column<Value>& column) {
    const std::vector<Value>& values = mesh.*column.values;
    if (values.empty() && column.presence == Presence::may_be_absent) return;
    if (values.size() != full_length(mesh, column))
      throw complain("dataset ", column.path, " has ", values.size(), " entries, must be ",
                     full_length(mesh, column));
    if constexpr (!std::is_same_v<Value, Vec3>) {
      for (std::size_t i = 0; column.bounds && i < values.size(); ++i) {
        const auto [least, most] = *column.bounds;
        const double value = double(values[i]);
        if (value >= least && value <= most) continue;
        throw complain("dataset ", column.path, "[", i, "] is ", value, ", must be ", least, " to ",
                       most);
      }
    }
  });
}

void put_columns(Document& document, const HexMesh& mesh) {
  for_each_column([&]<class Value>(const Column<Value>& column) {
    if (!(mesh.*column.values).empty())
      document.datasets[column.path] = stored(mesh.*column.values);
  });
}

void get_columns(Fields& fields, HexMesh& mesh) {
  for_each_column([&]<class Value>(const Column<Value>& column) {
    if (column.presence == Presence::may_be_absent && !fields.has(column.path)) return;
    mesh.*column.values = fetched<Value>(fields, column.path, full_length(mesh, column));
  });
}

}  // namespace breast
