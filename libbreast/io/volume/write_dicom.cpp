#include <itkGDCMImageIO.h>
#include <itkImageFileWriter.h>
#include <itkMetaDataObject.h>
#include <unistd.h>

#include <cstdio>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/provenance.hpp"
#include "io/volume/itk_image.hpp"
#include "io/volume_file.hpp"

namespace breast {

namespace {

namespace fs = std::filesystem;

/// A UID from text: same input, same UID ("2.25." is the branch for such numbers, PS3.5 B.2).
std::string uid_from(const std::string& text) {
  Sha256 hash;
  hash.update(text);
  return "2.25." + std::to_string(std::stoull(hash.hex().substr(0, 15), nullptr, 16) + 1);
}

std::string vector_text(const Vec3& a) {
  char text[80];
  std::snprintf(text, sizeof text, "%.10g\\%.10g\\%.10g", a[0], a[1], a[2]);
  return text;
}

void set_tag(itk::MetaDataDictionary& tags, const char* tag, const std::string& value) {
  itk::EncapsulateMetaData<std::string>(tags, tag, value);
}

void write_slice(const fs::path& file, const Volume<std::int16_t>& volume, int k,
                 const std::string& description, const std::string& scan) {
  Volume<std::int16_t> slice;
  slice.grid = volume.grid;
  slice.grid.size[2] = 1;
  slice.grid.origin = volume.grid.to_patient(Vec3(0, 0, k));
  const auto first =
      volume.voxels.begin() + static_cast<std::ptrdiff_t>(volume.grid.offset(0, 0, k));
  slice.voxels.assign(first, first + static_cast<std::ptrdiff_t>(slice.grid.voxels()));

  auto io = itk::GDCMImageIO::New();
  io->KeepOriginalUIDOn();
  const auto image = to_itk(slice);
  auto& tags = image->GetMetaDataDictionary();
  const Mat3& axes = volume.grid.direction;
  set_tag(tags, "0008|0016", "1.2.840.10008.5.1.4.1.1.4");  // MR Image Storage
  set_tag(tags, "0008|0018", uid_from(scan + "/slice/" + std::to_string(k)));
  set_tag(tags, "0008|0060", "MR");
  set_tag(tags, "0008|103e", description);
  set_tag(tags, "0010|0010", "SIMULATED");
  set_tag(tags, "0010|0020", "SIMULATED");
  set_tag(tags, "0018|0050", message(volume.grid.spacing[2]));
  set_tag(tags, "0018|0088", message(volume.grid.spacing[2]));
  set_tag(tags, "0018|5100", "HFP");  // head first, prone
  set_tag(tags, "0020|000d", uid_from(scan + "/study"));
  set_tag(tags, "0020|000e", uid_from(scan + "/series"));
  set_tag(tags, "0020|0052", uid_from(scan + "/frame"));
  set_tag(tags, "0020|0011", "1");
  set_tag(tags, "0020|0013", std::to_string(k + 1));
  set_tag(tags, "0020|0032", vector_text(slice.grid.origin));
  set_tag(tags, "0020|0037", vector_text(axes.col(0)) + "\\" + vector_text(axes.col(1)));
  auto writer = itk::ImageFileWriter<itk::Image<std::int16_t, 3>>::New();
  writer->SetInput(image);
  writer->SetImageIO(io);
  writer->SetFileName(file.string());
  writer->Update();
}

/// Puts a finished folder in the place of an old one made by us (nothing but .dcm files in it).
void replace_folder(const fs::path& finished, const fs::path& target) {
  if (fs::exists(target)) {
    for (const auto& entry : fs::directory_iterator(target)) {
      if (entry.path().extension() == ".dcm") continue;
      throw input_error(target.string(), ": holds ", entry.path().filename().string(),
                        ", so it is not replaced: choose another folder");
    }
    const fs::path old = finished.string() + "-old";
    fs::rename(target, old);
    fs::rename(finished, target);
    fs::remove_all(old);
  } else {
    fs::rename(finished, target);
  }
}

}  // namespace

void write_dicom_series(const fs::path& folder, const Volume<std::int16_t>& volume,
                        const std::string& description) {
  const fs::path target = folder.has_filename() ? folder : folder.parent_path();
  if (volume.voxels.size() != volume.grid.voxels() || volume.voxels.empty()) {
    throw failed_error(target.string(), ": ", volume.voxels.size(), " voxels for a grid of ",
                       volume.grid.voxels());
  }
  Sha256 hash;
  hash.update(description);
  hash.update(volume.voxels.data(), volume.voxels.size() * sizeof(std::int16_t));
  const std::string scan = hash.hex();
  remove_stale_parts(target);
  const fs::path part = target.parent_path() /
                        ("." + target.filename().string() + ".part-" + std::to_string(getpid()));
  std::error_code ignored;
  try {
    const QuietItk quiet;
    fs::create_directories(part);
    for (int k = 0; k < volume.grid.size[2]; ++k) {
      char name[32];
      std::snprintf(name, sizeof name, "slice_%04d.dcm", k + 1);
      write_slice(part / name, volume, k, description, scan);
    }
    replace_folder(part, target);
  } catch (const itk::ExceptionObject& exception) {
    fs::remove_all(part, ignored);
    throw failed_error(target.string(), ": DICOM cannot be written: ", one_line(exception));
  } catch (const fs::filesystem_error& exception) {
    fs::remove_all(part, ignored);
    throw failed_error(target.string(), ": DICOM cannot be written: ", exception.code().message());
  } catch (...) {
    fs::remove_all(part, ignored);
    throw;
  }
}

}  // namespace breast
