// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics_run.hpp"

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

void MechanicsRun::finish(const Equilibrium& found, const std::filesystem::path& output,
                          bool enough, const std::vector<std::string>& results) {
  tell_summary(run_.report(), found.timer, run_.progress(), results);
  for (const std::string& doubt : found.doubts) run_.warn(doubt);
  if (found.converged() || enough || keep_unconverged_) {
    const History before = mesh_.history;
    store(found, mesh_);
    mesh_.model = model_text(options_);
    mesh_.history = run_.history({{input_, sha_, &before}});
    mesh_.wall_seconds = run_.seconds();
    write_mesh(output, mesh_);
  }
  if (enough) run_.warn(found.record.reason);
  if (!found.converged() && !enough) throw not_converged_error(found.record.reason);
}

}  // namespace breast
