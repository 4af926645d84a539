// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/volume/encode.hpp"

#include <zlib.h>

#include <Eigen/Geometry>
#include <cstdint>
#include <cstring>
#include <limits>

#include "core/error.hpp"
#include "core/own_file.hpp"
#include "core/table.hpp"

namespace breast {

namespace {

// "a b c" with the given signs between the numbers.
std::string numbers(const Vec3& v, const char* between) {
  return format_number(v[0]) + between + format_number(v[1]) + between + format_number(v[2]);
}

std::string sizes(const Grid& grid) {
  return message(grid.size[0], " ", grid.size[1], " ", grid.size[2]);
}

// Little-endian fields of a fixed header, by byte offset.
class Header {
 public:
  explicit Header(std::size_t size) : bytes_(size, '\0') {}
  template <class T>
  void put(std::size_t offset, T value) {
    std::memcpy(bytes_.data() + offset, &value, sizeof value);
  }
  void put_text(std::size_t offset, std::string_view text) {
    std::memcpy(bytes_.data() + offset, text.data(), text.size());
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

}  // namespace

std::string gzip_bytes(std::string_view content) {
  constexpr int level = 2;  // beyond it the time grows, the file hardly shrinks
  constexpr int gzip_window = 15 + 16, memory = 8;
  z_stream z{};
  if (deflateInit2(&z, level, Z_DEFLATED, gzip_window, memory, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw failed_error("zlib cannot be started");
  }
  std::string mark(maker_mark);
  gz_header header{};
  header.comment = reinterpret_cast<Bytef*>(mark.data());
  header.os = 255;  // unknown: the same bytes everywhere
  deflateSetHeader(&z, &header);
  std::string out;
  std::string buffer(std::size_t(1) << 20, '\0');
  constexpr std::size_t most = std::size_t(1) << 30;  // zlib counts in 32 bits
  int code = Z_OK;
  do {
    if (z.avail_in == 0) {
      const std::string_view piece = content.substr(0, most);
      z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(piece.data()));
      z.avail_in = unsigned(piece.size());
      content.remove_prefix(piece.size());
    }
    z.next_out = reinterpret_cast<Bytef*>(buffer.data());
    z.avail_out = unsigned(buffer.size());
    code = deflate(&z, content.empty() ? Z_FINISH : Z_NO_FLUSH);
    out.append(buffer.data(), buffer.size() - z.avail_out);
  } while (code == Z_OK);
  deflateEnd(&z);
  if (code != Z_STREAM_END) throw failed_error("zlib cannot compress (code ", code, ")");
  return out;
}

std::string nrrd_bytes(const Grid& grid, const VoxelType& type, std::string_view voxels) {
  return nrrd_bytes(grid, type, voxels, {}, 1);
}

std::string nrrd_bytes(const Grid& grid, const VoxelType& type, std::string_view voxels,
                       const std::vector<std::pair<std::string, std::string>>& notes,
                       int components) {
  const bool vectors = components > 1;
  std::string directions, lines;
  for (const auto& [key, value] : notes) lines += key + ":=" + value + "\n";
  for (int d = 0; d < 3; ++d) {
    directions += " (" + numbers(grid.direction.col(d) * grid.spacing[d], ",") + ")";
  }
  return message(
             "NRRD0004\n# Complete NRRD file format specification at:\n",
             "# http://teem.sourceforge.net/nrrd/format.html\n# written by ", maker_mark,
             "\ntype: ", type.nrrd, "\ndimension: ", vectors ? 4 : 3,
             "\nspace: left-posterior-superior\nsizes: ", vectors ? message(components, " ") : "",
             sizes(grid), "\nspace directions:", vectors ? " none" : "", directions,
             "\nkinds: ", vectors ? "vector " : "",
             "domain domain domain\nendian: little\nencoding: gzip\nspace origin: (",
             numbers(grid.origin, ","), ")\n", lines, "\n") +
         gzip_bytes(voxels);
}

std::string meta_bytes(const Grid& grid, const VoxelType& type, std::string_view voxels) {
  std::string matrix;  // axis by axis
  for (int d = 0; d < 3; ++d) matrix += " " + numbers(grid.direction.col(d), " ");
  return message("ObjectType = Image\nNDims = 3\nComment = written by ", maker_mark,
                 "\nBinaryData = True\nBinaryDataByteOrderMSB = False\nCompressedData = False\n",
                 "TransformMatrix =", matrix, "\nOffset = ", numbers(grid.origin, " "),
                 "\nCenterOfRotation = 0 0 0\nAnatomicalOrientation = RAI\nElementSpacing = ",
                 numbers(grid.spacing, " "), "\nDimSize = ", sizes(grid),
                 "\nElementType = ", type.meta, "\nElementDataFile = LOCAL\n")
      .append(voxels);
}

// NIfTI-1 (nifti1.h), with the same orientation as quaternion and as matrix; its axes are RAS.
std::string nifti_bytes(const Grid& grid, const VoxelType& type, std::string_view voxels) {
  constexpr std::size_t header_bytes = 348, offset_of_voxels = 352;
  constexpr std::int16_t scanner = 1;
  Header header(offset_of_voxels);
  header.put(0, std::int32_t(header_bytes));
  header.put(40, std::int16_t(3));
  for (std::size_t d = 0; d < 3; ++d) {
    if (grid.size[d] > std::numeric_limits<std::int16_t>::max()) {
      throw input_error("NIfTI holds at most 32767 voxels along an axis, not ", grid.size[d],
                        ": write .nrrd or .mha");
    }
    header.put(42 + 2 * d, std::int16_t(grid.size[d]));
  }
  for (std::size_t d = 4; d < 8; ++d) header.put(40 + 2 * d, std::int16_t(1));
  header.put(70, std::int16_t(type.nifti));
  header.put(72, std::int16_t(type.bits));
  const Vec3 to_ras(-1, -1, 1);
  const Mat3 axes = to_ras.asDiagonal() * grid.direction;
  const Vec3 origin = to_ras.cwiseProduct(grid.origin);
  const float handed = axes.determinant() < 0 ? -1.0F : 1.0F;
  Mat3 rotation = axes;
  rotation.col(2) *= handed;
  Eigen::Quaterniond q(rotation);
  if (q.w() < 0) q.coeffs() *= -1;
  header.put(76, handed);
  for (std::size_t d = 0; d < 3; ++d) header.put(80 + 4 * d, float(grid.spacing[int(d)]));
  header.put(108, float(offset_of_voxels));
  header.put(112, 1.0F);     // slope
  header.put(123, char(2));  // mm
  header.put_text(148, "written by " + std::string(maker_mark));
  header.put(252, scanner);
  header.put(254, scanner);
  const double quaternion[] = {q.x(), q.y(), q.z(), origin[0], origin[1], origin[2]};
  for (std::size_t n = 0; n < 6; ++n) header.put(256 + 4 * n, float(quaternion[n]));
  for (int row = 0; row < 3; ++row) {
    const std::size_t at = 280 + 16 * std::size_t(row);
    for (int d = 0; d < 3; ++d) {
      header.put(at + 4 * std::size_t(d), float(axes(row, d) * grid.spacing[d]));
    }
    header.put(at + 12, float(origin[row]));
  }
  header.put_text(344, "n+1");
  return std::string(header.bytes()).append(voxels);
}

}  // namespace breast
