// SPDX-License-Identifier: GPL-3.0-or-later
// NIfTI-1 and -2 (nifti1.h, nifti2.h). ITK 5.2 reads neither those in metres by sform nor a shear of
// 1e-4, and of scan.nii.gz it takes the voxels of a scan.nii beside it.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

#include "core/error.hpp"
#include "io/volume/header.hpp"
#include "io/volume/inflate.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

class NiftiHeader {
 public:
  /// Nothing when these are not the first bytes of a single-file NIfTI.
  static std::optional<NiftiHeader> of(const std::vector<unsigned char>& bytes) {
    for (const bool swapped : {false, true}) {
      const NiftiHeader header(bytes, swapped);
      if (bytes.size() < 348) return std::nullopt;
      const auto size = header.number<std::int32_t>(0);
      if (size != 348 && size != 540) continue;
      const bool second = size == 540;
      if (second && bytes.size() < 540) return std::nullopt;
      const char* magic = reinterpret_cast<const char*>(bytes.data()) + (second ? 4 : 344);
      if (std::memcmp(magic, second ? "n+2" : "n+1", 4) != 0) return std::nullopt;
      NiftiHeader found = header;
      found.second_ = second;
      return found;
    }
    return std::nullopt;
  }

  double dimension(int d) const {
    return second_ ? double(number<std::int64_t>(16 + 8 * std::size_t(d)))
                   : number<std::int16_t>(40 + 2 * std::size_t(d));
  }
  double voxel_size(int d) const {
    return second_ ? number<double>(104 + 8 * std::size_t(d))
                   : number<float>(76 + 4 * std::size_t(d));
  }
  int type() const { return second_ ? number<std::int16_t>(12) : number<std::int16_t>(70); }
  int bits() const { return second_ ? number<std::int16_t>(14) : number<std::int16_t>(72); }
  double voxel_offset() const {
    return second_ ? double(number<std::int64_t>(168)) : number<float>(108);
  }
  int units() const {
    return second_ ? number<std::int32_t>(500) & 7 : number<std::uint8_t>(123) & 7;
  }
  int qform() const { return second_ ? number<std::int32_t>(344) : number<std::int16_t>(252); }
  int sform() const { return second_ ? number<std::int32_t>(348) : number<std::int16_t>(254); }
  double quaternion(int n) const {  ///< b, c, d and the offsets x, y, z
    return second_ ? number<double>(352 + 8 * std::size_t(n))
                   : number<float>(256 + 4 * std::size_t(n));
  }
  double slope() const { return second_ ? number<double>(176) : number<float>(112); }
  double intercept() const { return second_ ? number<double>(184) : number<float>(116); }
  double matrix(int row, int column) const {
    const auto n = std::size_t(4 * row + column);
    return second_ ? number<double>(400 + 8 * n) : number<float>(280 + 4 * n);
  }

  /// The value at `stored`, from the file's order of bytes.
  template <class T>
  T ordered(const void* stored) const {
    std::array<unsigned char, sizeof(T)> bytes{};
    std::memcpy(bytes.data(), stored, sizeof(T));
    if (swapped_) std::reverse(bytes.begin(), bytes.end());
    return std::bit_cast<T>(bytes);
  }

 private:
  NiftiHeader(const std::vector<unsigned char>& bytes, bool swapped)
      : bytes_(&bytes), swapped_(swapped) {}

  template <class T>
  T number(std::size_t offset) const {
    return ordered<T>(bytes_->data() + offset);
  }

  const std::vector<unsigned char>* bytes_;
  bool swapped_, second_ = false;
};

int bits_of(int type) {
  switch (type) {
    case 2:
    case 256:
      return 8;
    case 4:
    case 512:
      return 16;
    case 8:
    case 16:
    case 768:
      return 32;
    case 64:
    case 1024:
    case 1280:
      return 64;
    default:
      return 0;  // complex, colour, 128 bits
  }
}

/// mm of the header's unit of length; unknown counts as mm, as every program takes it.
double mm_of_code(int code) {
  return code == 1 ? 1e3 : code == 3 ? 1e-3 : 1;
}

/// By quaternion, in RAS as the format has it.
Grid quaternion_grid(const std::string& name, const NiftiHeader& header, double mm) {
  const Vec3 bcd(header.quaternion(0), header.quaternion(1), header.quaternion(2));
  constexpr double rounding = 1e-3;
  if (!(bcd.squaredNorm() <= 1 + rounding)) {
    throw input_error(name, ": qform's quaternion has length ", bcd.norm(), ": must be at most 1");
  }
  const double a = std::sqrt(std::max(0.0, 1 - bcd.squaredNorm()));
  Grid grid;
  grid.direction = Eigen::Quaterniond(a, bcd[0], bcd[1], bcd[2]).normalized().toRotationMatrix();
  if (header.voxel_size(0) < 0) grid.direction.col(2) *= -1;
  for (int d = 0; d < 3; ++d) {
    grid.spacing[d] = mm * header.voxel_size(d + 1);
    grid.origin[d] = mm * header.quaternion(3 + d);
  }
  return grid;
}

Grid matrix_grid(const NiftiHeader& header, double mm) {
  Mat3 axes;
  Grid grid;
  for (int row = 0; row < 3; ++row) {
    for (int d = 0; d < 3; ++d) axes(row, d) = mm * header.matrix(row, d);
    grid.origin[row] = mm * header.matrix(row, 3);
  }
  set_axes(grid, axes);
  return grid;
}

Grid in_lps(Grid grid) {
  for (int d = 0; d < 2; ++d) {
    grid.origin[d] *= -1;
    grid.direction.row(d) *= -1;
  }
  return grid;
}

