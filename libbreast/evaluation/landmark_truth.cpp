#include "evaluation/landmark_truth.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "mesh/locate.hpp"

namespace breast {

namespace {

Vec3 position_in(const TrueLandmark& truth, const std::string& posture) {
  return posture == "supine" ? truth.supine
                             : (posture == "stress_free" ? truth.stress_free : truth.prone);
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
  const auto column_of = [&](const std::string& column) {
    try {
      return table.column(column);
    } catch (const Error& error) {
      throw input_error(name, ": ", error.what());
    }
  };
  const int landmark = column_of("landmark"), of_side = column_of("side");
  const auto side_of = [&](const std::string& text) {
    try {
      return side_from_name(text);
    } catch (const Error& error) {
      throw input_error(name, ": ", error.what());
    }
  };
  const auto vector = [&](const std::vector<std::string>& row, const std::string& posture) {
    Vec3 x;
    for (int d = 0; d < 3; ++d) {
      const std::string column = posture + std::array{"_x_mm", "_y_mm", "_z_mm"}[d];
      x[d] = parse_number(row[column_of(column)], name + ": " + column);
    }
    return x;
  };
  std::vector<TrueLandmark> list;
  for (const auto& row : table.rows) {
    if (side_of(row[of_side]) != side) continue;
    list.push_back(
        {row[landmark], vector(row, "stress_free"), vector(row, "prone"), vector(row, "supine")});
  }
  if (list.empty()) throw input_error(name, ": no landmark of the ", side_name(side), " side");
  return list;
}

std::string posture_of(const HexMesh& mesh) {
  if (mesh.contact) return "";
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
  std::vector<const HexMesh*> shown;
  for (const HexMesh& mesh : meshes) {
    if (mesh.connectivity != meshes.front().connectivity) {
      throw input_error("the meshes differ in their elements; compare files of one chain");
    }
    const std::string posture = posture_of(mesh);
    if (posture != "stress_free" && posture != "supine") continue;
    shown.push_back(&mesh);
    table.columns.push_back(posture + "_error_mm");
    table.columns.push_back(posture + "_true_mm");
  }
  const HexMesh& first = meshes.front();
  const Locator imaged(first, first.imaged);
  for (const TrueLandmark& point : truth) {
    const Location found = imaged.nearest(point.prone);
    double prone_error = found.moved;
    if (const Landmark* own = first.landmark(point.name); own && point.name == "nipple") {
      prone_error = (landmark_position(first, first.imaged, *own) - point.prone).norm();
    }
    // Not to be taken for the tumour a chain puts into its mesh.
    const std::string shown_as = point.name == "tumour" ? "true-tumour" : point.name;
    std::vector<std::string> row{shown_as, format_fixed(found.moved, 3),
                                 format_fixed(prone_error, 3)};
    for (const HexMesh* mesh : shown) {
      const Vec3 there = position_in(point, posture_of(*mesh));
      const Vec3 here = element_position(*mesh, mesh->points, found.element, found.local);
      row.push_back(format_fixed((here - there).norm(), 3));
      row.push_back(format_fixed((there - point.prone).norm(), 3));
    }
    table.rows.push_back(std::move(row));
  }
  const auto mean = summary(table, "mean", false), most = summary(table, "largest", true);
  table.rows.push_back(mean);
  table.rows.push_back(most);
  return table;
}

}  // namespace breast
