// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/stability/explain.hpp"

#include <cmath>

#include "core/error.hpp"

namespace breast {

namespace {

constexpr double most_of_it = 0.5, unknown_fraction = -1;
// Skin that wrinkles: the fraction of the law left in compression and the pre-stretch, see
// SkinBehaviour.
constexpr double wrinkled = 0.05, stretched = 0.03;

}  // namespace

void note_instability(const Instability& instability, SolveSummary& summary) {
  if (instability.mode.size() == 0 || !(instability.value < 0)) return;
  summary.skin_share = instability.share_of("membrane");
  if (!(*summary.skin_share > most_of_it)) return;
  summary.record.reason +=
      message("; compressed skin buckles: ", std::round(100 * *summary.skin_share),
              " % of what drives the instability comes from skin under "
              "compression");
}

void find_remedy(const HexMesh& mesh, const MechanicsOptions& options, const Stands& solves,
                 Progress& progress, SolveSummary& summary) {
  if (!options.seek_remedy || mesh.nodes() > most_nodes_for_remedy) return;
  int solved = 0;
  const Stands stands = [&](const MechanicsOptions& changed) {
    progress.update("remedy", unknown_fraction, message("solve ", ++solved));
    return solves(changed);
  };
  summary.remedy = smallest_remedy(mesh, options, stands, summary.stiffness_factor_needed);
  if (summary.remedy) {
    summary.record.reason +=
        "; the smallest single change that gives a stable solution is " + summary.remedy->words();
  } else {
    summary.record.reason +=
        "; no single change of stiffness, skin or support by up to a factor of a hundred gives "
        "a stable solution";
  }
  const bool buckles = summary.skin_share.value_or(0) > most_of_it;
  if (!buckles || options.materials.skin.kept < 1) return;
  MechanicsOptions wrinkling = options;
  wrinkling.materials.skin.kept = wrinkled;
  wrinkling.materials.skin.prestretch = stretched;
  if (!stands(wrinkling)) return;
  summary.record.reason += message(
      "; skin that wrinkles instead of buckling also gives one "
      "(--skin-compression ",
      100 * wrinkled, " --skin-prestretch ", 100 * stretched, ")");
}

}  // namespace breast
