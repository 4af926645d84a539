// SPDX-License-Identifier: GPL-3.0-or-later
// NRRD (teem.sourceforge.net/nrrd/format.html), attached or detached.
#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <iterator>
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

/// mm of the unit that all three axes of space have; mm if none is stated, as the format's users take it.
double space_unit_mm(const fs::path& file, const std::string& units) {
  std::istringstream words(units);
  std::string first;
  words >> first;
  if (first.empty()) return 1;
  for (std::string unit = first; !unit.empty(); unit.clear(), words >> unit) {
    if (unit == first && first.size() > 2 && first.front() == '"' && first.back() == '"') continue;
    throw input_error(file.string(), ": space units ", units, ": one unit for all axes is read");
  }
  const auto mm = unit_mm(first.substr(1, first.size() - 2));
  if (!mm) {
    throw input_error(file.string(), ": space units ", units,
                      ": must be \"mm\", \"m\", \"cm\" or \"um\"");
  }
  return *mm;
}

Grid stated_grid(const fs::path& file, const NrrdHeader& header) {
  const std::string space = lower_case(header.field("space"));
  if (space.empty()) {
    throw input_error(file.string(),
                      ": states no space, so left and right are unknown: save it with its "
                      "orientation (space: left-posterior-superior)");
  }
  const bool ras = space == "right-anterior-superior" || space == "ras";
  const bool las = space == "left-anterior-superior" || space == "las";
  if (!ras && !las && space != "left-posterior-superior" && space != "lps") {
    throw input_error(file.string(), ": space '", space,
                      "': left-posterior-superior, right-anterior-superior or "
                      "left-anterior-superior are read");
  }
  const double mm = space_unit_mm(file, header.field("space units"));
  const Vec3 to_lps = mm * Vec3(ras ? -1 : 1, ras || las ? -1 : 1, 1);
  const std::vector<Vec3> axes = vectors_of(file, header.field("space directions"));
  if (axes.size() != 3) {
    throw input_error(file.string(), ": ", axes.size(),
                      " space directions: voxel size and orientation need three");
  }
  Grid grid;
  Mat3 matrix;
  for (int d = 0; d < 3; ++d) matrix.col(d) = axes[std::size_t(d)].cwiseProduct(to_lps);
  set_axes(grid, matrix);
  const std::string place = header.field("space origin");
  if (place.empty()) {
    throw input_error(file.string(),
                      ": states no space origin, so where the scan lies is unknown: save it with "
                      "its origin (space origin: (x,y,z))");
  }
  const std::vector<double> origin = header_numbers(place);
  if (origin.size() != 3) {
    throw input_error(file.string(), ": space origin '", place, "' is not three finite numbers");
  }
  grid.origin = Vec3(origin[0], origin[1], origin[2]).cwiseProduct(to_lps);
  check_scan_grid(file.string(), grid);
  return grid;
}

struct Announced {
  double voxels = 0, bytes_each = 0;
  double bytes() const { return voxels * bytes_each; }
};

Announced announced_by(const fs::path& file, const NrrdHeader& header) {
  const std::vector<double> sizes = header_numbers(header.field("sizes"));
  Announced announced{sizes.empty() ? 0.0 : 1.0, bytes_of_nrrd_type(header.field("type"))};
  for (const double size : sizes) announced.voxels *= size >= 1 ? size : 0;
  check_voxel_count(file.string(), announced.voxels);
  if (announced.bytes_each == 0) {
    throw input_error(file.string(), ": type '", header.field("type"),
                      "': grey values of 8 to 64 bits are read");
  }
  return announced;
}

/// Numbers separated by blanks or commas.
double numbers_in(const fs::path& data, std::streamoff start) {
  std::ifstream in(data, std::ios::binary);
  in.seekg(start);
  double count = 0;
  bool inside = false;
  for (std::istreambuf_iterator<char> at(in), end; at != end; ++at) {
    const bool between = *at == ',' || std::isspace(static_cast<unsigned char>(*at)) != 0;
    if (!between && !inside) ++count;
    inside = !between;
  }
  return count;
}

/// Bytes to skip before the voxels of a raw file; -1: the voxels end the file.
double skipped_bytes(const fs::path& file, const NrrdHeader& header, bool raw) {
  const auto stated = [&](const char* name, const char* also) {
    const std::string text = header.field(name, also);
    const std::vector<double> number = header_numbers(text.empty() ? "0" : text);
    if (number.size() == 1 && number[0] >= -1 && number[0] == std::floor(number[0]))
      return number[0];
    throw input_error(file.string(), ": ", name, " '", text, "' is not a number of them");
  };
  const double bytes = stated("byte skip", "byteskip");
  if (stated("line skip", "lineskip") != 0 || (bytes != 0 && !raw)) {
    throw input_error(file.string(),
                      ": lines, or bytes of voxels that are not raw, are to be skipped, which is "
                      "not read: save the volume again");
  }
  return bytes;
}

void check_data(const fs::path& file, const NrrdHeader& header, const Announced& announced) {
  const std::string encoding = lower_case(header.field("encoding"));
  const bool gzip = encoding == "gzip" || encoding == "gz";
  const bool text = encoding == "text" || encoding == "txt" || encoding == "ascii";
  if (!gzip && !text && encoding != "raw") {
    throw input_error(file.string(), ": encoding '", encoding, "': raw, gzip and text are read");
  }
  if (!text && announced.bytes_each > 1 && header.field("endian").empty()) {
    throw input_error(file.string(),
                      ": states no endian, so the order of the bytes is unknown: save it "
                      "with one (endian: little)");
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
  const double skip = skipped_bytes(file, header, !gzip && !text);
  if (text) {
    const double found = numbers_in(data, start);
    if (found == announced.voxels) return;
    throw input_error(file.string(), ": ", found, " voxels, but the header announces ",
                      announced.voxels);
  }
  if (!gzip) {
    const double found = double(fs::file_size(data)) - double(start);
    const double needed = announced.bytes();
    return check_voxel_bytes(file.string(), skip < 0 ? std::min(found, needed) : found - skip,
                             needed);
  }
  const Content content = inflated_content(data, start, announced.bytes());
  if (content.packing != Packing::gzip) {
    throw input_error(file.string(), ": its voxels are not the gzip data its header announces");
  }
  check_voxel_bytes(file.string(), content.bytes, announced.bytes());
}

}  // namespace

NrrdNotes nrrd_notes(const fs::path& file) {
  const NrrdHeader header = nrrd_header_of(file);
  const std::vector<double> dimension = header_numbers(header.field("dimension"));
  constexpr double most_axes = 16;  // of the format; another number is left to check_nrrd
  const bool known = dimension.size() == 1 && dimension[0] >= 1 && dimension[0] <= most_axes;
  return {known ? int(dimension[0]) : 0, header.notes};
}

Grid nrrd_grid(const fs::path& file) {
  const NrrdHeader header = nrrd_header_of(file);
  const Announced announced = announced_by(file, header);
  const Grid grid = stated_grid(file, header);
  check_data(file, header, announced);
  return grid;
}

}  // namespace breast
