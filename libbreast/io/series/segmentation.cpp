// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/series/segmentation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "core/error.hpp"
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
constexpr const char *segmentation_class = "1.2.840.10008.5.1.4.1.1.66.4",
                     *label_map_class = "1.2.840.10008.5.1.4.1.1.66.7";

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

/// A frame is one segment in one slice, or the map of all segments in it.
struct Frame {
  int segment = 0;
  DicomImage place;
};

bool is_described(const std::vector<Segment>& segments, int number) {
  return std::any_of(segments.begin(), segments.end(),
                     [&](const Segment& one) { return one.value == number; });
}

std::vector<Frame> frames_of(const fs::path& file, const DicomObject& object,
                             const std::vector<Segment>& segments, bool is_map) {
  std::vector<Frame> frames;
  for (std::size_t n = 0; n < object.frames.size(); ++n) {
    std::string segment = text_of(object.frames[n], "0062|000a/0062|000b");
    if (segment.empty()) segment = text_of(object.header, "5200|9229/0062|000a/0062|000b");
    frames.push_back({std::atoi(segment.c_str()), placed_frame(file, object, int(n))});
    if (!is_map && !is_described(segments, frames.back().segment)) {
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

/// The segment of each pixel of all frames, one after the other.
class SegmentPixels {
 public:
  SegmentPixels(const fs::path& file, const DicomObject& object, bool is_map) : is_map_(is_map) {
    const std::string type = text_of(object.header, "0062|0001");
    const std::string bits = text_of(object.header, "0028|0100");
    if (type == "BINARY" && bits == "1" && !object.pixels->encapsulated) {
      packed_ = pixel_bytes(file, object);
    } else if ((type == "FRACTIONAL" && bits == "8") || is_map) {
      check_grey(file, object.header);
      values_ = guarded_values(file, object);
      const std::string most = text_of(object.header, "0062|000e");
      half_ = (most.empty() ? 255.0 : std::strtod(most.c_str(), nullptr)) / 2;
      none_ = std::atoi(text_of(object.header, "0028|0120").c_str());  // Pixel Padding Value
    } else {
      throw input_error(
          file.string(), ": a segmentation of type ", type, " with ", bits, " bits per pixel",
          object.pixels->encapsulated ? ", compressed" : "",
          "; BINARY with 1 bit, not compressed, FRACTIONAL with 8, or LABELMAP with 8 "
          "or 16 is read");
    }
  }
  /// The segment of a pixel of a frame that belongs to `segment`, unless it is a map; 0 for none.
  int at(std::size_t pixel, int segment) const {
    if (is_map_) return int(values_[pixel]) == none_ ? 0 : int(values_[pixel]);
    const bool inside = values_.empty() ? (std::uint8_t(packed_[pixel / 8]) >> (pixel % 8) & 1) != 0
                                        : double(values_[pixel]) > half_;
    return inside ? segment : 0;
  }
  /// Whether there are this many pixels.
  bool holds(std::size_t pixels) const {
    return values_.empty() ? packed_.size() * 8 >= pixels : values_.size() >= pixels;
  }

 private:
  bool is_map_;
  std::string packed_;
  std::vector<float> values_;
  double half_ = 0;
  int none_ = 0;
};

}  // namespace

bool is_dicom_segmentation(const fs::path& file) {
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return false;
  DicomObject object;
  try {
    if (!read_dicom_object(file, object)) return false;
  } catch (const Error&) {
    // Its reader says what is wrong.
  }
  const std::string kind = text_of(object.header, "0008|0016");
  return kind == segmentation_class || kind == label_map_class;
}

SegmentedVolume read_dicom_segmentation(const fs::path& file) {
  DicomObject object;
  if (!read_dicom_object(file, object) || !object.pixels)
    throw input_error(file.string(), ": not a DICOM segmentation");
  SegmentedVolume read;
  read.segments = segments_in(file, object.header);
  const bool is_map = text_of(object.header, "0062|0001") == "LABELMAP";
  const std::vector<Frame> frames = frames_of(file, object, read.segments, is_map);
  const DicomImage& first = frames.front().place;
  const std::vector<double> heights = heights_of(file, frames);
  read.values.grid = grid_of(file, first, heights, spacing_of(file, object, heights));
  const Grid& grid = read.values.grid;
  const SegmentPixels segments(file, object, is_map);
  const std::size_t pixels = std::size_t(first.columns) * std::size_t(first.rows);
  if (!segments.holds(pixels * frames.size())) {
    throw input_error(file.string(), ": fewer pixels than ", frames.size(), " frames of ",
                      first.columns, " x ", first.rows);
  }
  const double low = *std::min_element(heights.begin(), heights.end());
  read.values.voxels.assign(grid.voxels(), 0);
  for (std::size_t n = 0; n < frames.size(); ++n) {
    const int k = int(std::lround((heights[n] - low) / grid.spacing[2]));
    const std::size_t slice = grid.offset(0, 0, k);
    int described = 0;  // the last segment that was looked up
    for (std::size_t at = 0; at < pixels; ++at) {
      const int segment = segments.at(n * pixels + at, frames[n].segment);
      if (segment == 0) continue;
      float& voxel = read.values.voxels[slice + at];
      if (voxel != 0 && voxel != float(segment)) {
        throw input_error(file.string(), ": segments ", int(voxel), " and ", segment,
                          " overlap: which of them a voxel belongs to is unknown");
      }
      if (is_map && segment != described && !is_described(read.segments, segment)) {
        throw input_error(file.string(), ": frame ", n + 1, " shows segment ", segment,
                          ", which it does not describe");
      }
      described = segment;
      voxel = float(segment);
    }
  }
  if (text_of(object.header, "0062|0001") == "FRACTIONAL")
    read.remark =
        file.string() +
        ": its segments are fractions; a voxel belongs to the one that fills it by more than half";
  read.content_sha256 = content_hash(read.values);
  return read;
}

}  // namespace breast
