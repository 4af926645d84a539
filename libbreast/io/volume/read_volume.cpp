#include <itkImageFileReader.h>

#include <cmath>

#include "core/error.hpp"
#include "core/provenance.hpp"
#include "core/temporary_folder.hpp"
#include "io/volume/complete.hpp"
#include "io/volume/dicom.hpp"
#include "io/volume/itk_image.hpp"
#include "io/volume_file.hpp"

namespace breast {

namespace {

namespace fs = std::filesystem;

void check_layout(const fs::path& file, const itk::ImageIOBase& io) {
  if (io.GetNumberOfComponents() != 1) {
    throw input_error(file.string(), ": ", io.GetNumberOfComponents(),
                      " components a voxel: a scalar (grey) volume is needed");
  }
  std::size_t voxels = 1;
  for (unsigned d = 0; d < io.GetNumberOfDimensions(); ++d) {
    const auto size = io.GetDimensions(d);
    if (size < 1 || (d > 2 && size != 1)) {
      throw input_error(file.string(), ": size ", size, " along axis ", d,
                        ": one 3-D volume is needed");
    }
    voxels *= size;
  }
  if (io.GetNumberOfDimensions() < 3) {
    throw input_error(file.string(), ": ", io.GetNumberOfDimensions(),
                      "-D image: a 3-D volume is needed");
  }
  constexpr std::size_t limit = std::size_t(1) << 30;
  if (voxels > limit) {
    throw input_error(file.string(), ": ", voxels, " voxels, more than ", limit, ": crop the scan");
  }
}

/// The file's name where it stands alone: NIfTI's reader takes the voxels from scan.nii when asked
/// for scan.nii.gz and both are there.
fs::path link_alone(const fs::path& file, const TemporaryFolder& folder) {
  const fs::path link = folder / (file.string().ends_with(".gz") ? "scan.nii.gz" : "scan.nii");
  fs::create_symlink(fs::absolute(file), link);
  return link;
}

Volume<float> read_with(const fs::path& file, const fs::path& opened, itk::ImageIOBase* io) {
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
  return from_itk(*reader->GetOutput());
}

Volume<float> read_single_file(const fs::path& file) {
  const auto io = image_io_for(file);
  if (!io) {
    throw input_error(file.string(), ": unknown ending; volumes are read from ", known_endings,
                      " or a DICOM folder");
  }
  check_complete(file);
  if (std::string(io->GetNameOfClass()) == "NiftiImageIO") {
    const TemporaryFolder folder;
    return read_with(file, link_alone(file, folder), io);
  }
  return read_with(file, file, io);
}

void check_grid(const fs::path& file, const Grid& grid) {
  for (int d = 0; d < 3; ++d) {
    if (!(grid.spacing[d] > 0 && grid.spacing[d] < 1e3)) {
      throw input_error(file.string(), ": voxel size ", grid.spacing[d], " mm along axis ", d,
                        ": must be positive and below 1000 mm");
    }
    if (!(std::abs(grid.origin[d]) < 1e5)) {
      throw input_error(file.string(), ": origin ", grid.origin[d], " mm: must be within 1e5 mm");
    }
  }
  if (!(std::abs(grid.direction.determinant()) > 0.1)) {
    throw input_error(file.string(), ": axis directions are degenerate (determinant ",
                      grid.direction.determinant(), ")");
  }
}

void check_finite(const fs::path& file, const Volume<float>& volume) {
  for (std::size_t n = 0; n < volume.voxels.size(); ++n) {
    if (std::isfinite(volume.voxels[n])) continue;
    const auto& size = volume.grid.size;
    throw input_error(file.string(), ": voxel (", n % size[0], ",", n / size[0] % size[1], ",",
                      n / size[0] / size[1], ") is ", volume.voxels[n], ": must be finite");
  }
}

/// SHA-256 of grid (rounded to what file formats keep: 1e-3 mm, 1e-4 in directions) and voxels.
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

Volume<float> read_folder(const fs::path& folder, int series, std::string& description) {
  const std::vector<DicomSeries> list = list_dicom_series(folder);
  if (list.empty()) throw input_error(folder.string(), ": no DICOM images in this folder");
  const int count = static_cast<int>(list.size());
  if (series > count || (series == 0 && count > 1)) {
    std::string text;
    for (int n = 0; n < count; ++n) text += message(n ? "; " : "", n + 1, " = ", list[n].label());
    throw input_error(folder.string(), ": ", count, " series, choose one with --series N: ", text);
  }
  const int chosen = series == 0 ? 1 : series;
  description = message("DICOM series ", chosen, ": ", list[chosen - 1].label());
  return read_dicom_series(folder, list[chosen - 1]);
}

}  // namespace

Volume<float> read_volume(const fs::path& file, int series, VolumeSource* source) {
  if (series < 0) throw input_error("series ", series, ": must be 1 or more (0 for the only one)");
  std::string description;
  Volume<float> volume;
  try {
    const QuietItk quiet;
    std::error_code none;
    if (fs::is_directory(file, none)) {
      volume = read_folder(file, series, description);
    } else if (!fs::is_regular_file(file, none)) {
      throw input_error(file.string(), ": no such file");
    } else {
      volume = read_single_file(file);
      description = file.extension().string().substr(1);
    }
  } catch (const itk::ExceptionObject& exception) {
    throw input_error(file.string(), ": cannot be read as a volume: ", one_line(exception));
  } catch (const std::bad_alloc&) {
    throw input_error(file.string(), ": the volume its header announces does not fit in memory");
  }
  check_grid(file, volume.grid);
  check_finite(file, volume);
  if (source) *source = {description, content_hash(volume)};
  return volume;
}

}  // namespace breast
