// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics_run.hpp"

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/mesh_file.hpp"
#include "mechanics/closing_summary.hpp"
#include "mechanics/model.hpp"
#include "mesh/element_order.hpp"
#include "solved_model.hpp"

namespace breast {

MechanicsRun::MechanicsRun(Run& run, const MechanicsChoices& choices, const std::string& estimate,
                           std::filesystem::path input, HexMesh mesh)
    : run_(run),
      keep_unconverged_(choices.keep_unconverged),
      input_(std::move(input)),
      options_(model_for(choices, input_, mesh, run)),
      mesh_(std::move(mesh)),
      sha_(mesh_.content_sha256) {
  options_.estimate = estimate_from_name(estimate);
  if (options_.element == Element::q2p1) mesh_ = raise_order(mesh_);
}

std::optional<StateSeries> StatesChoice::series(const std::filesystem::path& output,
                                                const HexMesh& mesh) const {
  if (number == 0) return {};
  if (is_stream(output))
    throw input_error("--states: ", output.string(),
                      " is no file beside which the states could be");
  return std::optional<StateSeries>(std::in_place, series_folder(output), mesh.landmarks);
}

void declare_states(Tool& tool, StatesChoice& choice, const std::string& what) {
  tool.integer(
      choice.number, "--states", "N",
      "also write N equilibria " + what +
          "; the last is the result. A folder beside the output gets one mesh for each, a table of "
          "status, residual, iterations and places of the landmarks (states.tsv), and a series that "
          "ParaView opens as an animation (states.vtkhdf.series)",
      2, 200);
  tool.basic({"--states"});
}

void MechanicsRun::put(const Equilibrium& found, HexMesh& mesh) const {
  const History before = mesh_.history;
  store(found, mesh);
  mesh.model = model_text(options_);
  mesh.history = run_.history({{input_, sha_, &before}});
  mesh.wall_seconds = run_.seconds();
}

void MechanicsRun::add_state(StateSeries& series, const Equilibrium& found,
                             std::vector<std::pair<std::string, double>> quantities) {
  const SeriesRow row{std::move(quantities), found.record.status, found.residual,
                      found.newton_iterations, found.record.reason};
  if (found.points.empty()) {
    series.add(row, nullptr);
    return;
  }
  HexMesh mesh = mesh_;
  put(found, mesh);
  series.add(row, &mesh);
}

void MechanicsRun::tell_states(const std::vector<Equilibrium>& states) {
  int found = 0, iterations = 0;
  std::string reason;
  for (const Equilibrium& state : states) {
    found += !state.points.empty();
    iterations += state.newton_iterations;
    if (state.points.empty() && reason.empty()) reason = state.record.reason;
  }
  run_.report().set("states/number", int(states.size()));
  run_.report().set("states/found", found);
  run_.report().set("states/newton_iterations", iterations);
  if (found < int(states.size()))
    run_.warn(message(states.size() - std::size_t(found), " of ", states.size(),
                      " states were not found: ", reason));
}

void MechanicsRun::finish(const Equilibrium& found, const std::filesystem::path& output,
                          bool enough, const std::vector<std::string>& results,
                          StateSeries* states) {
  tell_summary(run_.report(), found.timer, run_.progress(), results);
  for (const std::string& doubt : found.doubts) run_.warn(doubt);
  if (found.converged() || enough || keep_unconverged_) {
    put(found, mesh_);
    write_mesh(output, mesh_);
    if (states != nullptr)
      states->commit();
    else if (!is_stream(output))
      remove_series(series_folder(output));
  }
  if (enough) run_.warn(found.record.reason);
  if (found.converged() || enough) return;
  const bool offer = found.record.status == SolveStatus::not_gripped && !keep_unconverged_;
  throw not_converged_error(found.record.reason,
                            offer ? ", or --keep-unconverged to write this shape" : "");
}

}  // namespace breast
