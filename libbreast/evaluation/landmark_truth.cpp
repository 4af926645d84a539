// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluation/landmark_truth.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mesh/locate.hpp"
#include "mesh/part.hpp"
#include "mesh/surroundings.hpp"

namespace breast {

namespace {

const TruePosition* position_in(const TrueLandmark& truth, const std::string& posture) {
  const auto found = truth.at.find(posture);
  return found == truth.at.end() ? nullptr : &found->second;
}

// A summary row over all landmarks: the column's largest or mean value.
std::vector<std::string> summary(const Table& table, const std::string& label, bool largest) {
  std::vector<std::string> row{label};
  for (std::size_t c = 1; c < table.columns.size(); ++c) {
    double sum = 0, most = 0;
    for (const auto& cells : table.rows) {
      const double value = std::stod(cells[c]);
      sum += value;
      most = std::max(most, value);
    }
    row.push_back(format_fixed(largest ? most : sum / double(table.rows.size()), 3));
  }
  return row;
}

}  // namespace

std::vector<TrueLandmark> true_landmarks(const Table& table, Side side, const std::string& name) {
  if (!table.closed) {
    throw input_error(
        name,
        ": does not end as a table of libbreast does (docs/file-formats.md); it is truncated or "
        "of another program: write it again (phantom --truth, truth-table)");
  }
  const auto side_of = [&](const std::string& text) {
    try {
      return side_from_name(text);
    } catch (const Error& error) {
      throw input_error(name, ": ", error.what());
    }
  };
  std::vector<std::string> postures{"prone"};
  for (const char* posture : {"stress_free", "supine"})
    if (table.has(posture + std::string("_x_mm"))) postures.push_back(posture);
  for (const View view : {View::cc, View::mlo, View::ml})
    if (table.has(view_column(view) + "_x_mm")) postures.push_back(view_column(view));
  std::vector<TrueLandmark> list;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (side_of(table.cell(row, "side")) != side) continue;
    TrueLandmark point{table.cell(row, "landmark"), {}};
    for (const std::string& posture : postures) {
      TruePosition& there = point.at[posture];
      there.x = table.point(row, posture + "_");
      const std::string column = posture + "_own_error_mm";
      if (table.has(column)) there.own_error = table.number(row, column);
    }
    list.push_back(std::move(point));
  }
  if (list.empty()) throw input_error(name, ": no landmark of the ", side_name(side), " side");
  return list;
}

std::string posture_of(const HexMesh& mesh) {
  if (mesh.contact) return view_column(mesh.contact->view);
  if (mesh.reference.empty()) return "prone";
  if (mesh.gravity.norm() == 0) return "stress_free";
  const Vec3 along = mesh.gravity.normalized();
  if (along.y() > 0.999) return "supine";
  return along.y() < -0.999 ? "prone" : "";
}

Table compare_with_truth(const std::vector<HexMesh>& meshes,
                         const std::vector<TrueLandmark>& truth) {
  Table table;
  table.columns = {"landmark", "outside_mm", "prone_error_mm"};
  std::vector<HexMesh> shown;
  for (const HexMesh& mesh : meshes) {
    if (!have_same_breast(mesh, meshes.front())) {
      throw input_error("the meshes differ in their elements; compare files of one chain");
    }
    const std::string posture = posture_of(mesh);
    const TruePosition* known = position_in(truth.front(), posture);
    if (posture == "prone" || known == nullptr) continue;
    shown.push_back(restricted(mesh, breast_elements));
    table.columns.push_back(posture + "_error_mm");
    table.columns.push_back(posture + "_true_mm");
    if (known->own_error) table.columns.push_back(posture + "_own_error_mm");
  }
  const HexMesh first = restricted(meshes.front(), breast_elements);
  const Locator imaged(first, first.imaged);
  for (const TrueLandmark& point : truth) {
    const Vec3& prone = point.at.at("prone").x;
    const Location found = imaged.nearest(prone);
    double prone_error = found.moved;
    if (const Landmark* own = first.landmark(point.name); own && point.name == "nipple") {
      prone_error = (landmark_position(first, first.imaged, *own) - prone).norm();
    }
    // Named differently from the tumour that a chain puts into its mesh.
    const std::string shown_as = point.name == "tumour" ? "true-tumour" : point.name;
    std::vector<std::string> row{shown_as, format_fixed(found.moved, 3),
                                 format_fixed(prone_error, 3)};
    for (const HexMesh& mesh : shown) {
      const TruePosition& there = *position_in(point, posture_of(mesh));
      const Vec3 here = element_position(mesh, mesh.points, found.element, found.local);
      row.push_back(format_fixed((here - there.x).norm(), 3));
      row.push_back(format_fixed((there.x - prone).norm(), 3));
      if (there.own_error) row.push_back(format_fixed(*there.own_error, 3));
    }
    table.rows.push_back(std::move(row));
  }
  const auto mean = summary(table, "mean", false), most = summary(table, "largest", true);
  table.rows.push_back(mean);
  table.rows.push_back(most);
  return table;
}

}  // namespace breast
