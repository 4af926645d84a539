// SPDX-License-Identifier: GPL-3.0-or-later
// NRRD (teem.sourceforge.net/nrrd/format.html), attached or detached.
#include <fstream>
#include <map>
#include <sstream>

#include "core/error.hpp"
#include "core/text/lower_case.hpp"
#include "core/text/trimmed.hpp"
#include "io/volume/header.hpp"
#include "io/volume/inflate.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

struct NrrdHeader {
  std::map<std::string, std::string> fields;  ///< by lower-case name
  std::map<std::string, std::string> notes;   ///< "key:=value", of the program that wrote the file
  std::streamoff data_at = 0;                 ///< byte behind the header
  bool ended = false;                         ///< by an empty line

  std::string field(const std::string& name, const std::string& also = "") const {
    const auto found = fields.find(name);
    if (found != fields.end()) return found->second;
    const auto other = also.empty() ? fields.end() : fields.find(also);
    return other == fields.end() ? "" : other->second;
  }
};

NrrdHeader nrrd_header_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw input_error(file.string(), ": cannot be opened");
  constexpr std::size_t most_lines = 10000, longest = 65536, most_bytes = 1 << 24;
  NrrdHeader header;
  std::string line;
  if (!next_line(in, line, longest) || !line.starts_with("NRRD")) {
    throw input_error(file.string(), ": no NRRD header");
  }
  std::size_t bytes = 0;
  for (std::size_t n = 0; n < most_lines && next_line(in, line, longest); ++n) {
    if (line.size() > longest)
      throw input_error(file.string(), ": header line ", n + 2, " is endless");
    bytes += line.size();
    if (bytes > most_bytes)
      throw input_error(file.string(), ": a header of more than ", most_bytes, " bytes");
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) {
      header.ended = true;
      header.data_at = in.tellg();
      break;
    }
    const auto colon = line.find(": "), note = line.find(":=");
    if (line.starts_with('#')) continue;
    if (note < colon) header.notes[line.substr(0, note)] = line.substr(note + 2);
    if (colon == std::string::npos || note < colon) continue;
    const std::string name = lower_case(trimmed(line.substr(0, colon)));
    if (!header.fields.emplace(name, trimmed(line.substr(colon + 1))).second) {
      throw input_error(file.string(), ": header states '", name, "' twice");
    }
  }
  return header;
}

double bytes_of_nrrd_type(const std::string& type) {
  static const std::map<std::string, double> known = {{"signed char", 1},
                                                      {"int8", 1},
                                                      {"int8_t", 1},
                                                      {"uchar", 1},
                                                      {"unsigned char", 1},
                                                      {"uint8", 1},
                                                      {"uint8_t", 1},
                                                      {"short", 2},
                                                      {"short int", 2},
                                                      {"signed short", 2},
                                                      {"signed short int", 2},
                                                      {"int16", 2},
                                                      {"int16_t", 2},
                                                      {"ushort", 2},
                                                      {"unsigned short", 2},
                                                      {"unsigned short int", 2},
                                                      {"uint16", 2},
                                                      {"uint16_t", 2},
                                                      {"int", 4},
                                                      {"signed int", 4},
                                                      {"int32", 4},
                                                      {"int32_t", 4},
                                                      {"uint", 4},
                                                      {"unsigned int", 4},
                                                      {"uint32", 4},
                                                      {"uint32_t", 4},
                                                      {"longlong", 8},
                                                      {"long long", 8},
                                                      {"long long int", 8},
                                                      {"signed long long", 8},
                                                      {"signed long long int", 8},
                                                      {"int64", 8},
                                                      {"int64_t", 8},
                                                      {"ulonglong", 8},
                                                      {"unsigned long long", 8},
                                                      {"unsigned long long int", 8},
                                                      {"uint64", 8},
                                                      {"uint64_t", 8},
                                                      {"float", 4},
                                                      {"double", 8}};
  const auto found = known.find(lower_case(type));
  return found == known.end() ? 0 : found->second;
}

// "(1,0,0) none (0,1,0) (0,0,1)": the vectors, without axes that are not of space.
std::vector<Vec3> vectors_of(const fs::path& file, const std::string& text) {
  std::istringstream words(text);
  std::vector<Vec3> vectors;
  std::string vector;
  for (std::string word; words >> word;) {
    vector += word;
    if (vector == "none") {
      vector.clear();
    } else if (vector.ends_with(')')) {
      const std::vector<double> numbers = header_numbers(vector);
      if (numbers.size() != 3) {
        throw input_error(file.string(), ": space directions has '", vector,
                          "', must be three finite numbers");
      }
      vectors.emplace_back(numbers[0], numbers[1], numbers[2]);
      vector.clear();
    }
  }
  return vectors;
}

