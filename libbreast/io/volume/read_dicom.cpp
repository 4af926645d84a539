// SPDX-License-Identifier: GPL-3.0-or-later
#include <itkGDCMImageIO.h>
#include <itkImageSeriesReader.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include "core/error.hpp"
#include "core/guarded_child.hpp"
#include "core/statistics/percentile.hpp"
#include "io/dicom/header.hpp"
#include "io/volume/dicom.hpp"
#include "io/volume/header.hpp"
#include "io/volume/itk_image.hpp"

namespace breast {

namespace {

namespace fs = std::filesystem;

/// "a\b\c" as numbers; empty when the count or a number is wrong.
std::vector<double> dicom_numbers(const std::string& text, std::size_t count) {
  std::vector<double> values;
  std::istringstream in(text);
  for (std::string piece; std::getline(in, piece, '\\');) {
    char* end = nullptr;
    const double value = std::strtod(piece.c_str(), &end);
    if (end == piece.c_str() || !std::isfinite(value)) return {};
    values.push_back(value);
  }
  if (values.size() != count) values.clear();
  return values;
}

struct Slice {
  fs::path file;
  Vec3 position;
  double along = 0;  ///< mm along the slice normal
};

std::string text_of(const DicomHeader& header, const char* key) {
  const auto found = header.find(key);
  return found == header.end() ? std::string() : found->second;
}

/// Voxel size in the plane, mm; refuses what ITK would take for 1 mm.
Eigen::Vector2d pixel_spacing(const fs::path& file, const DicomHeader& header) {
  const auto values = dicom_numbers(text_of(header, "0028|0030"), 2);
  constexpr double least_mm = 0.01, most_mm = 50;
  for (std::size_t d = 0; d < values.size(); ++d) {
    if (values[d] >= least_mm && values[d] <= most_mm) continue;
    throw input_error(file.string(), ": pixel spacing ", values[d], " mm: must be ", least_mm,
                      " to ", most_mm, " mm");
  }
  if (values.empty()) throw input_error(file.string(), ": states no pixel spacing");
  return {values[0], values[1]};
}

/// Throws Error (input) for a slice of another modality than MR, of another patient than `first`, or
/// with a rescale slope that is not above 0. The message does not repeat the patient's name.
void check_origin(const fs::path& file, const DicomHeader& header, const DicomHeader& first) {
  const std::string modality = text_of(header, "0008|0060"), slope = text_of(header, "0028|1053");
  if (!modality.empty() && modality != "MR")
    throw input_error(file.string(), ": modality ", modality, ": slices of MR are needed");
  for (const char* key : {"0010|0020", "0010|0010"}) {
    if (text_of(header, key) != text_of(first, key))
      throw input_error(file.string(),
                        ": names another patient than the first slice of its series");
  }
  if (slope.empty()) return;
  const auto value = dicom_numbers(slope, 1);
  if (value.empty() || !(value[0] > 0))
    throw input_error(file.string(), ": rescale slope ", slope, ": must be above 0");
}

/// Grey values of 8 or 16 bits, one per pixel: what else there is makes GDCM abort, or is no MR.
void check_pixels(const fs::path& file, const DicomHeader& header) {
  const std::string bits = text_of(header, "0028|0100"), stored = text_of(header, "0028|0101");
  const std::string samples = text_of(header, "0028|0002"), kind = text_of(header, "0028|0004");
  if (bits != "8" && bits != "16") {
    throw input_error(file.string(), ": ", bits.empty() ? "no" : bits,
                      " bits allocated per pixel: 8 or 16 are supported");
  }
  const int depth = std::atoi(stored.c_str());
  if (!stored.empty() && !(depth >= 1 && depth <= std::atoi(bits.c_str()))) {
    throw input_error(file.string(), ": ", stored, " of ", bits, " bits stored per pixel");
  }
  if (!samples.empty() && samples != "1") {
    throw input_error(file.string(), ": ", samples,
                      " samples per pixel: grey-scale slices are needed");
  }
  if (kind != "MONOCHROME2") {
    throw input_error(file.string(), ": photometric interpretation '", kind,
                      "': MONOCHROME2 (grey scale, high values bright) is needed");
  }
}

/// Slices sorted along the normal; sets the in-plane directions.
std::vector<Slice> sorted_slices(const DicomSeries& series, Vec3& row, Vec3& column) {
  std::vector<Slice> slices;
  Eigen::Vector2d pixel(0, 0);
  DicomHeader first;
  for (const fs::path& file : series.files) {
    DicomHeader header;
    read_dicom_header(file, header);
    if (slices.empty()) first = header;
    check_origin(file, header, first);
    const auto position = dicom_numbers(header["0020|0032"], 3);
    const auto axes = dicom_numbers(header["0020|0037"], 6);
    if (position.empty() || axes.empty()) {
      throw input_error(file.string(),
                        ": no image position or orientation: not a slice of a volume");
    }
    check_pixels(file, header);
    check_voxel_count(file.string(), std::atof(header["0028|0010"].c_str()) *
                                         std::atof(header["0028|0011"].c_str()) *
                                         double(series.files.size()));
    const Eigen::Vector2d this_pixel = pixel_spacing(file, header);
    if (slices.empty()) pixel = this_pixel;
    if (!((this_pixel - pixel).cwiseAbs().maxCoeff() <= 1e-4 * pixel.maxCoeff())) {
      throw input_error(file.string(), ": pixel spacing ", this_pixel[0], " x ", this_pixel[1],
                        " mm, the rest of the series has ", pixel[0], " x ", pixel[1], " mm");
    }
    const Vec3 this_row(axes[0], axes[1], axes[2]), this_column(axes[3], axes[4], axes[5]);
    if (slices.empty()) {
      row = this_row.normalized();
      column = this_column.normalized();
      if (!(std::abs(row.dot(column)) <= 1e-3 && std::abs(this_row.norm() - 1) <= 1e-3 &&
            std::abs(this_column.norm() - 1) <= 1e-3)) {
        throw input_error(file.string(),
                          ": image axes are not perpendicular directions of length 1 (bound 1e-3)");
      }
    } else if (!((this_row - row).norm() < 1e-3 && (this_column - column).norm() < 1e-3)) {
      throw input_error(file.string(), ": slice orientation differs from the rest of the series");
    }
    slices.push_back({file, Vec3(position[0], position[1], position[2])});
  }
  const Vec3 normal = row.cross(column);
  for (Slice& slice : slices) slice.along = slice.position.dot(normal);
  std::sort(slices.begin(), slices.end(), [](const Slice& a, const Slice& b) {
    return a.along != b.along ? a.along < b.along : a.file < b.file;
  });
  return slices;
}

/// Median slice spacing (mm), which one missing slice does not move; refuses gaps, duplicates and
/// spacing that varies by more than 1 %.
double slice_spacing(const fs::path& folder, const std::vector<Slice>& slices) {
  std::vector<double> steps;
  for (std::size_t n = 1; n < slices.size(); ++n) {
    steps.push_back(slices[n].along - slices[n - 1].along);
  }
  const double usual = median(steps);
  if (!(slices.back().along - slices.front().along > 1e-3)) {
    throw input_error(folder.string(),
                      ": all slices lie at one position (several time points?): "
                      "give a folder with one volume");
  }
  for (std::size_t n = 1; n < slices.size(); ++n) {
    const double step = slices[n].along - slices[n - 1].along;
    if (!(std::abs(step - usual) <= 0.01 * usual)) {
      throw input_error(folder.string(), ": slices ", slices[n - 1].file.filename().string(),
                        " and ", slices[n].file.filename().string(), " are ", step,
                        " mm apart, the others ", usual,
                        " mm (bound 1 %): a slice is missing or duplicated");
    }
  }
  return usual;
}

/// Adds a slice's patient position to those of the slices before it: "HFP", or "HFP/HFS" if they differ.
void add_position(const std::string& own, std::string& all) {
  if (own.empty() || all.find(own) != std::string::npos) return;
  all += (all.empty() ? "" : "/") + own;
}

}  // namespace

std::string DicomSeries::label() const {
  return message(files.size(), " files of ", columns, " x ", rows, " pixels, series number ",
                 number);
}

std::vector<DicomSeries> list_dicom_series(const fs::path& folder) {
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    std::error_code unreachable;  // a link that leads nowhere, or to itself
    if (entry.is_regular_file(unreachable)) names.push_back(entry.path());
  }
  std::sort(names.begin(), names.end());
  // Series of one UID but several image sizes (localisers) are kept apart.
  std::map<std::string, DicomSeries> found;
  for (const fs::path& name : names) {
    if (name.filename() == "DICOMDIR") continue;
    DicomHeader header;
    if (!read_dicom_header(name, header)) {
      if (name.extension() != ".dcm") continue;
      throw input_error(name.string(), ": not a DICOM file (empty, truncated or foreign)");
    }
    DicomSeries& series =
        found[header["0020|000e"] + "/" + header["0028|0010"] + "x" + header["0028|0011"]];
    series.uid = header["0020|000e"];
    series.number = std::atoi(header["0020|0011"].c_str());
    series.columns = std::atoi(header["0028|0011"].c_str());
    series.rows = std::atoi(header["0028|0010"].c_str());
    add_position(header["0018|5100"], series.patient_position);
    series.files.push_back(name);
  }
  std::vector<DicomSeries> list;
  for (auto& [key, series] : found) list.push_back(std::move(series));
  std::stable_sort(list.begin(), list.end(),
                   [](const DicomSeries& a, const DicomSeries& b) { return a.number < b.number; });
  return list;
}

