// SPDX-License-Identifier: GPL-3.0-or-later
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "io/vtk/xml_file.hpp"

namespace breast {

using nlohmann::json;

void add_text(vtkFieldData* fields, const std::string& name, const std::string& text) {
  vtkNew<vtkStringArray> array;
  array->SetName(name.c_str());
  array->InsertNextValue(text);
  fields->AddArray(array);
}

void add_space(vtkFieldData* fields) {
  add_text(fields, "SPACE", "LPS");
}

void add_numbers(vtkFieldData* fields, const std::string& name, const std::vector<double>& values) {
  vtkNew<vtkDoubleArray> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(int(values.size()));
  array->InsertNextTuple(values.data());
  fields->AddArray(array);
}

void add_history(vtkFieldData* fields, const History& history) {
  vtkNew<vtkStringArray> array;
  array->SetName("history");
  for (const HistoryEntry& entry : history) {
    json inputs = json::array();
    for (const InputRecord& input : entry.inputs) {
      inputs.push_back({{"name", input.name}, {"sha256", input.sha256}});
    }
    const json text = {{"tool", entry.tool},
                       {"version", entry.version},
                       {"command", entry.command},
                       {"inputs", inputs}};
    array->InsertNextValue(text.dump(-1, ' ', true, json::error_handler_t::replace));
  }
  fields->AddArray(array);
}

std::string text_field(vtkFieldData* fields, const std::string& name, const std::string& where) {
  auto* array = vtkStringArray::SafeDownCast(fields->GetAbstractArray(name.c_str()));
  if (array == nullptr || array->GetNumberOfValues() != 1) {
    throw input_error(where, ": FieldData ", name, " is missing or not one text");
  }
  return array->GetValue(0);
}

std::vector<double> number_field(vtkFieldData* fields, const std::string& name, int count,
                                 const std::string& where) {
  vtkDataArray* array = fields->GetArray(name.c_str());
  if (array == nullptr || array->GetNumberOfValues() != count) {
    throw input_error(where, ": FieldData ", name, " is missing or not ", count, " number(s)");
  }
  return finite_values(array, where + ": FieldData " + name);
}

History history_field(vtkFieldData* fields, const std::string& where) {
  History history;
  vtkAbstractArray* present = fields->GetAbstractArray("history");
  if (present == nullptr) return history;
  auto* array = vtkStringArray::SafeDownCast(present);
  if (array == nullptr) throw input_error(where, ": FieldData history is not text");
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i) {
    try {
      const json text = json::parse(std::string(array->GetValue(i)));
      HistoryEntry entry{text.at("tool"), text.at("version"), text.at("command"), {}};
      for (const json& input : text.at("inputs")) {
        entry.inputs.push_back({input.at("name"), input.at("sha256")});
      }
      history.push_back(entry);
    } catch (const json::exception&) {
      throw input_error(where, ": FieldData history, entry ", i, " is not a history entry");
    }
  }
  return history;
}

void check_schema(vtkFieldData* fields, const std::string& schema, bool required,
                  const std::string& where) {
  if (fields->GetAbstractArray("schema") == nullptr && !required) return;
  const std::string found = text_field(fields, "schema", where);
  if (found != schema) {
    throw input_error(where, ": schema \"", found, "\", expected \"", schema, "\"");
  }
}

std::vector<double> finite_values(vtkDataArray* array, const std::string& where) {
  std::vector<double> values(std::size_t(array->GetNumberOfValues()));
  const int components = array->GetNumberOfComponents();
  for (vtkIdType tuple = 0, at = 0; tuple < array->GetNumberOfTuples(); ++tuple) {
    for (int c = 0; c < components; ++c, ++at) {
      values[std::size_t(at)] = array->GetComponent(tuple, c);
      if (!std::isfinite(values[std::size_t(at)])) {
        throw input_error(where, ", tuple ", tuple, ": value ", values[std::size_t(at)],
                          " is not finite");
      }
    }
  }
  return values;
}

}  // namespace breast
