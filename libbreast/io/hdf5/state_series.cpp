// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/state_series.hpp"

#include <cmath>
#include <cstdio>
#include <regex>

#include "core/error.hpp"
#include "core/own_file.hpp"
#include "io/mesh_file.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

constexpr const char* table_name = "states.tsv";
constexpr const char* series_name = "states.vtkhdf.series";

/// The first file in the folder that is not of a series of ours; empty if there is none. The series
/// itself has no place for a maker's name.
fs::path foreign_file(const fs::path& folder) {
  static const std::regex state("state_[0-9]+\\.vtkhdf");
  std::error_code absent;
  for (const auto& entry : fs::directory_iterator(folder, absent)) {
    const std::string name = entry.path().filename().string();
    const bool ours =
        name == series_name ||
        ((name == table_name || std::regex_match(name, state)) && written_by_us(entry.path()));
    if (!ours || !entry.is_regular_file()) return entry.path();
  }
  return {};
}

}  // namespace

fs::path series_folder(const fs::path& output) {
  return output.parent_path() / (output.stem().string() + "-states");
}

void check_series_folder(const fs::path& folder) {
  std::error_code ignored;
  const fs::file_status status = fs::status(folder, ignored);
  if (fs::exists(status) && !fs::is_directory(status))
    throw input_error(folder.string(), ": is a file, and the states need a folder of this name");
  const fs::path foreign = foreign_file(folder);
  if (!foreign.empty())
    throw input_error(folder.string(), ": holds ", foreign.filename().string(),
                      ", which is not a state of libbreast and is not replaced: move it away, or "
                      "choose another name for the output");
}

void remove_series(const fs::path& folder) {
  std::error_code ignored;
  if (fs::is_directory(folder, ignored) && foreign_file(folder).empty())
    fs::remove_all(folder, ignored);
}

StateSeries::StateSeries(const fs::path& folder, std::vector<Landmark> landmarks)
    : folder_((check_series_folder(folder), folder)),
      files_(folder, table_name),
      landmarks_(std::move(landmarks)) {}

void StateSeries::add(const SeriesRow& row, const HexMesh* mesh) {
  if (table_.columns.empty()) {
    table_.columns = {"state", "file"};
    for (const auto& [name, value] : row.quantities) table_.columns.push_back(name);
    for (const char* name : {"status", "residual", "iterations"}) table_.columns.push_back(name);
    for (const Landmark& landmark : landmarks_)
      for (const char* axis : {"_x_mm", "_y_mm", "_z_mm"})
        table_.columns.push_back(landmark.name + axis);
    table_.columns.push_back("reason");
  }
  const std::size_t number = table_.rows.size() + 1;
  char name[32];
  std::snprintf(name, sizeof name, "state_%03zu.vtkhdf", number);
  std::vector<std::string> cells{std::to_string(number), mesh ? name : std::string(empty_cell)};
  for (const auto& [quantity, value] : row.quantities)
    cells.push_back(std::isfinite(value) ? format_number(value) : std::string(empty_cell));
  cells.insert(cells.end(), {status_name(row.status), format_number(row.residual),
                             std::to_string(row.iterations)});
  for (const Landmark& landmark : landmarks_) {
    const Vec3 at = mesh ? landmark_position(*mesh, mesh->points, landmark) : Vec3::Zero();
    for (int c = 0; c < 3; ++c)
      cells.push_back(mesh ? format_number(at[c]) : std::string(empty_cell));
  }
  cells.push_back(row.reason.empty() ? std::string(empty_cell) : row.reason);
  table_.rows.push_back(std::move(cells));
  if (mesh == nullptr) return;
  write_mesh(files_.temporary() / name, *mesh);
  files_and_times_ += message(files_and_times_.empty() ? "" : ",\n", "    {\"name\": \"", name,
                              "\", \"time\": ", format_number(row.quantities.front().second), "}");
}

void StateSeries::commit() {
  write_text(files_.temporary() / series_name,
             message("{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n", files_and_times_,
                     "\n  ]\n}\n"));
  write_table(files_.temporary() / table_name, table_);
  check_series_folder(folder_);  // again: minutes may have passed
  files_.replace();
}

}  // namespace breast