Volume<float> read_dicom_series(const fs::path& folder, const DicomSeries& series) {
  if (series.files.size() < 2) {
    throw input_error(folder.string(), ": series ", series.label(),
                      ": a volume needs at least 2 slices");
  }
  Vec3 row = Vec3::UnitX(), column = Vec3::UnitY();
  const std::vector<Slice> slices = sorted_slices(series, row, column);
  const double spacing = slice_spacing(folder, slices);

  std::vector<std::string> names;
  for (const Slice& slice : slices) names.push_back(slice.file.string());
  const auto read = [&] {
    auto reader = itk::ImageSeriesReader<itk::Image<float, 3>>::New();
    reader->SetImageIO(itk::GDCMImageIO::New());
    reader->SetFileNames(names);
    reader->Update();
    return packed_image(*reader->GetOutput());
  };
  Volume<float> volume =
      unpacked_image(in_guarded_child(folder.string(), [&] { return guarded_itk(folder, read); }));
  if (volume.grid.size[2] != static_cast<int>(slices.size())) {
    throw input_error(folder.string(), ": ", slices.size(), " files gave ", volume.grid.size[2],
                      " slices: multi-frame files are not supported");
  }
  // Geometry from all positions, not from the first two slices alone.
  const Vec3 step = (slices.back().position - slices.front().position) / double(slices.size() - 1);
  volume.grid.origin = slices.front().position;
  volume.grid.direction.col(0) = row;
  volume.grid.direction.col(1) = column;
  volume.grid.direction.col(2) =
      step.norm() < spacing * 1.0001 ? row.cross(column) : step.normalized();
  volume.grid.spacing[2] = step.norm();
  return volume;
}

}  // namespace breast
