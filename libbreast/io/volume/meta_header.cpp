// SPDX-License-Identifier: GPL-3.0-or-later
// MetaImage (.mha, .mhd).
#include <fstream>
#include <initializer_list>
#include <map>
#include <sstream>

#include "core/error.hpp"
#include "io/volume/header.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

struct MetaHeader {
  std::map<std::string, std::string> fields;
  double data_at = 0;  ///< byte behind the header
  bool ended = false;  ///< by the line that names the voxels' file

  /// The first of several names for one thing.
  std::string field(std::initializer_list<const char*> names) const {
    for (const char* name : names) {
      const auto found = fields.find(name);
      if (found != fields.end()) return found->second;
    }
    return "";
  }
};

MetaHeader meta_header_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw input_error(file.string(), ": cannot be opened");
  constexpr int most_lines = 1000;
  constexpr std::size_t longest = 4096;
  MetaHeader header;
  std::string line;
  for (int n = 0; n < most_lines && next_line(in, line, longest); ++n) {
    if (line.ends_with('\r')) line.pop_back();
    const auto equals = line.find('=');
    if (equals == std::string::npos || equals == 0 || line.size() > longest) break;
    const std::string key = line.substr(0, line.find_last_not_of(" \t", equals - 1) + 1);
    const auto value = line.find_first_not_of(" \t", equals + 1);
    const auto last = line.find_last_not_of(" \t");
    const std::string text = value == std::string::npos ? "" : line.substr(value, last + 1 - value);
    // Another reader may take the other one.
    if (!header.fields.emplace(key, text).second && header.fields[key] != text) {
      throw input_error(file.string(), ": states ", key, " twice");
    }
    if (key == "ElementDataFile") {
      header.ended = true;
      header.data_at = double(in.tellg());
      return header;
    }
  }
  throw input_error(file.string(), ": no complete MetaImage header");
}

double bytes_of_meta_type(const std::string& type) {
  static const std::map<std::string, double> known = {
      {"MET_CHAR", 1},      {"MET_UCHAR", 1},      {"MET_SHORT", 2}, {"MET_USHORT", 2},
      {"MET_INT", 4},       {"MET_UINT", 4},       {"MET_LONG", 4},  {"MET_ULONG", 4},
      {"MET_LONG_LONG", 8}, {"MET_ULONG_LONG", 8}, {"MET_FLOAT", 4}, {"MET_DOUBLE", 8}};
  const auto found = known.find(type);
  return found == known.end() ? 0 : found->second;
}

void check_orientation(const fs::path& file, const MetaHeader& header) {
  const std::string units = header.field({"DistanceUnits"});
  if (!units.empty() && units != "mm" && units != "?") {
    throw input_error(file.string(), ": DistanceUnits ", units, ": must be mm");
  }
  const auto spacing = header_numbers(header.field({"ElementSpacing", "ElementSize"}));
  if (spacing.size() < 3) {
    throw input_error(file.string(), ": states no voxel size (ElementSpacing)");
  }
  const auto matrix = header_numbers(header.field({"TransformMatrix", "Orientation", "Rotation"}));
  if (matrix.size() != 9) {
    throw input_error(file.string(),
                      ": states no orientation (TransformMatrix of nine finite numbers), so left "
                      "and right are unknown");
  }
  Grid grid;
  for (int d = 0; d < 3; ++d) {
    grid.spacing[d] = spacing[std::size_t(d)];
    for (int e = 0; e < 3; ++e) grid.direction(e, d) = matrix[std::size_t(3 * d + e)];
  }
  const std::string place = header.field({"Offset", "Position", "Origin"});
  const auto origin = header_numbers(place);
  if (!place.empty() && origin.size() != 3) {
    throw input_error(file.string(), ": Offset '", place, "' is not three finite numbers");
  }
  if (!place.empty()) grid.origin = Vec3(origin[0], origin[1], origin[2]);
  check_scan_grid(file.string(), grid);
}

}  // namespace

void check_meta(const fs::path& file) {
  const MetaHeader header = meta_header_of(file);
  const std::vector<double> sizes = header_numbers(header.field({"DimSize"}));
  // MetaIO makes loops of this number, whatever it is.
  const std::string dimensions = header.field({"NDims"});
  if (dimensions != "3" || sizes.size() != 3) {
    throw input_error(file.string(), ": NDims ", dimensions, " and ", sizes.size(),
                      " sizes (DimSize): a volume has three");
  }
  double voxels = sizes.empty() ? 0 : 1;
  for (const double size : sizes) voxels *= size >= 1 ? size : 0;
  check_voxel_count(file.string(), voxels);
  const std::string type = header.field({"ElementType"});
  const double element = bytes_of_meta_type(type);
  if (element == 0) {
    throw input_error(file.string(), ": element type '", type,
                      "': grey values of 8 to 64 bits are read");
  }
  check_orientation(file, header);
  const std::string name = header.field({"ElementDataFile"});
  if (name.starts_with("LIST") || name.find('%') != std::string::npos) {
    throw input_error(file.string(), ": voxels in several files: save them in one");
  }
  const bool local = name == "LOCAL" || name == "Local" || name == "local";
  const fs::path data = local ? file : detached_data(file, name);
  const double have = double(fs::file_size(data)) - (local ? header.data_at : 0.0);
  const std::string compressed = header.field({"CompressedDataSize"});
  const std::vector<double> stated = header_numbers(compressed);
  const double needed = stated.size() == 1 ? stated.front() : voxels * element;
  if (!(needed >= 0 && have >= needed)) {
    throw input_error(file.string(), ": truncated: voxel data of ", have,
                      " bytes, the header announces ", needed);
  }
}

}  // namespace breast
