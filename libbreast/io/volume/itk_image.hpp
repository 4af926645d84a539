// Volume <-> itk::Image and the ImageIO for a file ending; private to io/volume.
#pragma once

#include <itkImage.h>
#include <itkImageIOBase.h>
#include <itkImportImageFilter.h>

#include <cstring>
#include <filesystem>
#include <string>

#include "image/volume.hpp"

namespace breast {

/// The ImageIO a file's ending asks for, or null when we do not know the ending.
itk::ImageIOBase::Pointer image_io_for(const std::filesystem::path& file);
/// The endings we know, for messages.
inline constexpr const char* known_endings = ".nrrd .nhdr .nii .nii.gz .mha .mhd";

/// One line out of ITK's many: the description without file, line and object address.
std::string one_line(const itk::ExceptionObject& exception);

/// Silences ITK's warnings and what its readers say on std::cerr for the life of the object.
class QuietItk {
 public:
  QuietItk();
  ~QuietItk();
  QuietItk(const QuietItk&) = delete;
  QuietItk& operator=(const QuietItk&) = delete;

 private:
  std::streambuf* previous_;
  bool warnings_;
};

template <class T>
Grid grid_of(const itk::Image<T, 3>& image) {
  Grid grid;
  const auto size = image.GetLargestPossibleRegion().GetSize();
  for (int d = 0; d < 3; ++d) {
    grid.size[d] = static_cast<int>(size[d]);
    grid.spacing[d] = image.GetSpacing()[d];
    grid.origin[d] = image.GetOrigin()[d];
    for (int e = 0; e < 3; ++e) grid.direction(d, e) = image.GetDirection()[d][e];
  }
  return grid;
}

template <class T>
void set_grid(itk::Image<T, 3>& image, const Grid& grid) {
  typename itk::Image<T, 3>::PointType origin;
  typename itk::Image<T, 3>::SpacingType spacing;
  typename itk::Image<T, 3>::DirectionType direction;
  typename itk::Image<T, 3>::SizeType size;
  for (int d = 0; d < 3; ++d) {
    size[d] = grid.size[d];
    spacing[d] = grid.spacing[d];
    origin[d] = grid.origin[d];
    for (int e = 0; e < 3; ++e) direction[d][e] = grid.direction(d, e);
  }
  image.SetRegions(typename itk::Image<T, 3>::RegionType(size));
  image.SetSpacing(spacing);
  image.SetOrigin(origin);
  image.SetDirection(direction);
}

template <class T>
typename itk::Image<T, 3>::Pointer to_itk(const Volume<T>& volume) {
  auto image = itk::Image<T, 3>::New();
  set_grid(*image, volume.grid);
  image->Allocate();
  std::memcpy(image->GetBufferPointer(), volume.voxels.data(), volume.voxels.size() * sizeof(T));
  return image;
}

template <class T>
Volume<T> from_itk(const itk::Image<T, 3>& image) {
  Volume<T> volume;
  volume.grid = grid_of(image);
  volume.voxels.assign(image.GetBufferPointer(), image.GetBufferPointer() + volume.grid.voxels());
  return volume;
}

}  // namespace breast
