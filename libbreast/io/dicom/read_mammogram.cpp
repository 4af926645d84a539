// SPDX-License-Identifier: GPL-3.0-or-later
#include <gdcmAttribute.h>
#include <gdcmImageReader.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "core/error.hpp"
#include "core/guarded_child.hpp"
#include "io/dicom/mammogram_header.hpp"
#include "io/mammogram_dicom.hpp"

namespace breast {

namespace {

template <class T>
std::vector<float> values_of(const std::vector<char>& bytes) {
  std::vector<float> values(bytes.size() / sizeof(T));
  for (std::size_t i = 0; i < values.size(); ++i) {
    T value;
    std::memcpy(&value, bytes.data() + i * sizeof(T), sizeof(T));
    values[i] = float(value);
  }
  return values;
}

std::vector<float> stored_values(const gdcm::Image& image, const std::vector<char>& bytes,
                                 const std::string& where) {
  const gdcm::PixelFormat format = image.GetPixelFormat();
  if (format == gdcm::PixelFormat::UINT8) return values_of<std::uint8_t>(bytes);
  if (format == gdcm::PixelFormat::UINT16 || format == gdcm::PixelFormat::UINT12) {
    return values_of<std::uint16_t>(bytes);
  }
  if (format == gdcm::PixelFormat::INT16 || format == gdcm::PixelFormat::INT12) {
    return values_of<std::int16_t>(bytes);
  }
  throw input_error(where, ": pixels are ", format.GetScalarTypeAsString(),
                    "; 8 or 16 bit grey values are expected");
}

// The pixels through GDCM, which can abort on what is damaged or unusual: one byte, 1 when bright is
// low, then the stored values as float.
std::string decoded(const std::string& where) {
  gdcm::ImageReader reader;
  reader.SetFileName(where.c_str());
  if (!reader.Read()) throw input_error(where, ": its pixels cannot be read");
  const gdcm::Image& image = reader.GetImage();
  const bool inverted =
      image.GetPhotometricInterpretation() == gdcm::PhotometricInterpretation::MONOCHROME1;
  if (!inverted &&
      image.GetPhotometricInterpretation() != gdcm::PhotometricInterpretation::MONOCHROME2) {
    throw input_error(where, ": a colour image; a grey mammogram is expected");
  }
  if (image.GetNumberOfDimensions() != 2 && image.GetDimension(2) != 1) {
    throw input_error(where, ": ", image.GetDimension(2), " frames; one is expected");
  }
  std::vector<char> bytes(image.GetBufferLength());
  if (!image.GetBuffer(bytes.data())) throw input_error(where, ": its pixels cannot be decoded");
  const std::vector<float> grey = stored_values(image, bytes, where);
  return std::string(1, inverted ? 1 : 0)
      .append(reinterpret_cast<const char*>(grey.data()), grey.size() * sizeof(float));
}

}  // namespace

MammogramScan read_mammogram_dicom(const std::filesystem::path& file) {
  MammogramScan scan;
  scan.header = read_mammogram_header(file);
  const std::string where = file.string();
  const std::string packed = in_guarded_child(where, [&] { return decoded(where); });
  const bool inverted = packed.at(0) != 0;
  scan.grey = values_of<float>({packed.begin() + 1, packed.end()});
  const std::size_t pixels = std::size_t(scan.header.columns) * std::size_t(scan.header.rows);
  if (scan.grey.size() != pixels || pixels == 0) {
    throw input_error(where, ": ", scan.grey.size(), " pixel values for ", scan.header.columns,
                      " x ", scan.header.rows);
  }
  const auto [low, high] = std::minmax_element(scan.grey.begin(), scan.grey.end());
  const float first = *low, range = *high - *low;
  if (!(range > 0)) throw input_error(where, ": every pixel is ", first);
  for (float& value : scan.grey) {
    value = (value - first) / range;
    if (inverted) value = 1 - value;
  }
  return scan;
}

}  // namespace breast
