// SPDX-License-Identifier: GPL-3.0-or-later
// DICOM Segmentation objects as other programs write them: segments in frames of any order, without the
// slices that show none, of one bit, of fractions or as a map; and what is refused.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/table.hpp"
#include "fixtures/samples.hpp"
#include "fixtures/scratch_folder.hpp"
#include "io/dicom/dataset.hpp"
#include "io/dicom/header.hpp"
#include "io/segmentation_file.hpp"
#include "io/series/segmentation.hpp"

namespace breast {
namespace {

constexpr int map_padding = 500;  ///< the value of no segment in a map

struct Written {
  std::vector<std::string> labels = {"Chest wall", "Dense_1", "Fat"};
  bool fractional = false, map = false;  ///< else BINARY
  bool states_distance = true, overlap = false, one_label_less = false;
  double one_aside = 0, one_between = 0;  ///< mm
};

Grid oblique() {
  Grid grid;
  grid.size = {7, 5, 6};
  grid.spacing = Vec3(0.9, 1.1, 2.5);
  grid.origin = Vec3(-12, 30, 5);
  grid.direction = Eigen::AngleAxisd(0.3, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  return grid;
}

/// 0 to 3; the third slice is empty, and it is no end of the volume.
int value_at(int i, int j, int k) {
  return k == 2 ? 0 : (i + 2 * j + 3 * k) % 4;
}

std::string triple(const Vec3& v) {
  return format_number(v.x()) + "\\" + format_number(v.y()) + "\\" + format_number(v.z());
}

/// The object without its frames and pixels.
DatasetBuilder header_of(const Written& how, std::size_t frames,
                         const std::vector<DatasetBuilder>& segments) {
  const std::uint16_t bits = how.map ? 16 : how.fractional ? 8 : 1;
  DatasetBuilder set;
  set.text(0x00080016, "UI",
           how.map ? "1.2.840.10008.5.1.4.1.1.66.7" : "1.2.840.10008.5.1.4.1.1.66.4")
      .text(0x00080018, "UI", "2.25.11")
      .text(0x00080060, "CS", "SEG")
      .unsigned_short(0x00280002, 1)
      .text(0x00280004, "CS", "MONOCHROME2")
      .text(0x00280008, "IS", std::to_string(frames))
      .unsigned_short(0x00280010, std::uint16_t(oblique().size[1]))
      .unsigned_short(0x00280011, std::uint16_t(oblique().size[0]))
      .unsigned_short(0x00280100, bits)
      .unsigned_short(0x00280101, bits)
      .unsigned_short(0x00280102, std::uint16_t(bits - 1))
      .unsigned_short(0x00280103, 0)
      .text(0x00620001, "CS",
            how.map          ? "LABELMAP"
            : how.fractional ? "FRACTIONAL"
                             : "BINARY")
      .sequence(0x00620002, segments);
  if (how.fractional) set.unsigned_short(0x0062000e, 200);
  if (how.map) set.unsigned_short(0x00280120, map_padding);
  return set;
}

DatasetBuilder frame_of(const Vec3& place, int segment) {
  DatasetBuilder position, content, frame;
  position.text(0x00200032, "DS", triple(place));
  frame.sequence(0x00209113, {position});
  if (segment == 0) return frame;
  content.unsigned_short(0x0062000b, std::uint16_t(segment));
  return frame.sequence(0x0062000a, {content});
}

void write(const std::filesystem::path& file, const Written& how) {
  const Grid grid = oblique();
  std::vector<DatasetBuilder> segments, frames;
  for (std::size_t n = 0; n < how.labels.size(); ++n) {
    DatasetBuilder item;
    item.unsigned_short(0x00620004, std::uint16_t(n + 1));
    if (!how.one_label_less || n > 0) item.text(0x00620005, "LO", how.labels[n]);
    segments.push_back(item);
  }
  std::vector<int> pixels;  // the segment, or whether it is of that of the frame
  for (const int k : {5, 0, 3, 1, 4}) {
    for (int segment = how.map ? 0 : 1; segment <= (how.map ? 0 : 3); ++segment) {
      const bool last = k == 4 && segment == 3;
      const Vec3 moved = last ? Vec3(how.one_aside * grid.direction.col(0) +
                                     how.one_between * grid.direction.col(2))
                              : Vec3::Zero();
      frames.push_back(frame_of(grid.to_patient(Vec3(0, 0, k)) + moved, segment));
      for (int j = 0; j < grid.size[1]; ++j) {
        for (int i = 0; i < grid.size[0]; ++i) {
          const int value = value_at(i, j, k);
          const bool inside = value == segment || (how.overlap && value == 1);
          pixels.push_back(!how.map ? int(inside) : value == 0 ? map_padding : value);
        }
      }
    }
  }
  const std::size_t per_byte = how.fractional || how.map ? 1 : 8, width = how.map ? 2 : 1;
  std::string bytes((pixels.size() + per_byte - 1) / per_byte * width, '\0');
  for (std::size_t n = 0; n < pixels.size(); ++n) {
    if (how.map) {
      bytes[2 * n] = char(pixels[n] & 0xff);
      bytes[2 * n + 1] = char(pixels[n] >> 8);
    } else if (how.fractional) {
      bytes[n] = char(pixels[n] != 0 ? 140 : 90);  // of 200
    } else if (pixels[n] != 0) {
      bytes[n / 8] = char(std::uint8_t(bytes[n / 8]) | 1 << n % 8);
    }
  }
  if (bytes.size() % 2 != 0) bytes += '\0';
  DatasetBuilder axes, measures, shared;
  axes.text(0x00200037, "DS", triple(grid.direction.col(0)) + "\\" + triple(grid.direction.col(1)));
  measures.text(0x00280030, "DS", "1.1\\0.9");
  if (how.states_distance) measures.number(0x00180088, grid.spacing[2]);
  shared.sequence(0x00209116, {axes}).sequence(0x00289110, {measures});
  DatasetBuilder set = header_of(how, frames.size(), segments);
  set.sequence(0x52009229, {shared}).sequence(0x52009230, frames).words(0x7fe00010, bytes);
  write_text(file, set.file());
}

std::string refusal(const std::filesystem::path& file) {
  try {
    read_segmentation(file);
  } catch (const Error& error) {
    return error.kind() == ErrorKind::input ? error.what() : "";
  }
  return "";
}

TEST(DicomSegmentation, SegmentsAreWhereTheyWere) {
  const ScratchFolder folder;
  const auto file = folder / "seg";  // objects of an archive have no endings
  for (const std::string type : {"BINARY", "FRACTIONAL", "LABELMAP"}) {
    for (const bool states_distance : {false, true}) {
      SCOPED_TRACE(type);
      Written how;
      how.fractional = type == "FRACTIONAL";
      how.map = type == "LABELMAP";
      how.states_distance = states_distance;
      write(file, how);
      ASSERT_TRUE(is_segmentation_file(file));
      const SegmentedVolume read = read_segmentation(file);
      const Grid grid = oblique();
      ASSERT_EQ(read.values.grid.size, grid.size);
      EXPECT_LT((read.values.grid.origin - grid.origin).norm(), 1e-4);
      EXPECT_LT((read.values.grid.direction - grid.direction).norm(), 1e-4);
      EXPECT_LT((read.values.grid.spacing - grid.spacing).norm(), 1e-4);
      for (int k = 0; k < 6; ++k)
        for (int j = 0; j < 5; ++j)
          for (int i = 0; i < 7; ++i)
            ASSERT_EQ(read.values.voxels[grid.offset(i, j, k)], value_at(i, j, k));
      const LabelVolume labels =
          labels_of(read, parse_tissue_codes({"duke-fgt"}), Side::left, "seg");
      EXPECT_EQ(labels.at(1, 0, 0), Tissue::muscle);
      EXPECT_EQ(labels.at(2, 0, 0), Tissue::fibroglandular);
      EXPECT_EQ(labels.at(3, 0, 0), Tissue::fat);
      EXPECT_FALSE(read.content_sha256.empty());
      EXPECT_EQ(read.remark.find("by more than half") != std::string::npos, how.fractional);
    }
  }
}

TEST(DicomSegmentation, WhatIsNoVolumeOfSegmentsIsRefused) {
  const ScratchFolder folder;
  const auto says = [&](const Written& how, const char* what) {
    write(folder / "seg.dcm", how);
    EXPECT_NE(refusal(folder / "seg.dcm").find(what), std::string::npos)
        << what << ": " << refusal(folder / "seg.dcm");
  };
  Written how;
  how.overlap = true;
  says(how, "overlap");
  how = {};
  how.one_label_less = true;
  says(how, "3 numbers and 2 labels");
  how = {};
  how.one_aside = 3;
  says(how, "straight behind");
  how = {};
  how.one_between = 1;
  says(how, "apart");
  how = {};
  how.labels = {"Chest wall", "Fat"};
  says(how, "of segment '3', which it does not describe");
  how.map = true;
  says(how, "shows segment 3, which it does not describe");
  write_text(folder / "no.dcm", "nothing");
  EXPECT_FALSE(is_segmentation_file(folder / "no.dcm"));
}

TEST(DicomSegmentation, WhatIsWrittenReadsBackAndPassesTheValidator) {
  const ScratchFolder folder;
  LabelVolume labels = samples::labels();
  for (std::uint8_t& tissue : labels.tissue)  // segments are numbered without a gap
    if (tissue == std::uint8_t(Tissue::fibroglandular)) tissue = std::uint8_t(Tissue::fat);
  const auto file = folder / "labels.dcm", log = folder / "verdict.txt";
  write_dicom_segmentation(
      file, labels,
      {"1.2.3.4", "1.2.3.4.5", "1.2.3.6", "1.2.840.10008.5.1.4.1.1.4", {"1.2.7", "1.2.8"}});
  DicomHeader header;
  ASSERT_TRUE(read_dicom_header(file, header));
  EXPECT_EQ(text_of(header, "0020|000d"), "1.2.3.4");
  EXPECT_EQ(text_of(header, "0020|0052"), "1.2.3.6");
  const std::string bytes = read_text(file);  // series and instances to which it refers
  for (const char* uid : {"1.2.3.4.5", "1.2.7", "1.2.8"})
    EXPECT_NE(bytes.find(std::string(uid) + '\0'), std::string::npos) << uid;
  const LabelVolume back = labels_of(read_segmentation(file), {}, labels.side, "labels.dcm");
  ASSERT_EQ(back.grid.size[0], labels.grid.size[0]);
  // Slices without tissue at both ends are not in the object.
  const Vec3 offset = labels.grid.direction.transpose() * (back.grid.origin - labels.grid.origin);
  const int first = int(std::lround(offset.z() / labels.grid.spacing.z()));
  EXPECT_NEAR(offset.z(), first * labels.grid.spacing.z(), 1e-4);
  const std::size_t pixels = labels.grid.offset(0, 0, 1);
  for (std::size_t n = 0; n < labels.tissue.size(); ++n) {
    const int k = int(n / pixels) - first;
    const bool inside = k >= 0 && k < back.grid.size[2];
    const std::size_t there = std::size_t(std::max(k, 0)) * pixels + n % pixels;
    ASSERT_EQ(inside ? int(back.tissue[there]) : 0, int(labels.tissue[n])) << n;
  }
  // dciodvfy, of the Debian package dicom3tools, is the usual judge of DICOM conformance.
  if (std::system("command -v dciodvfy > /dev/null") != 0)
    GTEST_SKIP() << "dciodvfy is not installed";
  const std::string command = "dciodvfy '" + file.string() + "' > '" + log.string() + "' 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  const std::string verdict = read_text(log);
  EXPECT_NE(verdict.find("Segmentation"), std::string::npos) << verdict;
  EXPECT_EQ(verdict.find("Error"), std::string::npos) << verdict;
}

}  // namespace
}  // namespace breast
