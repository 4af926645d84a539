#include "io/volume/itk_image.hpp"

#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <algorithm>
#include <cctype>
#include <iostream>

namespace breast {

itk::ImageIOBase::Pointer image_io_for(const std::filesystem::path& file) {
  std::string name = file.filename().string();
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (name.ends_with(".nrrd") || name.ends_with(".nhdr")) {
    return itk::ImageIOBase::Pointer(itk::NrrdImageIO::New());
  }
  if (name.ends_with(".nii") || name.ends_with(".nii.gz")) {
    return itk::ImageIOBase::Pointer(itk::NiftiImageIO::New());
  }
  if (name.ends_with(".mha") || name.ends_with(".mhd")) {
    return itk::ImageIOBase::Pointer(itk::MetaImageIO::New());
  }
  return nullptr;
}

std::string one_line(const itk::ExceptionObject& exception) {
  std::string text = exception.GetDescription();
  // "itk::ERROR: NrrdImageIO(0x55...): what happened"
  const auto address = text.find("): ");
  if (text.starts_with("itk::ERROR") && address != std::string::npos) text.erase(0, address + 3);
  std::string line;
  for (const char c : text) {
    const bool blank = std::isspace(static_cast<unsigned char>(c)) != 0;
    if (blank && (line.empty() || line.back() == ' ')) continue;
    line += blank ? ' ' : c;
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line.substr(0, 200);
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

}  // namespace breast
