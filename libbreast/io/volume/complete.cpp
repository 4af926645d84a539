#include "io/volume/complete.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/error.hpp"

namespace breast {

namespace {

namespace fs = std::filesystem;

/// Bytes of a NIfTI-1 or -2 file according to its header; 0 when the header is not NIfTI.
double nifti_bytes(const unsigned char* header, std::size_t have) {
  const auto number = [&]<class T>(std::size_t offset, bool swap, T) {
    std::array<unsigned char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), header + offset, sizeof(T));
    if (swap) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  };
  if (have < 348) return 0;
  for (const bool swap : {false, true}) {
    const std::int32_t size = number(0, swap, std::int32_t{});
    const bool second = size == 540;
    if ((size != 348 && !second) || (second && have < 540)) continue;
    const double dimensions =
        second ? double(number(16, swap, std::int64_t{})) : number(40, swap, std::int16_t{});
    if (!(dimensions >= 1 && dimensions <= 7)) return 0;
    double voxels = 1;
    for (int d = 1; d <= int(dimensions); ++d) {
      voxels *= second ? double(number(16 + 8 * d, swap, std::int64_t{}))
                       : number(40 + 2 * d, swap, std::int16_t{});
    }
    const double bits = number(second ? 14 : 72, swap, std::int16_t{});
    const double offset =
        second ? double(number(168, swap, std::int64_t{})) : number(108, swap, float{});
    return offset + voxels * bits / 8;
  }
  return 0;
}

void check_nifti(const fs::path& file) {
  // zlib reads plain files as they are, so one loop serves .nii and .nii.gz and checks the CRC.
  const gzFile stream = gzopen(file.c_str(), "rb");
  if (!stream) throw input_error(file.string(), ": cannot be opened");
  std::vector<unsigned char> buffer(1 << 18), header;
  double total = 0;
  int got = 0;
  while ((got = gzread(stream, buffer.data(), unsigned(buffer.size()))) > 0) {
    if (total == 0) header.assign(buffer.begin(), buffer.begin() + std::min(got, 600));
    total += got;
  }
  int code = Z_OK;
  gzerror(stream, &code);
  const int closed = gzclose(stream);
  if (got < 0 || code != Z_OK || closed != Z_OK) {
    throw input_error(file.string(), ": truncated or damaged compressed data");
  }
  const double needed = nifti_bytes(header.data(), header.size());
  if (!(needed > 0)) throw input_error(file.string(), ": no NIfTI header");
  if (total < needed) {
    throw input_error(file.string(), ": truncated: ", total, " bytes, the header announces ",
                      needed);
  }
}

double meta_element_bytes(const std::string& type) {
  if (type.ends_with("CHAR")) return 1;
  if (type.ends_with("SHORT")) return 2;
  if (type == "MET_DOUBLE" || type.ends_with("LONG_LONG")) return 8;
  return 4;
}

void check_meta(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw input_error(file.string(), ": cannot be opened");
  double voxels = 0, element = 0, compressed = -1;
  for (std::string line; std::getline(in, line);) {
    const auto equals = line.find('=');
    if (equals == std::string::npos || line.size() > 4096) break;
    std::istringstream value(line.substr(equals + 1));
    const std::string key = line.substr(0, line.find_last_not_of(" \t", equals - 1) + 1);
    if (key == "DimSize") {
      voxels = 1;
      for (double size; value >> size;) voxels *= size;
    } else if (key == "ElementType") {
      std::string type;
      value >> type;
      element = meta_element_bytes(type);
    } else if (key == "CompressedDataSize") {
      value >> compressed;
    } else if (key == "ElementDataFile") {
      std::string name;
      value >> name;
      if (name == "LIST" || name.find('%') != std::string::npos) return;
      const bool local = name == "LOCAL" || name == "Local" || name == "local";
      std::error_code reason;
      const fs::path data = local ? file : file.parent_path() / name;
      const double have = double(fs::file_size(data, reason)) - (local ? double(in.tellg()) : 0.0);
      const double needed = compressed >= 0 ? compressed : voxels * element;
      if (reason || !(have >= needed)) {
        throw input_error(file.string(), ": truncated: voxel data of ", reason ? 0.0 : have,
                          " bytes, the header announces ", needed);
      }
      return;
    }
  }
  throw input_error(file.string(), ": no complete MetaImage header");
}

}  // namespace

void check_complete(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name.ends_with(".nii") || name.ends_with(".nii.gz")) check_nifti(file);
  if (name.ends_with(".mha") || name.ends_with(".mhd")) check_meta(file);
}

}  // namespace breast
