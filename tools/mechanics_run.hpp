// SPDX-License-Identifier: GPL-3.0-or-later
// The steps that forward, backward and compress share, from reading the mesh to writing the result.
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
  /// `input` is the file from which `mesh` was read, and which states the model (model_for). For
  /// 27-node elements the order of the mesh is raised.
  MechanicsRun(Run& run, const MechanicsChoices& choices, const std::string& estimate,
               std::filesystem::path input, HexMesh mesh);

  /// The mesh as read; it is unchanged until finish.
  const HexMesh& mesh() const { return mesh_; }
  const MechanicsOptions& options() const { return options_; }

  /// Ends all three tools after the report is filled. Prints the summary (with `results`, the
  /// tool's own lines) and the warnings. Writes `output` if the solve converged, if `enough` says
  /// that it came far enough, or if --keep-unconverged is given; the file states the model. Throws Error (not converged)
  /// otherwise.
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
