// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cstdint>
#include <cstdio>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/own_file.hpp"
#include "core/sha256.hpp"
#include "io/dicom/dataset.hpp"
#include "io/series/segmentation.hpp"

namespace breast {

namespace {

namespace fs = std::filesystem;

/// One segment in one slice. Segments are numbered from 1 without a gap (PS3.3 C.8.20.2).
struct Frame {
  int number = 0, tissue = 0, slice = 0;
};

std::string content_of(const LabelVolume& labels) {
  Sha256 hash;
  hash.update(labels.tissue.data(), labels.tissue.size());
  hash.update(side_name(labels.side));
  for (int d = 0; d < 3; ++d) hash.update(vector_text(labels.grid.direction.col(d)));
  hash.update(vector_text(labels.grid.origin) + vector_text(labels.grid.spacing));
  return hash.hex();
}

std::vector<Frame> frames_of(const LabelVolume& labels, const std::vector<Segment>& segments) {
  std::vector<Frame> frames;
  const std::size_t pixels = std::size_t(labels.grid.size[0]) * std::size_t(labels.grid.size[1]);
  for (std::size_t s = 0; s < segments.size(); ++s) {
    const int tissue = segments[s].value;
    for (int k = 0; k < labels.grid.size[2]; ++k) {
      const auto first = labels.tissue.begin() + std::ptrdiff_t(labels.grid.offset(0, 0, k));
      const auto last = first + std::ptrdiff_t(pixels);
      if (std::find(first, last, std::uint8_t(tissue)) != last)
        frames.push_back({int(s) + 1, tissue, k});
    }
  }
  return frames;
}

/// Bits of all frames one after the other, the lowest bit of a byte first (PS3.5 8.1.1).
std::string bits_of(const LabelVolume& labels, const std::vector<Frame>& frames) {
  const std::size_t pixels = std::size_t(labels.grid.size[0]) * std::size_t(labels.grid.size[1]);
  std::string bytes((frames.size() * pixels + 15) / 16 * 2, '\0');
  std::size_t bit = 0;
  for (const Frame& frame : frames) {
    const std::size_t first = labels.grid.offset(0, 0, frame.slice);
    for (std::size_t n = 0; n < pixels; ++n, ++bit) {
      if (labels.tissue[first + n] != frame.tissue) continue;
      bytes[bit / 8] = char(std::uint8_t(bytes[bit / 8]) | 1u << bit % 8);
    }
  }
  return bytes;
}

/// No patient and no date: neither is in any file of libbreast. Archives show it with the scan because it is
/// of its study.
void add_identity(DatasetBuilder& set, const std::string& content, const DicomReference& scan) {
  const auto uid = [&](const std::string& of_scan, const char* own) {
    return of_scan.empty() ? uid_from(content + own) : of_scan;
  };
  set.text(0x00080005, "CS", "ISO_IR 192")
      .text(0x00080008, "CS", "DERIVED\\PRIMARY")
      .text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.66.4")
      .text(0x00080018, "UI", uid_from(content + "/segmentation"))
      .text(0x00080020, "DA", "")
      .text(0x00080023, "DA", "19000101")
      .text(0x00080030, "TM", "")
      .text(0x00080033, "TM", "000000")
      .text(0x00080050, "SH", "")
      .text(0x00080060, "CS", "SEG")
      .text(0x00080070, "LO", std::string(maker_mark))
      .text(0x00080090, "PN", "")
      .text(0x00081090, "LO", "segment")
      .text(0x00100010, "PN", "")
      .text(0x00100020, "LO", "")
      .text(0x00100030, "DA", "")
      .text(0x00100040, "CS", "")
      .text(0x00181000, "LO", "none")
      .text(0x00181020, "LO", "none")
      .text(0x0020000d, "UI", uid(scan.study_uid, "/study"))
      .text(0x0020000e, "UI", uid_from(content + "/series"))
      .text(0x00200010, "SH", "")
      .text(0x00200011, "IS", "1")
      .text(0x00200013, "IS", "1")
      .text(0x00200052, "UI", uid(scan.frame_of_reference_uid, "/frame"))
      .text(0x00201040, "LO", "")
      .text(0x00700080, "CS", "TISSUES")
      .text(0x00700081, "LO", "")
      .text(0x00700084, "PN", "");
}

bool can_be_referred_to(const DicomReference& scan) {
  return !scan.study_uid.empty() && !scan.series_uid.empty() && !scan.sop_class.empty() &&
         !scan.instance_uids.empty();
}

std::vector<DatasetBuilder> instances_of(const DicomReference& scan) {
  std::vector<DatasetBuilder> instances;
  for (const std::string& uid : scan.instance_uids) {
    DatasetBuilder instance;
    instance.text(0x00081150, "UI", scan.sop_class).text(0x00081155, "UI", uid);
    instances.push_back(instance);
  }
  return instances;
}

/// From what all frames were made: every instance of the scan (PS3.3 C.7.6.16.2.6).
void add_derivation(DatasetBuilder& shared, const DicomReference& scan) {
  std::vector<DatasetBuilder> sources = instances_of(scan);
  for (DatasetBuilder& source : sources)
    source.sequence(0x0040a170,
                    {code_item("121322", "DCM", "Source image for image processing operation")});
  DatasetBuilder derivation;
  derivation.sequence(0x00089215, {code_item("113076", "DCM", "Segmentation")})
      .sequence(0x00082112, sources);
  shared.sequence(0x00089124, {derivation});
}

/// Names the scan's series and its instances, by which archives and viewers find it.
void add_reference(DatasetBuilder& set, const DicomReference& scan) {
  if (!can_be_referred_to(scan)) return;
  const std::vector<DatasetBuilder> instances = instances_of(scan);
  DatasetBuilder series;
  series.text(0x0020000e, "UI", scan.series_uid).sequence(0x0008114a, instances);
  set.sequence(0x00081115, {series});
}

/// The kind of all segments: a tissue, which the label names.
DatasetBuilder any_tissue() {
  return code_item("85756007", "SCT", "Tissue");
}

void add_segments(DatasetBuilder& set, const std::vector<Segment>& segments) {
  std::vector<DatasetBuilder> items;
  for (const Segment& segment : segments) {
    DatasetBuilder item;
    item.unsigned_short(0x00620004, std::uint16_t(items.size() + 1))
        .text(0x00620005, "LO", segment.name)
        .text(0x00620008, "CS", "AUTOMATIC")
        .text(0x00620009, "LO", std::string(maker_mark) + " segment")
        .sequence(0x00620003, {any_tissue()})
        .sequence(0x0062000f, {any_tissue()});
    items.push_back(item);
  }
  set.text(0x00620001, "CS", "BINARY").text(0x00620013, "CS", "NO").sequence(0x00620002, items);
}

/// Frames are ordered by segment, then by slice.
void add_dimensions(DatasetBuilder& set, const std::string& content) {
  const std::string uid = uid_from(content + "/dimensions");
  DatasetBuilder organization, by_segment, by_place;
  organization.text(0x00209164, "UI", uid);
  by_segment.text(0x00209164, "UI", uid)
      .tag_of(0x00209165, 0x0062000b)
      .tag_of(0x00209167, 0x0062000a);
  by_place.text(0x00209164, "UI", uid)
      .tag_of(0x00209165, 0x00200032)
      .tag_of(0x00209167, 0x00209113);
  set.sequence(0x00209221, {organization}).sequence(0x00209222, {by_segment, by_place});
}

void add_frames(DatasetBuilder& set, const Grid& grid, const std::vector<Frame>& frames,
                const DicomReference& scan) {
  DatasetBuilder axes, measures, shared;
  char pixel[40];
  std::snprintf(pixel, sizeof pixel, "%.10g\\%.10g", grid.spacing[1], grid.spacing[0]);
  axes.text(0x00200037, "DS",
            vector_text(grid.direction.col(0)) + "\\" + vector_text(grid.direction.col(1)));
  measures.number(0x00180050, grid.spacing[2])
      .number(0x00180088, grid.spacing[2])
      .text(0x00280030, "DS", pixel);
  shared.sequence(0x00209116, {axes}).sequence(0x00289110, {measures});
  if (can_be_referred_to(scan)) add_derivation(shared, scan);
  std::vector<DatasetBuilder> items;
  for (const Frame& frame : frames) {
    DatasetBuilder content, place, segment, item;
    content.unsigned_longs(0x00209157,
                           {std::uint32_t(frame.number), std::uint32_t(frame.slice + 1)});
    place.text(0x00200032, "DS", vector_text(grid.to_patient(Vec3(0, 0, frame.slice))));
    segment.unsigned_short(0x0062000b, std::uint16_t(frame.number));
    item.sequence(0x00209111, {content})
        .sequence(0x00209113, {place})
        .sequence(0x0062000a, {segment});
    items.push_back(item);
  }
  set.text(0x00280008, "IS", std::to_string(frames.size()))
      .sequence(0x52009229, {shared})
      .sequence(0x52009230, items);
}

}  // namespace

void write_dicom_segmentation(const fs::path& file, const LabelVolume& labels,
                              const DicomReference& scan) {
  const Grid& grid = labels.grid;
  if (grid.size[0] > 65535 || grid.size[1] > 65535) {
    throw input_error(file.string(), ": ", grid.size[0], " x ", grid.size[1],
                      " pixels, but DICOM allows at most 65535 along a side");
  }
  std::vector<Segment> segments = segments_of(labels);
  const std::vector<Frame> frames = frames_of(labels, segments);
  const std::string content = content_of(labels) + scan.series_uid;
  DatasetBuilder set;
  add_identity(set, content, scan);
  add_reference(set, scan);
  add_segments(set, segments);
  add_dimensions(set, content);
  add_frames(set, grid, frames, scan);
  set.unsigned_short(0x00280002, 1)
      .text(0x00280004, "CS", "MONOCHROME2")
      .unsigned_short(0x00280010, std::uint16_t(grid.size[1]))
      .unsigned_short(0x00280011, std::uint16_t(grid.size[0]))
      .unsigned_short(0x00280100, 1)
      .unsigned_short(0x00280101, 1)
      .unsigned_short(0x00280102, 0)
      .unsigned_short(0x00280103, 0)
      .text(0x00282110, "CS", "00")
      .words(0x7fe00010, bits_of(labels, frames));
  write_bytes(file, set.file());
}

}  // namespace breast
