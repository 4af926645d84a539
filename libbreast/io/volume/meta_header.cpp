// SPDX-License-Identifier: GPL-3.0-or-later
// MetaImage (.mha, .mhd).
#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <map>
#include <sstream>

#include "core/error.hpp"
#include "core/text/lower_case.hpp"
#include "io/volume/header.hpp"
#include "io/volume/inflate.hpp"

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

Grid stated_grid(const fs::path& file, const MetaHeader& header) {
  const std::string units = header.field({"DistanceUnits"});
  const bool unknown = units.empty() || units == "?";  // counts as mm, as every program takes it
  const std::optional<double> mm = unknown ? 1.0 : unit_mm(units);
  if (!mm) throw input_error(file.string(), ": DistanceUnits ", units, ": must be mm, m, cm or um");
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
    grid.spacing[d] = *mm * spacing[std::size_t(d)];
    for (int e = 0; e < 3; ++e) grid.direction(e, d) = matrix[std::size_t(3 * d + e)];
  }
  const std::string place = header.field({"Offset", "Position", "Origin"});
  if (place.empty()) {
    throw input_error(file.string(),
                      ": states no Offset, so where the scan lies is unknown: save it with its "
                      "origin (Offset = x y z)");
  }
  const auto origin = header_numbers(place);
  if (origin.size() != 3) {
    throw input_error(file.string(), ": Offset '", place, "' is not three finite numbers");
  }
  grid.origin = *mm * Vec3(origin[0], origin[1], origin[2]);
  check_scan_grid(file.string(), grid);
  return grid;
}

/// As MetaIO reads it: True, true, T or 1.
bool is_true(const std::string& text) {
  return text.starts_with('T') || text.starts_with('t') || text.starts_with('1');
}

/// Refuses voxels that are cut off, or more than the header announces, as stored and as unpacked.
void check_data(const fs::path& file, const MetaHeader& header, double needed) {
  const std::string name = header.field({"ElementDataFile"});
  if (name.starts_with("LIST") || name.find('%') != std::string::npos) {
    throw input_error(file.string(), ": voxels in several files: save them in one");
  }
  if (const std::string binary = header.field({"BinaryData"});
      !binary.empty() && !is_true(binary)) {
    throw input_error(file.string(),
                      ": keeps its voxels as text, which is not read: save it as binary data");
  }
  const bool local = lower_case(name) == "local";
  const fs::path data = local ? file : detached_data(file, name);
  // Bytes before the voxels of another file; -1: the voxels end the file.
  const auto stated_skip = header_numbers(header.field({"HeaderSize"}));
  const double skip = stated_skip.size() == 1 ? stated_skip.front() : 0;
  const double start = (local ? header.data_at : 0.0) + std::max(skip, 0.0);
  const double stored = double(fs::file_size(data)) - start;
  if (!is_true(header.field({"CompressedData"}))) {
    check_voxel_bytes(file.string(), skip < 0 ? std::min(stored, needed) : stored, needed);
    return;
  }
  const auto packed = header_numbers(header.field({"CompressedDataSize"}));
  if (packed.size() == 1 && packed.front() > 0) {
    check_voxel_bytes(file.string(), stored, packed.front());
  }
  const Content content = inflated_content(data, std::streamoff(start), needed);
  if (content.packing == Packing::none) {
    throw input_error(file.string(),
                      ": its voxels are not the compressed data its header announces");
  }
  if (local && packed.size() != 1) {  // MetaIO would look for them at the begin of the file
    throw input_error(file.string(),
                      ": states no CompressedDataSize, without which compressed voxels "
                      "behind the header are not found: save the volume again");
  }
  check_voxel_bytes(file.string(), content.bytes, needed);
}

}  // namespace

Grid meta_grid(const fs::path& file) {
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
  const Grid grid = stated_grid(file, header);
  const auto channels = header_numbers(header.field({"ElementNumberOfChannels"}));
  check_data(file, header, voxels * element * (channels.size() == 1 ? channels.front() : 1));
  return grid;
}

}  // namespace breast
