#include "io/volume/complete.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>
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

struct Content {
  double bytes = 0;
  std::vector<unsigned char> head;  ///< the first of them, enough for a header
  bool compressed = false;

  void add(const unsigned char* data, std::size_t count) {
    if (bytes == 0) head.assign(data, data + std::min<std::size_t>(count, 600));
    bytes += double(count);
  }
};

/// Inflates the members of a gzip stream up to the last one's checksum and length, which zlib
/// compares. gzread will not do: it takes a stream cut inside them for whole.
class Inflater {
 public:
  Inflater(const fs::path& file, std::ifstream& in) : file_(file), in_(in) {
    constexpr int gzip_only = 15 + 16;
    if (inflateInit2(&z_, gzip_only) != Z_OK) throw failed_error(file.string(), ": no zlib");
  }
  ~Inflater() { inflateEnd(&z_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  void run(Content& content) {
    int code = Z_OK;
    while (code != Z_STREAM_END || another_member()) {
      if (code == Z_STREAM_END) inflateReset(&z_);
      if (z_.avail_in == 0) refill();
      z_.next_out = out_.data();
      z_.avail_out = unsigned(out_.size());
      code = inflate(&z_, Z_NO_FLUSH);
      const bool stuck = code == Z_BUF_ERROR && z_.avail_in == 0 && !in_;
      if ((code != Z_OK && code != Z_STREAM_END && code != Z_BUF_ERROR) || stuck) {
        throw input_error(file_.string(), ": truncated or damaged compressed data");
      }
      content.add(out_.data(), out_.size() - z_.avail_out);
    }
  }

 private:
  void refill() {
    in_.read(reinterpret_cast<char*>(in_buffer_.data()), std::streamsize(in_buffer_.size()));
    z_.next_in = in_buffer_.data();
    z_.avail_in = unsigned(in_.gcount());
  }
  // Whatever else follows a gzip stream is padding.
  bool another_member() {
    if (z_.avail_in == 0) refill();
    return z_.avail_in > 0 && *z_.next_in == 0x1f;
  }

  const fs::path& file_;
  std::ifstream& in_;
  z_stream z_{};
  std::vector<unsigned char> in_buffer_ = std::vector<unsigned char>(1 << 16),
                             out_ = std::vector<unsigned char>(1 << 18);
};

/// What `file` holds from byte `start` on, inflated when it is gzip.
Content content_from(const fs::path& file, std::streamoff start) {
  std::ifstream in(file, std::ios::binary);
  if (!in.seekg(start)) throw input_error(file.string(), ": cannot be opened");
  char magic[2] = {};
  in.read(magic, 2);
  in.clear();
  in.seekg(start);
  Content content;
  content.compressed = magic[0] == '\x1f' && magic[1] == '\x8b';
  if (content.compressed) {
    Inflater(file, in).run(content);
    return content;
  }
  std::vector<unsigned char> buffer(1 << 18);
  while (in) {
    in.read(reinterpret_cast<char*>(buffer.data()), std::streamsize(buffer.size()));
    content.add(buffer.data(), std::size_t(in.gcount()));
  }
  return content;
}

void check_nifti(const fs::path& file) {
  const Content content = content_from(file, 0);
  const std::vector<unsigned char>& header = content.head;
  const double total = content.bytes;
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

void check_gzip(const fs::path& file, std::streamoff start) {
  if (!content_from(file, start).compressed) {
    throw input_error(file.string(), ": its voxels are not the gzip data its header announces");
  }
}

// ITK's reader counts the voxels itself, but stops before the checksum that ends a gzip stream.
void check_nrrd(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw input_error(file.string(), ": cannot be opened");
  bool gzip = false, skips_lines = false;
  std::string detached;
  for (std::string line; std::getline(in, line) && line.size() <= 65536;) {
    if (line.ends_with('\r')) line.pop_back();
    if (line.empty()) break;
    const auto colon = line.find(": ");
    if (line.starts_with('#') || colon == std::string::npos) continue;
    std::string key = line.substr(0, colon);
    std::transform(key.begin(), key.end(), key.begin(),
                   [](unsigned char c) { return char(std::tolower(c)); });
    std::string value;
    std::istringstream(line.substr(colon + 1)) >> value;
    if (key == "encoding") gzip = value == "gzip" || value == "gz";
    if (key == "data file" || key == "datafile") detached = value;
    if (key == "line skip" || key == "lineskip") skips_lines = value != "0";
  }
  const bool several = detached == "LIST" || detached.find('%') != std::string::npos;
  if (!gzip || skips_lines || several) return;
  if (!detached.empty()) return check_gzip(file.parent_path() / detached, 0);
  if (!in) throw input_error(file.string(), ": truncated: its header does not end");
  check_gzip(file, in.tellg());
}

}  // namespace

void check_complete(const fs::path& file) {
  const std::string name = file.filename().string();
  if (name.ends_with(".nii") || name.ends_with(".nii.gz")) check_nifti(file);
  if (name.ends_with(".nrrd") || name.ends_with(".nhdr")) check_nrrd(file);
  if (name.ends_with(".mha") || name.ends_with(".mhd")) check_meta(file);
}

}  // namespace breast
