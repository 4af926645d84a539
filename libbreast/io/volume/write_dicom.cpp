// SPDX-License-Identifier: GPL-3.0-or-later
#include <unistd.h>

#include <cstdio>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/own_file.hpp"
#include "core/sha256.hpp"
#include "io/dicom/simulated_study.hpp"
#include "io/volume_file.hpp"

namespace breast {

namespace {

namespace fs = std::filesystem;

void add_identity(DatasetBuilder& set, int k, const std::string& description,
                  const std::string& scan) {
  set.text(0x00080005, "CS", "ISO_IR 192")
      .text(0x00080008, "CS", "DERIVED\\PRIMARY\\OTHER")
      .text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.4")  // MR Image Storage
      .text(0x00080018, "UI", uid_from(scan + "/slice/" + std::to_string(k)))
      .text(0x0008103e, "LO", description)
      .text(0x00200052, "UI", uid_from(scan + "/frame"))
      .text(0x00201040, "LO", "");
  add_study(set, {"MR", "SIMULATED", scan, k + 1});
}

void add_geometry(DatasetBuilder& set, const Grid& grid, int k) {
  const Vec3& spacing = grid.spacing;
  char pixel[40];
  std::snprintf(pixel, sizeof pixel, "%.10g\\%.10g", spacing[1], spacing[0]);  // rows, then columns
  set.text(0x00180020, "CS", "SE")
      .text(0x00180021, "CS", "NONE")
      .text(0x00180022, "CS", "")
      .text(0x00180023, "CS", "3D")
      .number(0x00180050, spacing[2])
      .text(0x00180080, "DS", "")
      .text(0x00180081, "DS", "")
      .number(0x00180088, spacing[2])
      .text(0x00180091, "IS", "")
      .text(0x00185100, "CS", "HFP")  // head first, prone
      .text(0x00200032, "DS", vector_text(grid.to_patient(Vec3(0, 0, k))))
      .text(0x00200037, "DS",
            vector_text(grid.direction.col(0)) + "\\" + vector_text(grid.direction.col(1)))
      .text(0x00280030, "DS", pixel);
}

std::string slice_bytes(const Volume<std::int16_t>& volume, int k, const std::string& description,
                        const std::string& scan) {
  const Grid& grid = volume.grid;
  const std::size_t pixels = std::size_t(grid.size[0]) * std::size_t(grid.size[1]);
  const std::int16_t* first = volume.voxels.data() + grid.offset(0, 0, k);
  DatasetBuilder set;
  add_identity(set, k, description, scan);
  add_geometry(set, grid, k);
  set.grey_layout(grid.size[0], grid.size[1], 16, true)
      .words(0x7fe00010, {reinterpret_cast<const char*>(first), pixels * sizeof *first});
  return set.file();
}

}  // namespace

void check_dicom_folder(const fs::path& folder) {
  std::error_code absent;
  for (const auto& entry : fs::directory_iterator(folder, absent)) {
    const fs::path& file = entry.path();
    if (entry.is_regular_file() && file.extension() == ".dcm" && written_by_us(file)) continue;
    throw input_error(folder.string(), ": holds ", file.filename().string(),
                      ", which is not a simulated slice of libbreast and is not replaced: "
                      "choose another folder");
  }
}

void write_dicom_series(const fs::path& folder, const Volume<std::int16_t>& volume,
                        const std::string& description) {
  const fs::path target = folder.has_filename() ? folder : folder.parent_path();
  if (volume.voxels.size() != volume.grid.voxels() || volume.voxels.empty()) {
    throw failed_error(target.string(), ": ", volume.voxels.size(), " voxels for a grid of ",
                       volume.grid.voxels());
  }
  if (volume.grid.size[0] > 65535 || volume.grid.size[1] > 65535) {
    throw input_error(target.string(), ": ", volume.grid.size[0], " x ", volume.grid.size[1],
                      " pixels, but DICOM allows at most 65535 along a side");
  }
  check_dicom_folder(target);
  Sha256 hash;
  hash.update(description);
  hash.update(volume.voxels.data(), volume.voxels.size() * sizeof(std::int16_t));
  const std::string scan = hash.hex();
  remove_stale_parts(target);
  const fs::path part = target.parent_path() /
                        ("." + target.filename().string() + ".part-" + std::to_string(getpid()));
  std::error_code ignored;
  try {
    fs::create_directories(part);
    for (int k = 0; k < volume.grid.size[2]; ++k) {
      char name[32];
      std::snprintf(name, sizeof name, "slice_%04d.dcm", k + 1);
      write_bytes(part / name, slice_bytes(volume, k, description, scan));
    }
    check_dicom_folder(target);  // again: minutes may have passed
    replace_folder(part, target);
  } catch (const fs::filesystem_error& exception) {
    fs::remove_all(part, ignored);
    throw failed_error(target.string(), ": DICOM cannot be written: ", exception.code().message());
  } catch (...) {
    fs::remove_all(part, ignored);
    throw;
  }
}

}  // namespace breast
