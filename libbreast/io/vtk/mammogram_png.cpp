// SPDX-License-Identifier: GPL-3.0-or-later
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cstdint>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/own_file.hpp"
#include "io/mammogram_file.hpp"
#include "io/picture_file.hpp"
#include "io/vtk/vtk_messages.hpp"
#include "projection/display.hpp"

namespace breast {

namespace {

// Rows from the top, `channels` values per pixel.
template <class T>
void write_png(const std::filesystem::path& file, const std::vector<T>& values, int width,
               int height, int channels) {
  vtkNew<vtkImageData> data;
  data->SetDimensions(width, height, 1);
  data->AllocateScalars(sizeof(T) == 1 ? VTK_UNSIGNED_CHAR : VTK_UNSIGNED_SHORT, channels);
  auto* pixels = static_cast<T*>(data->GetScalarPointer());
  const std::ptrdiff_t row_length = std::ptrdiff_t(width) * channels;
  for (int row = 0; row < height; ++row) {  // VTK's first row is the lowest
    const auto from = values.begin() + row * row_length;
    std::copy(from, from + row_length, pixels + (height - 1 - row) * row_length);
  }
  const VtkMessages messages;
  vtkNew<vtkPNGWriter> writer;
  writer->WriteToMemoryOn();
  writer->SetInputData(data);
  writer->Write();
  if (messages.error() || writer->GetErrorCode() != 0) {
    throw failed_error(file.string(), ": cannot be written (", messages.first(), ")");
  }
  vtkUnsignedCharArray* png = writer->GetResult();
  write_bytes(file, marked_png({reinterpret_cast<const char*>(png->GetPointer(0)),
                                std::size_t(png->GetNumberOfValues())}));
}

}  // namespace

void write_mammogram_png(const std::filesystem::path& file, const Mammogram& image) {
  const HungImage hung = hang(image);
  write_png(file, hung.grey, hung.width, hung.height, 1);
}

void write_picture_png(const std::filesystem::path& file, const ColourPicture& picture) {
  write_png(file, picture.rgb(), picture.width(), picture.height(), 3);
}

}  // namespace breast
