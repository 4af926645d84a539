// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/vtk/xml_check.hpp"

#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>

#include <algorithm>
#include <initializer_list>
#include <string_view>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/sha256.hpp"
#include "io/vtk/array_check.hpp"

namespace breast {

namespace fs = std::filesystem;

namespace {

constexpr long long most_values = 2'000'000'000;

constexpr std::string_view closing = "</VTKFile>";
constexpr std::string_view seal_open = "<!-- sha256 of everything above: ";
constexpr std::string_view seal_close = " -->";

std::string sha_of(std::string_view text) {
  Sha256 hash;
  hash.update(text);
  return hash.hex();
}

// VTK's parser accepts a cut file up to a point and then reads what is not there, and
// follows damaged compression headers out of its buffers, so frame and seal are checked
// before VTK sees the file. Returns its text.
std::string check_frame(const fs::path& file, const std::string& type) {
  std::string text = read_text(file);
  const std::string_view head = std::string_view(text).substr(0, 4096);
  if (head.find("<VTKFile") == std::string_view::npos) {
    throw input_error(file.string(), ": not a VTK XML file (no <VTKFile> in its first 4096 bytes)");
  }
  if (head.find("type=\"" + type + "\"") == std::string_view::npos) {
    throw input_error(file.string(), ": a VTK file, but not of type ", type);
  }
  const auto end = text.rfind(closing);
  if (end == std::string::npos ||
      text.find_first_not_of(" \t\r\n", end + closing.size()) != std::string::npos) {
    throw input_error(file.string(), ": truncated (does not end with </VTKFile>, ", text.size(),
                      " bytes)");
  }
  const auto seal = text.rfind(seal_open);
  if (seal == std::string::npos) return text;  // another program's file
  const std::string rest = text.substr(seal + seal_open.size());
  const std::string expected = sha_of(std::string_view(text).substr(0, seal));
  if (rest.compare(0, 64, expected) != 0 || rest.compare(64, seal_close.size(), seal_close) != 0) {
    throw input_error(file.string(),
                      ": damaged or changed since it was written (its sha256 line does not "
                      "match; delete that line if the change was intended)");
  }
  return text;
}

bool one_of(const char* value, std::initializer_list<std::string_view> choices) {
  return value != nullptr &&
         std::find(choices.begin(), choices.end(), std::string_view(value)) != choices.end();
}

bool absent_or(const char* value, std::initializer_list<std::string_view> choices) {
  return value == nullptr || one_of(value, choices);
}

bool counts_ok(vtkXMLDataElement* element, std::initializer_list<const char*> names) {
  return std::all_of(names.begin(), names.end(), [element](const char* name) {
    const char* text = element->GetAttribute(name);
    if (text == nullptr) return true;
    char* end = nullptr;
    const long long value = std::strtoll(text, &end, 10);
    return end != text && *end == '\0' && value >= 0 && value <= most_values;
  });
}

bool root_ok(vtkXMLDataElement* root, const std::string& type) {
  return std::string_view(root->GetName()) == "VTKFile" &&
         one_of(root->GetAttribute("type"), {type}) &&
         root->FindNestedElementWithName(type.c_str()) != nullptr &&
         absent_or(root->GetAttribute("byte_order"), {"LittleEndian", "BigEndian"}) &&
         absent_or(root->GetAttribute("header_type"), {"UInt32", "UInt64"}) &&
         absent_or(root->GetAttribute("compressor"),
                   {"vtkZLibDataCompressor", "vtkLZ4DataCompressor", "vtkLZMADataCompressor"}) &&
         absent_or(root->GetAttribute("version"), {"0.1", "1.0", "2.0", "2.1", "2.2", "2.3"});
}

bool array_ok(vtkXMLDataElement* array, bool in_field_data) {
  return one_of(array->GetAttribute("type"),
                {"Int8", "UInt8", "Int16", "UInt16", "Int32", "UInt32", "Int64", "UInt64",
                 "Float32", "Float64", "String", "Bit"}) &&
         absent_or(array->GetAttribute("format"), {"binary", "ascii", "appended"}) &&
         (!in_field_data || array->GetAttribute("NumberOfTuples") != nullptr) &&
         counts_ok(array, {"NumberOfTuples", "NumberOfComponents"});
}

// Every array and piece below `element`; returns the name of the first bad element, or nothing.
std::string first_bad(vtkXMLDataElement* element, bool in_field_data) {
  for (int i = 0; i < element->GetNumberOfNestedElements(); ++i) {
    vtkXMLDataElement* child = element->GetNestedElement(i);
    const std::string name = child->GetName();
    const bool array = name == "DataArray" || name == "Array";
    if (array && !array_ok(child, in_field_data)) return name;
    if (in_field_data && !array) return name;
    if (name == "Piece" && !counts_ok(child, {"NumberOfPoints", "NumberOfVerts", "NumberOfLines",
                                              "NumberOfStrips", "NumberOfPolys"})) {
      return name;
    }
    if (array) continue;
    const std::string bad = first_bad(child, name == "FieldData");
    if (!bad.empty()) return bad;
  }
  return {};
}

}  // namespace

std::string sealed_xml(std::string text) {
  text.erase(text.rfind(closing));
  const std::string seal = sha_of(text);
  return text.append(seal_open).append(seal).append(seal_close).append("\n").append(closing) + "\n";
}

void check_xml(const fs::path& file, const std::string& type) {
  const std::string text = check_frame(file, type);
  vtkNew<vtkXMLDataParser> parser;
  parser->SetFileName(file.c_str());
  if (parser->Parse() != 1 || parser->GetRootElement() == nullptr) {
    throw input_error(file.string(), ": damaged (not well-formed XML)");
  }
  if (!root_ok(parser->GetRootElement(), type)) {
    throw input_error(file.string(), ": damaged (its VTKFile element does not belong to a ", type,
                      ")");
  }
  const std::string bad = first_bad(parser->GetRootElement(), false);
  if (!bad.empty()) {
    throw input_error(file.string(), ": damaged (a ", bad, " element has impossible attributes)");
  }
  const std::string wrong = impossible_array(parser->GetRootElement(), text);
  if (!wrong.empty()) throw input_error(file.string(), ": damaged (an array has ", wrong, ")");
}

}  // namespace breast
