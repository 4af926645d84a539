// SPDX-License-Identifier: GPL-3.0-or-later
// The steps that forward, backward and compress share, from reading the mesh to writing the result.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/mechanics_options.hpp"
#include "cli/tool.hpp"
#include "io/state_series.hpp"
#include "mechanics/mechanics.hpp"

namespace breast {

/// --states N: the states on the way, beside the output.
struct StatesChoice {
  int number = 0;  ///< none
  /// The series for `output`; empty without the option. Throws Error (input) if it cannot be there.
  std::optional<StateSeries> series(const std::filesystem::path& output, const HexMesh& mesh) const;
};
void declare_states(Tool& tool, StatesChoice& choice, const std::string& what);

class MechanicsRun {
 public:
  /// `input` is the file from which `mesh` was read, and which states the model (model_for). For
  /// 27-node elements the order of the mesh is raised.
  MechanicsRun(Run& run, const MechanicsChoices& choices, const std::string& estimate,
               std::filesystem::path input, HexMesh mesh);

  /// The mesh as read; it is unchanged until finish.
  const HexMesh& mesh() const { return mesh_; }
  const MechanicsOptions& options() const { return options_; }

  /// Adds a state on the way to the result to its series; one that was not found has a row only.
  void add_state(StateSeries& series, const Equilibrium& found,
                 std::vector<std::pair<std::string, double>> quantities);

  /// Reports how many states were found, and warns of those that were not.
  void tell_states(const std::vector<Equilibrium>& states);

  /// Ends all three tools after the report is filled. Prints the summary (with `results`, the
  /// tool's own lines) and the warnings. Writes `output` if the solve converged, if `enough` says
  /// that it came far enough, or if --keep-unconverged is given; the file states the model. The states
  /// take the place of those of an older output, which go without `states`. Throws Error (not
  /// converged) otherwise.
  void finish(const Equilibrium& found, const std::filesystem::path& output, bool enough = false,
              const std::vector<std::string>& results = {}, StateSeries* states = nullptr);

 private:
  void put(const Equilibrium& found, HexMesh& mesh) const;

  Run& run_;
  bool keep_unconverged_;
  std::filesystem::path input_;
  MechanicsOptions options_;
  HexMesh mesh_;
  std::string sha_;
};

}  // namespace breast
