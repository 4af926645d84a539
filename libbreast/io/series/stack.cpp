// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/series/stack.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "core/statistics/percentile.hpp"
#include "core/table.hpp"
#include "io/dicom/stored_values.hpp"
#include "io/series/split.hpp"
#include "io/volume/header.hpp"

namespace breast {

namespace {

/// Slices of one volume are of one patient and have one pixel spacing and orientation. The message
/// does not repeat the patient's name.
void check_alike(const std::vector<DicomImage>& slices) {
  const DicomImage& first = slices.front();
  for (const DicomImage& slice : slices) {
    if (!slice.fault.empty()) throw input_error(slice.fault);
    if (slice.patient_id != first.patient_id || slice.patient_name != first.patient_name)
      throw input_error(slice.file.string(),
                        ": names another patient than the first slice of its series");
    if (!((slice.pixel - first.pixel).cwiseAbs().maxCoeff() <= 1e-4 * first.pixel.maxCoeff())) {
      throw input_error(slice.file.string(), ": pixel spacing ", slice.pixel[0], " x ",
                        slice.pixel[1], " mm, the rest of the series has ", first.pixel[0], " x ",
                        first.pixel[1], " mm");
    }
    if (!((slice.row - first.row).norm() < 1e-3 && (slice.column - first.column).norm() < 1e-3))
      throw input_error(slice.file.string(),
                        ": slice orientation differs from the rest of the series");
  }
}

std::string name_of(const DicomImage& slice) {
  const std::string file = slice.file.filename().string();
  return slice.frame == 0 ? file : message(file, " (frame ", slice.frame + 1, ")");
}

/// Refuses gaps, duplicates, and slices that lie neither at equal steps (1 %) nor within 0.1 mm of equally
/// spaced places, as positions rounded to a tenth of a mm do.
void check_steps(const std::vector<DicomImage>& slices, const std::string& where) {
  constexpr double equal = 0.01, rounded_mm = 0.1, rounded_part = 0.2;
  const std::vector<double> at = places_of(slices);
  std::vector<double> steps;
  for (std::size_t n = 1; n < at.size(); ++n) steps.push_back(at[n] - at[n - 1]);
  const double usual = median(steps);  // which one missing slice does not move
  if (!(at.back() - at.front() > 1e-3)) {
    throw input_error(where,
                      ": all slices lie at one position, and nothing tells their images apart: "
                      "give a folder with one volume");
  }
  const double mean = (at.back() - at.front()) / double(steps.size());
  const bool even = std::abs(mean - usual) <= rounded_part * usual && [&] {
    for (std::size_t n = 0; n < at.size(); ++n) {
      const double off = std::abs(at[n] - at.front() - double(n) * mean);
      if (!(off <= std::min(rounded_mm, rounded_part * usual))) return false;
    }
    return true;
  }();
  for (std::size_t n = 0; n < steps.size(); ++n) {
    if (steps[n] > 1e-3) continue;
    throw input_error(where, ": slices ", name_of(slices[n]), " and ", name_of(slices[n + 1]),
                      " lie at one place and differ, and no time, kind or number divides their "
                      "series into volumes: a slice is missing or duplicated; remove one of them");
  }
  for (std::size_t n = 0; !even && n < steps.size(); ++n) {
    if (std::abs(steps[n] - usual) <= equal * usual) continue;
    throw input_error(where, ": slices ", name_of(slices[n]), " and ", name_of(slices[n + 1]),
                      " are ", steps[n], " mm apart, the others ", usual,
                      " mm (bound 1 %, or places within 0.1 mm): a slice is missing or duplicated, "
                      "or their positions are rounded");
  }
}

/// Refuses slices beside the line from the first to the last, which is the third axis of the volume. Coordinates
/// rounded to a tenth of a mm leave the end of a line by 0.09 mm at most, and so does the slice.
void check_straight(const std::vector<DicomImage>& slices, const std::string& where) {
  constexpr double bound_mm = 0.2;
  const std::vector<double> at = places_of(slices);
  const DicomImage &first = slices.front(), &last = slices.back();
  const Vec3 normal = first.row.cross(first.column).normalized();
  double most = 0;
  const DicomImage* farthest = nullptr;
  for (std::size_t n = 0; n < slices.size(); ++n) {
    const double part = (at[n] - at.front()) / (at.back() - at.front());
    const Vec3 off = slices[n].position - first.position - part * (last.position - first.position);
    const double beside = (off - off.dot(normal) * normal).norm();
    if (beside <= most) continue;
    most = beside;
    farthest = &slices[n];
  }
  if (most <= bound_mm) return;
  throw input_error(where, ": slice ", name_of(*farthest), " lies ", format_fixed(most, 1),
                    " mm beside the straight line from the first slice to the last (",
                    name_of(first), ", ", name_of(last), "; bound ", bound_mm,
                    " mm): they are no volume; give a folder with slices of one scan only");
}

void check_volume(const DicomStack& stack, const std::string& where) {
  const DicomImage& first = stack.first();
  check_alike(stack.slices);
  if (stack.slices.size() < 2) {
    throw input_error(where, ": series ", stack.label(),
                      ": a volume needs at least 2 slices: give the folder of all its files");
  }
  check_voxel_count(first.file.string(),
                    double(first.columns) * first.rows * double(stack.slices.size()));
  check_steps(stack.slices, where);
  check_straight(stack.slices, where);
}

/// The side that it shows if it is less wide than both: as stated, else by its place.
std::optional<Side> side_shown(const DicomStack& stack) {
  constexpr double least_both_mm = 230, off_midline_mm = 40;
  if (stack.side) return stack.side;
  const DicomImage& first = stack.first();
  const Vec3 extent = stack.extent();
  const Vec3 normal = first.row.cross(first.column);
  const double width = std::abs(first.row.x()) * extent[0] +
                       std::abs(first.column.x()) * extent[1] + std::abs(normal.x()) * extent[2];
  if (width >= least_both_mm) return std::nullopt;
  if (first.laterality == "L") return Side::left;
  if (first.laterality == "R") return Side::right;
  const Vec3 middle = 0.5 * (first.position + stack.slices.back().position + first.row * extent[0] +
                             first.column * extent[1]);
  if (middle.x() > off_midline_mm) return Side::left;
  if (middle.x() < -off_midline_mm) return Side::right;
  return std::nullopt;
}

void finish(DicomStack& stack, const std::string& where) {
  std::set<std::filesystem::path> files;
  for (const DicomImage& slice : stack.slices) {
    files.insert(slice.file);
    const std::string& own = slice.patient_position;
    std::string& all = stack.patient_position;
    if (!own.empty() && all.find(own) == std::string::npos) all += (all.empty() ? "" : "/") + own;
  }
  stack.files = int(files.size());
  try {
    check_volume(stack, where);
    stack.side = side_shown(stack);
  } catch (const Error& error) {
    stack.fault = error.what();
  }
}

bool is_projection(const DicomImage& image) {
  return image.contrast == ScanContrast::projection;
}

/// What tells an image of a series from the others, but for its pixels.
std::string identity_of(const DicomImage& image) {
  constexpr double same_place_mm = 1e-3;
  std::string text = message(image.instance_number, "/", image.frame);
  for (const double at : image.position) text += message("/", std::llround(at / same_place_mm));
  for (const std::string& mark : image.marks) text += "/" + mark;
  return text;
}

/// In whatever transfer syntax; false for pixels that cannot be decoded.
bool same_pixels(const std::filesystem::path& a, const std::filesystem::path& b) {
  try {
    DicomObject one, other;
    return read_dicom_object(a, one) && read_dicom_object(b, other) && one.pixels && other.pixels &&
           guarded_values(a, one) == guarded_values(b, other);
  } catch (const Error&) {
    return false;
  }
}

/// Takes out the images that another one repeats, as where an archive holds a series twice, under new UIDs or
/// in two transfer syntaxes.
void drop_repeats(DicomStack& stack) {
  using Path = std::filesystem::path;
  std::map<std::string, std::vector<Path>> seen;
  std::map<std::pair<Path, Path>, bool> same;
  std::erase_if(stack.slices, [&](const DicomImage& image) {
    std::vector<Path>& files = seen[identity_of(image)];
    const bool repeated = std::any_of(files.begin(), files.end(), [&](const Path& file) {
      if (file == image.file) return false;
      const auto [known, is_new] = same.try_emplace({file, image.file}, false);
      if (is_new) known->second = same_pixels(file, image.file);
      return known->second;
    });
    if (!repeated) files.push_back(image.file);
    stack.repeats += repeated;
    return repeated;
  });
}

/// Images of one series, size and orientation. Those of a localiser, in several orientations, have one
/// UID. Projections of a scan, which may be among its images, are no slices of it.
std::vector<DicomStack> by_series(std::vector<DicomImage> images) {
  constexpr double one_orientation = 0.1;  // of the unit vectors
  std::map<std::pair<int, std::string>, std::vector<DicomStack>> series;
  for (DicomImage& image : images) {
    auto& stacks = series[{image.series_number,
                           message(image.series_uid, "/", image.rows, "x", image.columns)}];
    const auto alike = [&](const DicomStack& stack) {
      const DicomImage& first = stack.first();
      return is_projection(first) == is_projection(image) && first.foreign == image.foreign &&
             (first.row - image.row).norm() < one_orientation &&
             (first.column - image.column).norm() < one_orientation;
    };
    // An image whose place is unknown belongs to its series, which is then no volume.
    auto own = std::find_if(stacks.begin(), stacks.end(), alike);
    if (own == stacks.end() && !stacks.empty() && !image.fault.empty() && !image.foreign)
      own = stacks.begin();
    if (own == stacks.end()) own = stacks.insert(stacks.end(), DicomStack());
    own->slices.push_back(std::move(image));
  }
  std::vector<DicomStack> list;
  for (auto& [key, stacks] : series) {
    for (DicomStack& stack : stacks) list.push_back(std::move(stack));
  }
  return list;
}

}  // namespace

double DicomStack::thickness() const {
  if (slices.size() < 2) return 0;
  return (slices.back().position - slices.front().position).norm() / double(slices.size() - 1);
}

Vec3 DicomStack::extent() const {
  return {first().columns * first().pixel[1], first().rows * first().pixel[0],
          double(slices.size()) * thickness()};
}

std::string DicomStack::label() const {
  std::string text = files == int(slices.size()) ? message(files, files == 1 ? " file" : " files")
                                                 : message(slices.size(), " frames in ", files,
                                                           files == 1 ? " file" : " files");
  text += message(" of ", first().columns, " x ", first().rows, " pixels, series number ",
                  first().series_number);
  if (times > 1) text += message(", time point ", time, " of ", times);
  if (kinds > 1)
    text += message(", ", contrast_name(first().contrast), " (kind ", kind, " of ", kinds, ")");
  if (of_side) text += message(", ", side_name(*side), " slab");
  return text;
}

std::vector<DicomStack> stacks_of(std::vector<DicomImage> images, const std::string& where) {
  std::vector<DicomStack> list;
  for (DicomStack& series : by_series(std::move(images))) {
    const bool sound = std::all_of(series.slices.begin(), series.slices.end(),
                                   [](const DicomImage& image) { return image.fault.empty(); });
    if (!sound) {
      list.push_back(std::move(series));
      continue;
    }
    drop_repeats(series);
    const int repeats = std::exchange(series.repeats, 0);
    const std::size_t first_part = list.size();
    for (DicomStack& part : by_time_and_kind(std::move(series))) {
      for (DicomStack& slab : by_slab(std::move(part))) list.push_back(std::move(slab));
    }
    list[first_part].repeats = repeats;
  }
  for (DicomStack& stack : list) finish(stack, where);
  return list;
}

}  // namespace breast
