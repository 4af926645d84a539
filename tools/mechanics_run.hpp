// SPDX-License-Identifier: GPL-3.0-or-later
// What forward, backward and compress share from the mesh read to the file written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/mechanics_options.hpp"
#include "cli/tool.hpp"
#include "mechanics/mechanics.hpp"

namespace breast {

class MechanicsRun {
 public:
  /// `input` is where `mesh` was read from. For 27-node elements its order is raised.
  MechanicsRun(Run& run, const MechanicsChoices& choices, const std::string& estimate,
               std::filesystem::path input, HexMesh mesh);

  /// As read; no tool changes it before finish.
  const HexMesh& mesh() const { return mesh_; }
  const MechanicsOptions& options() const { return options_; }

  /// The end of all three tools, after the report is filled: tells the summary (`results`:
  /// lines of the tool's own) and the warnings, writes `output` when the solve converged,
  /// when it stopped `enough` of the way, or when --keep-unconverged asks for it. Throws
  /// Error (not converged) otherwise.
  void finish(const Equilibrium& found, const std::filesystem::path& output, bool enough = false,
              const std::vector<std::string>& results = {});

 private:
  Run& run_;
  bool keep_unconverged_;
  std::filesystem::path input_;
  MechanicsOptions options_;
  HexMesh mesh_;
  std::string sha_;
};

}  // namespace breast
