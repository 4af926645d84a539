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
#include "io/vtk/vtk_messages.hpp"
#include "io/vtk/xml_check.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

template <class Reader, class Data>
vtkSmartPointer<Data> read_xml(const fs::path& file, const std::string& type) {
  const VtkMessages messages;
  check_xml(file, type);
  vtkNew<Reader> reader;
  reader->SetFileName(file.c_str());
  try {
    reader->Update();
  } catch (const std::exception& problem) {
    throw input_error(file.string(), ": damaged (", problem.what(), " while reading)");
  }
  if (messages.error() || reader->GetErrorCode() != 0) {
    const std::string reason = messages.first();
    throw input_error(file.string(), ": damaged (", reason.empty() ? "incomplete" : reason, ")");
  }
  vtkSmartPointer<Data> data = reader->GetOutput();
  return data;
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
  return read_xml<vtkXMLPolyDataReader, vtkPolyData>(file, "PolyData");
}

vtkSmartPointer<vtkImageData> read_image_data(const fs::path& file) {
  return read_xml<vtkXMLImageDataReader, vtkImageData>(file, "ImageData");
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
