// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/volume/itk_image.hpp"

#include <itkMetaImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <cstring>
#include <iostream>

#include "core/error.hpp"
#include "core/text/library_message.hpp"
#include "core/text/lower_case.hpp"

namespace breast {

itk::ImageIOBase::Pointer image_io_for(const std::filesystem::path& file) {
  const std::string name = lower_case(file.filename().string());
  if (name.ends_with(".nrrd") || name.ends_with(".nhdr")) {
    return itk::ImageIOBase::Pointer(itk::NrrdImageIO::New());
  }
  if (name.ends_with(".mha") || name.ends_with(".mhd")) {
    return itk::ImageIOBase::Pointer(itk::MetaImageIO::New());
  }
  return nullptr;
}

QuietItk::QuietItk()
    : previous_(std::cerr.rdbuf(nullptr)), warnings_(itk::Object::GetGlobalWarningDisplay()) {
  itk::Object::SetGlobalWarningDisplay(false);
}

QuietItk::~QuietItk() {
  std::cerr.rdbuf(previous_);
  std::cerr.clear();
  itk::Object::SetGlobalWarningDisplay(warnings_);
}

std::string guarded_itk(const std::filesystem::path& file,
                        const std::function<std::string()>& read) {
  const QuietItk quiet;
  try {
    return read();
  } catch (const itk::ExceptionObject& exception) {
    throw input_error(file.string(), ": cannot be read as a volume: ",
                      library_message(exception.GetDescription()));
  }
}

namespace {
constexpr std::size_t grid_numbers = 18;
}

std::string packed_image(const itk::Image<float, 3>& image) {
  double grid[grid_numbers];
  double* next = grid;
  const auto size = image.GetLargestPossibleRegion().GetSize();
  std::size_t voxels = 1;
  for (unsigned d = 0; d < 3; ++d) {
    *next++ = double(size[d]);
    *next++ = image.GetSpacing()[d];
    *next++ = image.GetOrigin()[d];
    for (unsigned e = 0; e < 3; ++e) *next++ = image.GetDirection()[d][e];
    voxels *= size[d];
  }
  std::string bytes;
  bytes.reserve(sizeof grid + voxels * sizeof(float));
  bytes.append(reinterpret_cast<const char*>(grid), sizeof grid);
  bytes.append(reinterpret_cast<const char*>(image.GetBufferPointer()), voxels * sizeof(float));
  return bytes;
}

Volume<float> unpacked_image(std::string_view bytes) {
  double numbers[grid_numbers] = {};
  std::memcpy(numbers, bytes.data(), std::min(bytes.size(), sizeof numbers));
  Volume<float> volume;
  const double* next = numbers;
  for (int d = 0; d < 3; ++d) {
    volume.grid.size[std::size_t(d)] = int(*next++);
    volume.grid.spacing[d] = *next++;
    volume.grid.origin[d] = *next++;
    for (int e = 0; e < 3; ++e) volume.grid.direction(d, e) = *next++;
  }
  const std::size_t voxels = volume.grid.voxels();
  if (bytes.size() != sizeof numbers + voxels * sizeof(float)) {
    throw failed_error("a packed image is cut");
  }
  volume.voxels.resize(voxels);
  std::memcpy(volume.voxels.data(), bytes.data() + sizeof numbers, voxels * sizeof(float));
  return volume;
}

}  // namespace breast
