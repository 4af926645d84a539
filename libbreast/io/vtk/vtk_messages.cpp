// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/vtk/vtk_messages.hpp"

#include <vtkLogger.h>
#include <vtkNew.h>
#include <vtkObjectFactory.h>
#include <vtkOutputWindow.h>

#include <algorithm>

namespace breast {

namespace {

class Collector : public vtkOutputWindow {
 public:
  static Collector* New();
  vtkTypeMacro(Collector, vtkOutputWindow) void DisplayText(const char*) override {}
  void DisplayErrorText(const char* text) override {
    if (errors++ == 0) first = text;
  }
  void DisplayWarningText(const char*) override {}
  void DisplayGenericWarningText(const char*) override {}
  void DisplayDebugText(const char*) override {}

  int errors = 0;
  std::string first;
};
vtkStandardNewMacro(Collector);

Collector* active() {
  return Collector::SafeDownCast(vtkOutputWindow::GetInstance());
}

}  // namespace

VtkMessages::VtkMessages() {
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF);
  vtkNew<Collector> collector;
  vtkOutputWindow::SetInstance(collector);
}

VtkMessages::~VtkMessages() {
  vtkOutputWindow::SetInstance(nullptr);
}

bool VtkMessages::error() const {
  const Collector* collector = active();
  return collector != nullptr && collector->errors > 0;
}

std::string VtkMessages::first() const {
  const Collector* collector = active();
  if (collector == nullptr) return {};
  std::string text = collector->first;
  // "ERROR: In FILE.cxx, line N\nvtkClass (0x...): what happened"
  if (const auto at = text.find("): "); at != std::string::npos) text = text.substr(at + 3);
  std::replace(text.begin(), text.end(), '\n', ' ');
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

}  // namespace breast
