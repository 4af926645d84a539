// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/series/segmentation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "core/error.hpp"
#include "core/guarded_child.hpp"
#include "core/text/lists.hpp"
#include "io/dicom/header.hpp"
#include "io/dicom/stored_values.hpp"
#include "io/series/image.hpp"
#include "io/volume/header.hpp"
#include "io/volume_file.hpp"

namespace breast {

namespace {

namespace fs = std::filesystem;

constexpr double least_spacing_mm = 0.01, most_spacing_mm = 50;  // of slices
constexpr const char* segmentation_class = "1.2.840.10008.5.1.4.1.1.66.4";

std::vector<std::string> listed(const DicomHeader& header, const char* key) {
  const std::string text = text_of(header, key);
  return text.empty() ? std::vector<std::string>() : split(text, '\\');
}

/// Segment Sequence: number and label of each.
std::vector<Segment> segments_in(const fs::path& file, const DicomHeader& header) {
  const auto numbers = listed(header, "0062|0002/0062|0004"),
             labels = listed(header, "0062|0002/0062|0005");
  if (numbers.empty() || numbers.size() != labels.size()) {
    throw input_error(file.string(), ": a segmentation with ", numbers.size(), " numbers and ",
                      labels.size(), " labels of segments; one of each is needed");
  }
  std::vector<Segment> segments;
  for (std::size_t n = 0; n < numbers.size(); ++n)
    segments.push_back({labels[n], std::atoi(numbers[n].c_str()), {}, {}});
  return segments;
}

/// A frame is one segment in one slice.
struct Frame {
  int segment = 0;
  DicomImage place;
};

std::vector<Frame> frames_of(const fs::path& file, const DicomObject& object,
                             const std::vector<Segment>& segments) {
  std::vector<Frame> frames;
  for (std::size_t n = 0; n < object.frames.size(); ++n) {
    std::string segment = text_of(object.frames[n], "0062|000a/0062|000b");
    if (segment.empty()) segment = text_of(object.header, "5200|9229/0062|000a/0062|000b");
    frames.push_back({std::atoi(segment.c_str()), placed_frame(file, object, int(n))});
    const bool known = std::any_of(segments.begin(), segments.end(), [&](const Segment& one) {
      return one.value == frames.back().segment;
    });
    if (!known) {
      throw input_error(file.string(), ": frame ", n + 1, " is of segment '", segment,
                        "', which it does not describe");
    }
  }
  if (frames.empty()) throw input_error(file.string(), ": describes no frame");
  return frames;
}

/// Coordinate of each frame along the normal, mm. The frames of one volume differ in nothing else.
std::vector<double> heights_of(const fs::path& file, const std::vector<Frame>& frames) {
  constexpr double bound = 1e-3, aside_mm = 0.05;
  const DicomImage& first = frames.front().place;
  const Vec3 normal = first.row.cross(first.column).normalized();
  std::vector<double> heights;
  for (std::size_t n = 0; n < frames.size(); ++n) {
    const DicomImage& place = frames[n].place;
    const Vec3 way = place.position - first.position;
    heights.push_back(way.dot(normal));
    if ((way - heights.back() * normal).norm() > aside_mm ||
        (place.row - first.row).norm() > bound || (place.column - first.column).norm() > bound ||
        (place.pixel - first.pixel).norm() > bound) {
      throw input_error(file.string(), ": frame ", n + 1,
                        " does not lie straight behind the first: its frames are no volume");
    }
  }
  return heights;
}

/// Distance of slices: as stated (Spacing Between Slices), else the least one that occurs. Slices
/// without any segment may be missing.
double spacing_of(const fs::path& file, const DicomObject& object, std::vector<double> heights) {
  const std::string stated = text_of(object.header, "5200|9229/0028|9110/0018|0088");
  if (!stated.empty()) {
    const double spacing = std::strtod(stated.c_str(), nullptr);
    if (spacing >= least_spacing_mm && spacing <= most_spacing_mm) return spacing;
    throw input_error(file.string(), ": spacing between slices ", stated, " mm: must be ",
                      least_spacing_mm, " to ", most_spacing_mm, " mm");
  }
  std::sort(heights.begin(), heights.end());
  double least = 0;
  for (std::size_t n = 1; n < heights.size(); ++n) {
    const double step = heights[n] - heights[n - 1];
    if (step > least_spacing_mm && (least == 0 || step < least)) least = step;
  }
  if (least == 0)
    throw input_error(file.string(), ": has one slice and states no distance of slices");
  return least;
}

Grid grid_of(const fs::path& file, const DicomImage& first, const std::vector<double>& heights,
             double spacing) {
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  const Vec3 normal = first.row.cross(first.column).normalized();
  const double slices = 1 + (*high - *low) / spacing;
  check_volume_sizes(file.string(), {double(first.columns), double(first.rows), slices});
  check_voxel_count(file.string(), double(first.columns) * first.rows * slices);
  Grid grid;
  grid.size = {first.columns, first.rows, 1 + int(std::lround((*high - *low) / spacing))};
  grid.spacing = Vec3(first.pixel[1], first.pixel[0], spacing);
  grid.direction.col(0) = first.row;
  grid.direction.col(1) = first.column;
  grid.direction.col(2) = normal;
  grid.origin = first.position + *low * normal;
  constexpr double bound = 0.05;  // of the spacing
  for (const double height : heights) {
    const double at = (height - *low) / spacing;
    if (std::abs(at - std::round(at)) > bound) {
      throw input_error(file.string(), ": slices are not ", spacing, " mm apart: one lies ",
                        height - *low, " mm from the first");
    }
  }
  return grid;
}

/// Whether each pixel of each frame is in its segment.
class Bits {
 public:
  Bits(const fs::path& file, const DicomObject& object) {
    const std::string type = text_of(object.header, "0062|0001");
    const std::string bits = text_of(object.header, "0028|0100");
    if (type == "BINARY" && bits == "1" && !object.pixels->encapsulated) {
      packed_ = pixel_bytes(file, object);
    } else if (type == "FRACTIONAL" && bits == "8") {
      check_grey(file, object.header);
      const auto read = [&] {
        std::string bytes;
        for (const float value : stored_values(file, object)) bytes += char(std::uint8_t(value));
        return bytes;
      };
      fractions_ = object.pixels->encapsulated ? in_guarded_child(file.string(), read) : read();
      const std::string most = text_of(object.header, "0062|000e");
      half_ = (most.empty() ? 255.0 : std::strtod(most.c_str(), nullptr)) / 2;
    } else {
      throw input_error(file.string(), ": a segmentation of type ", type, " with ", bits,
                        " bits per pixel", object.pixels->encapsulated ? ", compressed" : "",
                        "; BINARY with 1 bit, not compressed, or FRACTIONAL with 8 is read");
    }
  }
  bool at(std::size_t pixel) const {
    if (fractions_.empty()) return (std::uint8_t(packed_[pixel / 8]) >> (pixel % 8) & 1) != 0;
    return double(std::uint8_t(fractions_[pixel])) > half_;
  }
  /// Whether there are this many pixels.
  bool holds(std::size_t pixels) const {
    return fractions_.empty() ? packed_.size() * 8 >= pixels : fractions_.size() >= pixels;
  }

