// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/volume/header.hpp"

#include <algorithm>
#include <cmath>
#include <istream>
#include <map>
#include <sstream>

#include "core/error.hpp"

namespace breast {

namespace fs = std::filesystem;

std::optional<double> unit_mm(const std::string& symbol) {
  static const std::map<std::string, double> known = {
      {"m", 1e3}, {"cm", 10}, {"mm", 1}, {"um", 1e-3}};
  const auto found = known.find(symbol);
  return found == known.end() ? std::nullopt : std::optional(found->second);
}

void check_voxel_bytes(const std::string& name, double found, double announced) {
  if (found < announced) {
    throw input_error(name, ": truncated: voxel data of ", found, " bytes, the header announces ",
                      announced);
  }
  if (found > announced) {
    const std::string size =
        std::isfinite(found) ? message(found) : message("more than ", announced);
    throw input_error(name, ": voxel data of ", size, " bytes, but the header announces ",
                      announced,
                      ": its sizes, type or start of the voxels are wrong; save the volume again");
  }
}

bool next_line(std::istream& in, std::string& line, std::size_t longest) {
  constexpr int end = std::istream::traits_type::eof();
  line.clear();
  for (int c = 0; line.size() <= longest && (c = in.get()) != end;) {
    if (c == '\n') return true;
    line.push_back(char(c));
  }
  return !line.empty();
}

void set_axes(Grid& grid, const Mat3& axes) {
  for (int d = 0; d < 3; ++d) {
    grid.spacing[d] = axes.col(d).norm();
    grid.direction.col(d) = axes.col(d) / grid.spacing[d];
  }
}

void check_scan_grid(const std::string& name, const Grid& grid) {
  constexpr double least_mm = 0.01, most_mm = 50, farthest_mm = 1e5, orthonormal = 1e-3;
  for (int d = 0; d < 3; ++d) {
    if (!(grid.spacing[d] >= least_mm && grid.spacing[d] <= most_mm)) {
      throw input_error(name, ": voxel size ", grid.spacing[d], " mm along axis ", d, ": must be ",
                        least_mm, " to ", most_mm, " mm");
    }
    if (!(std::abs(grid.origin[d]) <= farthest_mm)) {
      throw input_error(name, ": origin ", grid.origin[d], " mm: must be within ", farthest_mm,
                        " mm");
    }
  }
  const double error =
      (grid.direction.transpose() * grid.direction - Mat3::Identity()).cwiseAbs().maxCoeff();
  if (!(error <= orthonormal)) {
    throw input_error(name, ": axis directions are not orthonormal (off by ", error,
                      ", must be at most ", orthonormal, "): resample the scan without shear");
  }
}

fs::path detached_data(const fs::path& header, const std::string& name) {
  const fs::path given(name);
  const bool climbs = std::find(given.begin(), given.end(), "..") != given.end();
  if (name.empty() || given.is_absolute() || climbs) {
    throw input_error(header.string(), ": names '", name,
                      "' for its voxels: must be a file in its own folder");
  }
  const fs::path data = header.parent_path() / given;
  std::error_code reason;
  if (!fs::is_regular_file(data, reason)) {
    throw input_error(header.string(), ": its voxels should be in ", name,
                      ", which does not exist");
  }
  return data;
}

void check_volume_sizes(const std::string& name, const std::vector<double>& sizes) {
  for (std::size_t d = 0; d < sizes.size(); ++d) {
    if (sizes[d] >= 1 && (d < 3 || sizes[d] == 1)) continue;
    throw input_error(name, ": size ", sizes[d], " along axis ", d,
                      ": one 3-D volume is needed; save one of them alone");
  }
  if (sizes.size() < 3) {
    throw input_error(name, ": ", sizes.size(), "-D image: a 3-D volume is needed");
  }
}

void check_voxel_count(const std::string& name, double voxels) {
  if (voxels >= 1 && voxels <= most_voxels) return;
  throw input_error(name, ": ", voxels, " voxels, must be 1 to ", most_voxels, ": crop the scan");
}

std::vector<double> header_numbers(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '(' || c == ')' || c == ','; }, ' ');
  std::istringstream words(text);
  std::vector<double> values;
  for (std::string word; words >> word;) {
    char* end = nullptr;
    values.push_back(std::strtod(word.c_str(), &end));
    if (*end != '\0' || !std::isfinite(values.back())) return {};
  }
  return values;
}

}  // namespace breast
