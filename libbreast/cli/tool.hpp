// SPDX-License-Identifier: GPL-3.0-or-later
// Declaration and execution of a tool: one declaration gives its help, man page, Markdown page,
// checks and exit codes.
//
//   int main(int argc, char** argv) {
//     std::filesystem::path mesh, reference;
//     Tool tool("backward", "remove gravity: the stress-free shape of an imaged breast");
//     tool.describe("...").cite("Pathmanathan et al. 2008, section II-C");
//     tool.input(mesh, "MESH.vtkhdf", "mesh of the imaged shape (hexmesh)");
//     tool.output(reference, "REFERENCE.vtkhdf", "the same mesh, stress-free");
//     tool.example("backward mesh.vtkhdf reference.vtkhdf", "prone gravity, Table II materials");
//     return tool.main(argc, argv, [&](Run& run) { ... });
//   }
#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/progress.hpp"
#include "core/provenance.hpp"
#include "core/report.hpp"
#include "core/types.hpp"

namespace breast {

/// The services for the body of a tool: progress, report, timer, provenance.
class Run {
 public:
  Run(std::string tool, std::string command, Progress& progress);

  Progress& progress() { return progress_; }
  Report& report() { return report_; }
  Timer& timer() { return timer_; }
  /// Provenance for an output: the histories of the inputs, followed by this command. Pass the file
  /// name, SHA-256 and history of every input.
  struct Input {
    std::filesystem::path file;
    std::string sha256;
    const History* history;  ///< may be null (foreign file)
  };
  History history(const std::vector<Input>& inputs) const;
  /// A warning for the user, on stderr and in the report under "warnings".
  void warn(const std::string& text);
  /// A remark, on stderr and in the report under "remarks": nothing that the user should change.
  void remark(const std::string& text);
  /// Prints data (tables) on stdout, which has no other content.
  void print(const std::string& text);
  double seconds() const;  ///< since the tool started
  /// The text collected by print(), which is shown only if the tool succeeds, so that stdout never
  /// has an incomplete table.
  const std::string& printed() const { return printed_; }

 private:
  std::string tool_, command_, printed_;
  Progress& progress_;
  Report report_;
  Timer timer_;
  std::chrono::steady_clock::time_point start_;
};

class Tool {
 public:
  Tool(std::string name, std::string summary);
  ~Tool();

  Tool& describe(const std::string& paragraph);
  Tool& cite(const std::string& reference);
  Tool& example(const std::string& command, const std::string& explanation);

  // Positional arguments, in order of declaration. Inputs must exist; an output's folder must exist
  // and be writable, its name must have an ending that its placeholder shows ("OUT.inp|OUT.feb") or
  // `more_endings` lists, and it must replace no input and no file of another program; all checked
  // before the body runs.
  Tool& input(std::filesystem::path& value, const std::string& placeholder,
              const std::string& help);
  Tool& inputs(std::vector<std::filesystem::path>& values, const std::string& placeholder,
               const std::string& help);  ///< one or more; only as the last positional
  Tool& output(std::filesystem::path& value, const std::string& placeholder,
               const std::string& help, const std::vector<std::string>& more_endings = {});
  /// A positional argument that is not (always) a file: a name, or a choice that the tool resolves
  /// itself.
  Tool& word(std::string& value, const std::string& placeholder, const std::string& help);
  /// One or more values; only as the last positional argument.
  Tool& words(std::vector<std::string>& values, const std::string& placeholder,
              const std::string& help);

  // Options. `name` is "--skin" or "-o,--output"; unit/placeholder is shown in the help; the
  // default is the variable's present value. Numbers outside [low, high] are usage errors.
  Tool& number(double& value, const std::string& name, const std::string& unit,
               const std::string& help, double low = -std::numeric_limits<double>::infinity(),
               double high = std::numeric_limits<double>::infinity());
  Tool& number(std::optional<double>& value, const std::string& name, const std::string& unit,
               const std::string& help, double low = -std::numeric_limits<double>::infinity(),
               double high = std::numeric_limits<double>::infinity());
  Tool& integer(int& value, const std::string& name, const std::string& unit,
                const std::string& help, int low, int high);
  Tool& text(std::string& value, const std::string& name, const std::string& placeholder,
             const std::string& help);
  Tool& texts(std::vector<std::string>& values, const std::string& name,
              const std::string& placeholder, const std::string& help);  ///< repeatable
  Tool& choice(std::string& value, const std::string& name, const std::vector<std::string>& choices,
               const std::string& help);
  /// Comma-separated numbers, exactly `count`: "--gravity 0,-9810,0".
  Tool& numbers(std::vector<double>& values, const std::string& name,
                const std::string& placeholder, int count, const std::string& help);
  Tool& flag(bool& value, const std::string& name, const std::string& help);
  /// A flag with which the tool only answers: all but the first positional argument, and options that are
  /// otherwise required, may be left out.
  Tool& question(bool& value, const std::string& name, const std::string& help);
  Tool& input_file(std::filesystem::path& value, const std::string& name,
                   const std::string& placeholder, const std::string& help);
  Tool& output_file(std::filesystem::path& value, const std::string& name,
                    const std::string& placeholder, const std::string& help);
  /// A folder that the tool fills; it may exist already, and its parent must exist.
  Tool& output_folder(std::filesystem::path& value, const std::string& name,
                      const std::string& placeholder, const std::string& help);
  Tool& required(const std::string& name);  ///< makes an option mandatory
  /// Lists options under a heading of their own; without a topic, an option is under "Options".
  /// The options must be declared before, and each has at most one topic.
  Tool& topic(const std::string& name, const std::vector<std::string>& options);
  /// Marks the options that --help lists, about ten; --help-all lists all of them.
  Tool& basic(const std::vector<std::string>& options);
  /// Checks across arguments, run after parsing and before any file is opened; throw input_error.
  Tool& check(std::function<void()> rule);

  /// Parses, checks and runs. Every Error becomes one line on stderr and its exit code; --report is
  /// written in case of success and of failure (with status and reason).
  int main(int argc, char** argv, const std::function<void(Run&)>& body);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace breast