void check_orientation(const fs::path& file, const NrrdHeader& header) {
  const std::string space = lower_case(header.field("space"));
  if (space.empty()) {
    throw input_error(file.string(),
                      ": states no space, so left and right are unknown: save it with its "
                      "orientation (space: left-posterior-superior)");
  }
  const bool known = space == "left-posterior-superior" || space == "lps" ||
                     space == "right-anterior-superior" || space == "ras";
  if (!known) {
    throw input_error(file.string(), ": space '", space,
                      "': left-posterior-superior or right-anterior-superior are read");
  }
  const std::string units = header.field("space units");
  std::istringstream words(units);
  for (std::string unit; words >> unit;) {
    if (unit != "\"mm\"") throw input_error(file.string(), ": space units ", units, ": must be mm");
  }
  const std::vector<Vec3> axes = vectors_of(file, header.field("space directions"));
  if (axes.size() != 3) {
    throw input_error(file.string(), ": ", axes.size(),
                      " space directions: voxel size and orientation need three");
  }
  Grid grid;
  Mat3 matrix;
  for (int d = 0; d < 3; ++d) matrix.col(d) = axes[std::size_t(d)];
  set_axes(grid, matrix);
  const std::string place = header.field("space origin");
  const std::vector<double> origin = header_numbers(place);
  if (!place.empty() && origin.size() != 3) {
    throw input_error(file.string(), ": space origin '", place, "' is not three finite numbers");
  }
  if (!place.empty()) grid.origin = Vec3(origin[0], origin[1], origin[2]);
  check_scan_grid(file.string(), grid);
}

double announced_bytes(const fs::path& file, const NrrdHeader& header) {
  const std::vector<double> sizes = header_numbers(header.field("sizes"));
  double voxels = sizes.empty() ? 0 : 1;
  for (const double size : sizes) voxels *= size >= 1 ? size : 0;
  check_voxel_count(file.string(), voxels);
  const double bytes = bytes_of_nrrd_type(header.field("type"));
  if (bytes == 0) {
    throw input_error(file.string(), ": type '", header.field("type"),
                      "': grey values of 8 to 64 bits are read");
  }
  return voxels * bytes;
}

void check_data(const fs::path& file, const NrrdHeader& header, double needed) {
  const std::string encoding = lower_case(header.field("encoding"));
  const bool gzip = encoding == "gzip" || encoding == "gz";
  const bool text = encoding == "text" || encoding == "txt" || encoding == "ascii";
  if (!gzip && !text && encoding != "raw") {
    throw input_error(file.string(), ": encoding '", encoding, "': raw, gzip and text are read");
  }
  const std::string detached = header.field("data file", "datafile");
  if (detached.starts_with("LIST") || detached.find('%') != std::string::npos) {
    throw input_error(file.string(), ": voxels in several files: save them in one");
  }
  if (detached.empty() && !header.ended) {
    throw input_error(file.string(), ": truncated: its header does not end");
  }
  const fs::path data = detached.empty() ? file : detached_data(file, detached);
  const std::streamoff start = detached.empty() ? header.data_at : 0;
  constexpr double text_bytes = 32;  // of one number, at most
  const Content content = content_from(data, start, needed * (text ? text_bytes : 1) + slack_bytes);
  const bool skips = header.fields.contains("line skip") || header.fields.contains("lineskip");
  if (gzip && !content.compressed && !skips) {
    throw input_error(file.string(), ": its voxels are not the gzip data its header announces");
  }
  if (!text && content.bytes < needed) {
    throw input_error(file.string(), ": truncated: voxel data of ", content.bytes,
                      " bytes, the header announces ", needed);
  }
}

}  // namespace

NrrdNotes nrrd_notes(const fs::path& file) {
  const NrrdHeader header = nrrd_header_of(file);
  const std::vector<double> dimension = header_numbers(header.field("dimension"));
  constexpr double most_axes = 16;  // of the format; another number is left to check_nrrd
  const bool known = dimension.size() == 1 && dimension[0] >= 1 && dimension[0] <= most_axes;
  return {known ? int(dimension[0]) : 0, header.notes};
}

void check_nrrd(const fs::path& file) {
  const NrrdHeader header = nrrd_header_of(file);
  const double needed = announced_bytes(file, header);
  check_orientation(file, header);
  check_data(file, header, needed);
}

}  // namespace breast
