// SPDX-License-Identifier: GPL-3.0-or-later
// Conversion of itk::Image to Volume, and choice of the ImageIO by file extension; private to
// io/volume.
#pragma once

#include <itkImage.h>
#include <itkImageIOBase.h>

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "image/volume.hpp"

namespace breast {

/// The ImageIO for a file's extension, or null for one that ITK does not read here.
itk::ImageIOBase::Pointer image_io_for(const std::filesystem::path& file);
/// The known file extensions, for messages.
inline constexpr const char* known_endings = ".nrrd .nhdr .nii .nii.gz .mha .mhd";

/// Silences ITK's warnings and the output of its readers on std::cerr while the object exists.
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

/// Runs `read`, which uses ITK, and turns ITK's exceptions into Error (input) about `file`.
std::string guarded_itk(const std::filesystem::path& file,
                        const std::function<std::string()>& read);

/// Conversion of an image to bytes and back to a volume, for the transfer from a reading child
/// process.
std::string packed_image(const itk::Image<float, 3>& image);
Volume<float> unpacked_image(std::string_view bytes);

}  // namespace breast
