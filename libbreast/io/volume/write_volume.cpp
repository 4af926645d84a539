#include <itkImageFileWriter.h>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/volume/itk_image.hpp"
#include "io/volume_file.hpp"

namespace breast {

namespace {

/// ITK checks the ending even with a given ImageIO, so the hidden temporary first carries the
/// ending; remove_stale_parts finds it by its prefix.
template <class T>
void write_any(const std::filesystem::path& file, const Volume<T>& volume) {
  const auto io = image_io_for(file);
  const std::string ending = file.extension().string();
  if (!io || ending == ".nhdr" || ending == ".mhd") {
    throw input_error(file.string(), ": volumes are written as .nrrd, .nii, .nii.gz or .mha");
  }
  if (volume.voxels.size() != volume.grid.voxels() || volume.voxels.empty()) {
    throw failed_error(file.string(), ": ", volume.voxels.size(), " voxels for a grid of ",
                       volume.grid.voxels());
  }
  AtomicFile target(file);
  const std::filesystem::path named =
      target.temporary().string() + (file.string().ends_with(".nii.gz") ? ".nii.gz" : ending);
  try {
    const QuietItk quiet;
    auto writer = itk::ImageFileWriter<itk::Image<T, 3>>::New();
    writer->SetInput(to_itk(volume));
    writer->SetImageIO(io);
    writer->SetUseCompression(ending == ".nrrd" || ending == ".gz");
    writer->SetFileName(named.string());
    writer->Update();
    std::filesystem::rename(named, target.temporary());
  } catch (const std::exception& exception) {
    std::error_code ignored;
    std::filesystem::remove(named, ignored);
    const auto* itk_exception = dynamic_cast<const itk::ExceptionObject*>(&exception);
    throw failed_error(file.string(), ": cannot be written: ",
                       itk_exception ? one_line(*itk_exception) : exception.what());
  }
  target.commit();
}

}  // namespace

void write_volume(const std::filesystem::path& file, const Volume<float>& volume) {
  write_any(file, volume);
}
void write_volume(const std::filesystem::path& file, const Volume<std::uint8_t>& volume) {
  write_any(file, volume);
}
void write_volume(const std::filesystem::path& file, const Volume<std::int16_t>& volume) {
  write_any(file, volume);
}

}  // namespace breast