 private:
  std::string packed_, fractions_;
  double half_ = 0;
};

}  // namespace

bool is_dicom_segmentation(const fs::path& file) {
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return false;
  DicomObject object;
  try {
    return read_dicom_object(file, object) &&
           text_of(object.header, "0008|0016") == segmentation_class;
  } catch (const Error&) {
    return text_of(object.header, "0008|0016") ==
           segmentation_class;  // its reader says what is wrong
  }
}

SegmentedVolume read_dicom_segmentation(const fs::path& file) {
  DicomObject object;
  if (!read_dicom_object(file, object) || !object.pixels)
    throw input_error(file.string(), ": not a DICOM segmentation");
  SegmentedVolume read;
  read.segments = segments_in(file, object.header);
  const std::vector<Frame> frames = frames_of(file, object, read.segments);
  const DicomImage& first = frames.front().place;
  const std::vector<double> heights = heights_of(file, frames);
  read.values.grid = grid_of(file, first, heights, spacing_of(file, object, heights));
  const Grid& grid = read.values.grid;
  const Bits bits(file, object);
  const std::size_t pixels = std::size_t(first.columns) * std::size_t(first.rows);
  if (!bits.holds(pixels * frames.size())) {
    throw input_error(file.string(), ": fewer pixels than ", frames.size(), " frames of ",
                      first.columns, " x ", first.rows);
  }
  const double low = *std::min_element(heights.begin(), heights.end());
  read.values.voxels.assign(grid.voxels(), 0);
  for (std::size_t n = 0; n < frames.size(); ++n) {
    const int k = int(std::lround((heights[n] - low) / grid.spacing[2]));
    const std::size_t slice = grid.offset(0, 0, k);
    for (std::size_t at = 0; at < pixels; ++at) {
      if (!bits.at(n * pixels + at)) continue;
      float& voxel = read.values.voxels[slice + at];
      if (voxel != 0 && voxel != float(frames[n].segment)) {
        throw input_error(file.string(), ": segments ", int(voxel), " and ", frames[n].segment,
                          " overlap: which of them a voxel belongs to is unknown");
      }
      voxel = float(frames[n].segment);
    }
  }
  read.content_sha256 = content_hash(read.values);
  return read;
}

}  // namespace breast
