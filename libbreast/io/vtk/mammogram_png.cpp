#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>

#include <algorithm>
#include <cstdint>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/mammogram_file.hpp"
#include "io/vtk/vtk_messages.hpp"
#include "mammo/display.hpp"

namespace breast {

void write_mammogram_png(const std::filesystem::path& file, const Mammogram& image) {
  const HungImage hung = hang(image);
  vtkNew<vtkImageData> data;
  data->SetDimensions(hung.width, hung.height, 1);
  data->AllocateScalars(VTK_UNSIGNED_SHORT, 1);
  auto* pixels = static_cast<std::uint16_t*>(data->GetScalarPointer());
  for (int row = 0; row < hung.height; ++row) {  // VTK's first row is the lowest
    const auto from = hung.grey.begin() + std::ptrdiff_t(row) * hung.width;
    std::copy(from, from + hung.width, pixels + std::ptrdiff_t(hung.height - 1 - row) * hung.width);
  }
  AtomicFile target(file);
  const VtkMessages messages;
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(target.temporary().c_str());
  writer->SetInputData(data);
  writer->Write();
  if (messages.error() || writer->GetErrorCode() != 0) {
    throw failed_error(file.string(), ": cannot be written (", messages.first(), ")");
  }
  target.commit();
}

}  // namespace breast
