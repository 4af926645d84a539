// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/vtk/xml_file.hpp"

#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataReader.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/guarded_child.hpp"
#include "io/vtk/vtk_messages.hpp"
#include "io/vtk/xml_check.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

template <class Reader>
auto output_of(Reader* reader, const fs::path& file) {
  const VtkMessages messages;
  try {
    reader->Update();
  } catch (const std::exception& problem) {
    throw input_error(file.string(), ": damaged (", problem.what(), " while reading)");
  }
  if (messages.error() || reader->GetErrorCode() != 0) {
    const std::string reason = messages.first();
    throw input_error(file.string(), ": damaged (", reason.empty() ? "incomplete" : reason, ")");
  }
  return vtkSmartPointer(reader->GetOutput());
}

// VTK follows what a damaged file states out of its buffers. So a child process reads it, and this one reads what the
// child wrote of it: as it stands in memory, neither compressed nor checked again.
template <class Reader, class Writer>
auto read_xml(const fs::path& file, const std::string& type) {
  constexpr double seconds = 300, least_mb = 512,
                   mb_a_byte = 64e-6;  // arrays of one value compress a thousandfold
  std::error_code unknown;
  const double size = double(fs::file_size(file, unknown));
  const auto work = [&] {
    check_xml(file, type);
    vtkNew<Reader> reader;
    reader->SetFileName(file.c_str());
    const auto data = output_of(reader.Get(), file);
    const VtkMessages messages;
    vtkNew<Writer> writer;
    writer->WriteToOutputStringOn();
    writer->SetInputData(data);
    writer->SetDataModeToAppended();
    writer->EncodeAppendedDataOff();
    writer->SetCompressorTypeToNone();
    writer->SetHeaderTypeToUInt64();
    if (writer->Write() != 1 || messages.error()) {
      throw input_error(file.string(), ": damaged (", messages.first(), ")");
    }
    return std::string(writer->GetOutputString());
  };
  const std::string clean =
      in_guarded_child(file.string(), work, seconds, least_mb + (unknown ? 0 : size * mb_a_byte));
  vtkNew<Reader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(clean);
  return output_of(reader.Get(), file);
}

/// zlib's levels; on pixels of float a higher one takes seconds and saves little.
constexpr int geometry_compression = 5, image_compression = 1;

template <class Writer, class Data>
void write(const fs::path& file, Data* data, int compression) {
  const VtkMessages messages;
  vtkNew<Writer> writer;
  writer->WriteToOutputStringOn();  // VTK crashes when a disk is full: it never sees one
  writer->SetInputData(data);
  writer->SetDataModeToBinary();
  writer->SetCompressorTypeToZLib();
  writer->SetCompressionLevel(compression);
  const bool written = writer->Write() == 1;
  if (!written || messages.error() || writer->GetErrorCode() != 0) {
    throw failed_error(file.string(), ": cannot be written (", messages.first(), ")");
  }
  write_bytes(file, sealed_xml(writer->GetOutputString()));
}

}  // namespace

vtkSmartPointer<vtkPolyData> read_poly_data(const fs::path& file) {
  return read_xml<vtkXMLPolyDataReader, vtkXMLPolyDataWriter>(file, "PolyData");
}

vtkSmartPointer<vtkImageData> read_image_data(const fs::path& file) {
  return read_xml<vtkXMLImageDataReader, vtkXMLImageDataWriter>(file, "ImageData");
}

void write_xml(const fs::path& file, vtkPolyData* data) {
  write<vtkXMLPolyDataWriter>(file, data, geometry_compression);
}

void write_xml(const fs::path& file, vtkImageData* data) {
  write<vtkXMLImageDataWriter>(file, data, image_compression);
}

void write_xml(const fs::path& file, vtkUnstructuredGrid* data) {
  write<vtkXMLUnstructuredGridWriter>(file, data, geometry_compression);
}

}  // namespace breast
