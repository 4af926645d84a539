// SPDX-License-Identifier: GPL-3.0-or-later
#include <itkImageFileReader.h>

#include <cmath>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "core/guarded_child.hpp"
#include "core/sha256.hpp"
#include "core/temporary_folder.hpp"
#include "core/text/lower_case.hpp"
#include "io/series/choice.hpp"
#include "io/volume/header.hpp"
#include "io/volume/itk_image.hpp"
#include "io/volume_file.hpp"

namespace breast {

namespace {

namespace fs = std::filesystem;

void check_layout(const fs::path& file, const itk::ImageIOBase& io) {
  if (io.GetNumberOfComponents() != 1) {
    throw input_error(file.string(), ": ", io.GetNumberOfComponents(),
                      " components per voxel: a scalar (grey-scale) volume is needed");
  }
  std::vector<double> sizes;
  double voxels = 1;
  for (unsigned d = 0; d < io.GetNumberOfDimensions(); ++d) {
    sizes.push_back(double(io.GetDimensions(d)));
    voxels *= sizes.back();
  }
  check_volume_sizes(file.string(), sizes);
  check_voxel_count(file.string(), voxels);
}

/// A link with the file's ending in small letters, the only ones that ITK knows; nothing when the file
/// may be opened as it is.
std::optional<fs::path> link_in_small_letters(const fs::path& file,
                                              std::optional<TemporaryFolder>& folder) {
  const std::string name = lower_case(file.filename().string());
  if (name == file.filename().string()) return std::nullopt;
  folder.emplace();
  const fs::path link = *folder / ("scan" + name.substr(name.rfind('.')));
  fs::create_symlink(fs::absolute(file), link);
  return link;
}

std::string read_with(const fs::path& file, const fs::path& opened, itk::ImageIOBase* io) {
  io->SetFileName(opened.string());
  if (!io->CanReadFile(opened.string().c_str())) {
    throw input_error(file.string(), ": not a readable volume (damaged header or foreign file)");
  }
  io->ReadImageInformation();
  check_layout(file, *io);
  auto reader = itk::ImageFileReader<itk::Image<float, 3>>::New();
  reader->SetImageIO(io);
  reader->SetFileName(opened.string());
  reader->Update();
  return packed_image(*reader->GetOutput());
}

Volume<float> read_single_file(const fs::path& file) {
  const std::string name = lower_case(file.filename().string());
  if (name.ends_with(".nii") || name.ends_with(".nii.gz")) return read_nifti(file);
  const auto io = image_io_for(file);
  if (!io) {
    throw input_error(file.string(), ": unknown file name extension; volumes are read from ",
                      known_endings, ", DICOM files or a folder of them; unpack archives first");
  }
  const bool meta = name.ends_with(".mha") || name.ends_with(".mhd");
  const Grid stated = meta ? meta_grid(file) : nrrd_grid(file);
  std::optional<TemporaryFolder> folder;
  const fs::path opened = link_in_small_letters(file, folder).value_or(file);
  const auto read = [&] { return read_with(file, opened, io); };
  Volume<float> volume =
      unpacked_image(in_guarded_child(file.string(), [&] { return guarded_itk(file, read); }));
  const auto size = volume.grid.size;
  volume.grid = stated;
  volume.grid.size = size;
  return volume;
}

void check_finite(const fs::path& file, const Volume<float>& volume) {
  for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
    if (std::isfinite(volume.voxels[n])) continue;
    const auto& size = volume.grid.size;
    throw input_error(file.string(), ": voxel (", n % size[0], ",", n / size[0] % size[1], ",",
                      n / size[0] / size[1], ") is ", volume.voxels[n],
                      ": must be finite; write 0 where nothing was measured");
  }
}

}  // namespace

std::string content_hash(const Volume<float>& volume) {
  Sha256 hash;
  const auto add = [&](double value, double unit) {
    const long long rounded = std::llround(value / unit);
    hash.update(&rounded, sizeof rounded);
  };
  for (int d = 0; d < 3; ++d) {
    add(volume.grid.size[d], 1);
    add(volume.grid.spacing[d], 1e-3);
    add(volume.grid.origin[d], 1e-3);
    for (int e = 0; e < 3; ++e) add(volume.grid.direction(d, e), 1e-4);
  }
  hash.update(volume.voxels.data(), volume.voxels.size() * sizeof(float));
  return hash.hex();
}

namespace {

/// Whether a file with an ending of no volume is DICOM: an enhanced object, or a slice.
bool is_dicom_file(const fs::path& file) {
  DicomObject object;
  return !is_volume_name(file) && read_dicom_object(file, object);
}

DicomReference reference_to(const DicomStack& stack) {
  const DicomImage& first = stack.first();
  DicomReference reference{
      first.study_uid, first.series_uid, first.frame_of_reference_uid, first.sop_class, {}};
  std::set<std::string> known;
  for (const DicomImage& slice : stack.slices)  // frames of one file have its UID
    if (!slice.instance_uid.empty() && known.insert(slice.instance_uid).second)
      reference.instance_uids.push_back(slice.instance_uid);
  return reference;
}

Volume<float> read_folder(const fs::path& folder, const ScanChoice& choice, VolumeSource& source) {
  ChosenStack chosen = chosen_stack(folder, choice);
  source.description = message("DICOM series ", chosen.number, ": ", chosen.stack.label());
  source.patient_position = chosen.stack.patient_position;
  source.patient_id = chosen.stack.first().patient_id;
  source.dicom = reference_to(chosen.stack);
  source.contrast = contrast_name(chosen.stack.first().contrast);
  source.remarks = std::move(chosen.remarks);
  return read_stack(chosen.stack);
}

}  // namespace

Volume<float> read_volume(const fs::path& file, const ScanChoice& choice, VolumeSource* source) {
  if (choice.series < 0) {
    throw input_error("series ", choice.series, ": must be 1 or more (0 for the best)");
  }
  VolumeSource found;
  Volume<float> volume;
  std::error_code none;
  if (fs::is_directory(file, none)) {
    volume = read_folder(file, choice, found);
  } else if (!fs::is_regular_file(file, none)) {
    throw input_error(file.string(), ": no such file");
  } else if (is_dicom_file(file)) {
    volume = read_folder(file, choice, found);
  } else {
    volume = read_single_file(file);
    found.description = file.extension().string().substr(1);
  }
  check_scan_grid(file.string(), volume.grid);
  check_finite(file, volume);
  if (!source) return volume;
  found.content_sha256 = content_hash(volume);
  *source = found;
  return volume;
}

Table list_series(const fs::path& folder, const ScanChoice& choice,
                  std::vector<std::string>& remarks) {
  std::error_code none;
  if (!fs::is_directory(folder, none) && !is_dicom_file(folder))
    throw input_error(folder.string(), ": is no folder of DICOM series");
  SeriesList list = list_stacks(folder, choice);
  remarks = std::move(list.remarks);
  return std::move(list.table);
}

}  // namespace breast
