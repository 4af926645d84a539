// SPDX-License-Identifier: GPL-3.0-or-later
// Functions common to all VTK XML files of libbreast: opening, checking, field data, writing.
#pragma once

#include <vtkSmartPointer.h>

#include <filesystem>
#include <string>
#include <vector>

#include "core/guarded_child.hpp"
#include "core/provenance.hpp"
#include "core/types.hpp"

class vtkDataArray;
class vtkDataObject;
class vtkDataSetAttributes;
class vtkFieldData;
class vtkImageData;
class vtkPolyData;
class vtkUnstructuredGrid;

namespace breast {

/// Reads a .vtp / .vti. Throws Error (input) for missing, truncated, foreign or damaged files.
vtkSmartPointer<vtkPolyData> read_poly_data(const std::filesystem::path& file);
vtkSmartPointer<vtkImageData> read_image_data(const std::filesystem::path& file);
/// Runs `read`, which opens `file` through VTK, first in a child process: VTK's readers follow
/// damaged lengths out of their buffers, and a crash of the child becomes a one-line error here.
template <class Read>
auto read_guarded(const std::filesystem::path& file, const Read& read) {
  in_guarded_child(file.string(), [&] {
    read();
    return std::string();
  });
  return read();
}
/// Writes atomically, with zlib compression and inline base64, so that a truncated file is never
/// well-formed XML.
void write_xml(const std::filesystem::path& file, vtkPolyData* data);
void write_xml(const std::filesystem::path& file, vtkImageData* data);
void write_xml(const std::filesystem::path& file, vtkUnstructuredGrid* data);

void add_text(vtkFieldData* fields, const std::string& name, const std::string& text);
/// "SPACE" = "LPS", by which 3D Slicer knows the coordinate system of a mesh file.
void add_space(vtkFieldData* fields);
void add_numbers(vtkFieldData* fields, const std::string& name, const std::vector<double>& values);
void add_history(vtkFieldData* fields, const History& history);

/// Text of a field. The message of the Error (input) thrown if the field is absent or not as
/// expected begins with `where`.
std::string text_field(vtkFieldData* fields, const std::string& name, const std::string& where);
std::vector<double> number_field(vtkFieldData* fields, const std::string& name, int count,
                                 const std::string& where);
/// The history of the file; empty if it has none (another program's file).
History history_field(vtkFieldData* fields, const std::string& where);
/// Refuses a file of libbreast with another schema; a file of another program without a schema
/// passes if `required` is false.
void check_schema(vtkFieldData* fields, const std::string& schema, bool required,
                  const std::string& where);

/// All components as doubles, tuple-major; throws Error (input) at the first non-finite value.
std::vector<double> finite_values(vtkDataArray* array, const std::string& where);

}  // namespace breast