/// The grid by sform if it is stated, otherwise by qform, and pixdim; where both are stated they agree.
Grid stated_grid(const std::string& name, const NiftiHeader& header) {
  const double mm = mm_of_code(header.units());
  const bool quaternion = header.qform() > 0, matrix = header.sform() > 0;
  if (!quaternion && !matrix) {
    throw input_error(name,
                      ": states no orientation (qform and sform code 0), so left and right are "
                      "unknown: convert the scan again from DICOM");
  }
  Grid by_size;
  for (int d = 0; d < 3; ++d) by_size.spacing[d] = mm * header.voxel_size(d + 1);
  check_scan_grid(name, by_size);
  const Grid by_quaternion = quaternion ? quaternion_grid(name, header, mm) : by_size;
  check_scan_grid(name, by_quaternion);
  if (!matrix) return in_lps(by_quaternion);
  const Grid grid = matrix_grid(header, mm);
  check_scan_grid(name, grid);
  constexpr double of_size = 0.01, of_direction = 0.01, of_origin_mm = 1;
  for (int d = 0; d < 3; ++d) {
    if (std::abs(grid.spacing[d] - by_size.spacing[d]) > of_size * by_size.spacing[d]) {
      throw input_error(name, ": sform's voxel size ", grid.spacing[d], " mm and pixdim's ",
                        by_size.spacing[d], " mm along axis ", d, " contradict each other");
    }
  }
  if (quaternion &&
      ((grid.direction - by_quaternion.direction).cwiseAbs().maxCoeff() > of_direction ||
       (grid.origin - by_quaternion.origin).norm() > of_origin_mm)) {
    throw input_error(name,
                      ": qform and sform contradict each other: keep only that of the "
                      "scanner");
  }
  return in_lps(grid);
}

/// Bytes from the file's begin to the last voxel.
double announced_bytes(const std::string& name, const NiftiHeader& header) {
  const double dimensions = header.dimension(0);
  if (!(dimensions >= 1 && dimensions <= 7)) {
    throw input_error(name, ": ", dimensions, " dimensions, must be 1 to 7");
  }
  double voxels = 1;
  for (int d = 1; d <= int(dimensions); ++d) {
    if (!(header.dimension(d) >= 1)) {
      throw input_error(name, ": size ", header.dimension(d), " along axis ", d - 1);
    }
    voxels *= header.dimension(d);
  }
  check_voxel_count(name, voxels);
  if (bits_of(header.type()) == 0 || bits_of(header.type()) != header.bits()) {
    throw input_error(name, ": data type ", header.type(), " of ", header.bits(),
                      " bits: grey values of 8 to 64 bits are read");
  }
  const double offset = header.voxel_offset();
  constexpr double most_offset = 1e8;
  if (!(offset >= 348 && offset <= most_offset)) {
    throw input_error(name, ": the stated start of the voxels is byte ", offset,
                      ": must be 348 or more");
  }
  return offset + voxels * header.bits() / 8;
}

std::array<int, 3> sizes_of(const std::string& name, const NiftiHeader& header) {
  std::vector<double> sizes;
  for (int d = 1; d <= int(header.dimension(0)); ++d) sizes.push_back(header.dimension(d));
  check_volume_sizes(name, sizes);
  return {int(sizes[0]), int(sizes[1]), int(sizes[2])};
}

/// Stored values, as the header scales them: slope 0, or one that is no number, stands for none.
template <class T>
std::vector<float> scaled(const NiftiHeader& header, const char* stored, std::size_t voxels) {
  const bool scales = std::isfinite(header.slope()) && header.slope() != 0;
  const double slope = scales ? header.slope() : 1;
  const double intercept = scales && std::isfinite(header.intercept()) ? header.intercept() : 0;
  std::vector<float> values(voxels);
  for (std::size_t v = 0; v < voxels; ++v) {
    const T value = header.ordered<T>(stored + v * sizeof(T));
    values[v] =
        slope == 1 && intercept == 0 ? float(value) : float(double(value) * slope + intercept);
  }
  return values;
}

std::vector<float> voxels_of(const NiftiHeader& header, const std::string& bytes,
                             std::size_t voxels) {
  const char* stored = bytes.data() + std::size_t(header.voxel_offset());
  switch (header.type()) {
    case 2:
      return scaled<std::uint8_t>(header, stored, voxels);
    case 256:
      return scaled<std::int8_t>(header, stored, voxels);
    case 4:
      return scaled<std::int16_t>(header, stored, voxels);
    case 512:
      return scaled<std::uint16_t>(header, stored, voxels);
    case 8:
      return scaled<std::int32_t>(header, stored, voxels);
    case 768:
      return scaled<std::uint32_t>(header, stored, voxels);
    case 16:
      return scaled<float>(header, stored, voxels);
    case 64:
      return scaled<double>(header, stored, voxels);
    case 1024:
      return scaled<std::int64_t>(header, stored, voxels);
    default:
      return scaled<std::uint64_t>(header, stored, voxels);
  }
}

}  // namespace

Volume<float> read_nifti(const fs::path& file) {
  const std::string name = file.string();
  const std::vector<unsigned char> head = head_of(file);
  const auto header = NiftiHeader::of(head);
  if (!header)
    throw input_error(
        name, ": not the NIfTI header of a single file; convert a pair of .hdr and .img to .nii");
  const double needed = announced_bytes(name, *header);
  Volume<float> volume;
  volume.grid = stated_grid(name, *header);
  volume.grid.size = sizes_of(name, *header);
  std::string bytes;
  check_voxel_bytes(name, inflated_content(file, 0, needed, &bytes).bytes, needed);
  volume.voxels = voxels_of(*header, bytes, volume.grid.voxels());
  return volume;
}

}  // namespace breast
