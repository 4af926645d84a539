// SPDX-License-Identifier: GPL-3.0-or-later
// Compression of a breast between two plates: loads it with gravity, then closes the plates from
// first contact to the target. See docs/methods.md; equations (7)–(8) of the paper.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "contact/compressed_shape.hpp"
#include "contact/judgement.hpp"
#include "contact/path/path.hpp"
#include "contact/path/positioning.hpp"
#include "contact/plates.hpp"
#include "contact/solvers/solver.hpp"
#include "core/progress.hpp"
#include "core/report.hpp"
#include "mechanics/equilibrium.hpp"
#include "mechanics/options.hpp"

namespace breast {

struct CompressionOptions {
  View view = View::cc;
  double angle_deg = 0;  ///< beam angle θ
  /// The first of these that is reached ends the path; if there are none, clinical_stops.
  std::vector<CompressionStop> stops = {};
  /// Between plates placed by the edge of the image, a target that is reached without a grip is no
  /// compression: its status is not_gripped. Otherwise it is converged.
  bool must_grip = true;
  PlateOptions plates;
  /// mm/s², LPS, of a patient who stands upright: it turns with one who bends forwards.
  Vec3 gravity{0, 0, -9810};
  ContactMethod method = ContactMethod::active_set;
  Positioning positioning = Positioning::hanging;
  double pull_N = 0;    ///< force with which the hand pulls the lifted breast forwards
  double friction = 0;  ///< Coulomb's μ between skin and plates
  PathOptions path;
  /// Whether the plates' mid-plane follows the breast along the beam: of a lifted breast between plates that are
  /// placed by the edge of the image, unless the height of a plate is given.
  bool follows_breast() const;
  int states = 0;  ///< number of CompressionResult::states, at least 2, or none
};

/// An equilibrium on the way of the plates, whose forces are those of Equilibrium::contact.
struct ClosingState : Equilibrium {
  double thickness = 0;     ///< mm, also of a state that was not found
  double hand_carries = 0;  ///< share of the breast's weight that a hand still carries
  double hand_pulls_N = 0;  ///< force with which it still pulls the breast forwards
};

/// A compressed breast. Pose, thickness and the plates' forces are those of Equilibrium::contact.
struct CompressionResult : Equilibrium {
  PlatePair plates;
  ViewPose pose;
  PathResult path;
  /// |plates + weight + chest wall + cut| over the larger of paddle force and weight.
  double force_balance = 0;
  Vec3 wall_reaction_N{0, 0, 0};  ///< force of the chest wall and a held cut on the body
  double weight_N = 0;
  Coverage coverage;         ///< share of the breast in front of the image edge, which is the
                             ///< plates' edge
  double projected_cm2 = 0;  ///< projected area of the breast in front of that edge
  std::vector<PositioningStage> stages;
  SelfContact self_contact;
  std::map<Tissue, StrainRange> strains;
  std::vector<double> profile_depth_mm, profile_thickness_mm;  ///< from the plate edge to the front
  std::vector<PressedPlace> places;                            ///< per plate of the contact record
  std::vector<Judgement> judgement;  ///< comparison with clinical ranges, and comments on the solve
  std::vector<CompressionStop> stops;  ///< the targets
  int placements = 1;  ///< how often the plates were placed (PlateOptions::farthest_image_edge)
  /// The parts of the paddle's and the detector's force on their edges, if the plates were left there to
  /// be placed anew (PathOptions::most_on_edge).
  std::optional<std::array<double, 2>> left_with_on_edge;
  /// Of plates placed by the edge of the image: the state is within the ranges that decide, whether or
  /// not the target was reached.
  bool acceptable = false;
  /// If asked for, and unless this result is sure to be refused: equilibria from first contact to it,
  /// which is the last, in equal steps of thickness (contact/closing_states.hpp).
  std::vector<ClosingState> states;
};

/// Compresses mesh.reference. A compression that stops early returns its last equilibrium with the status
/// stopped_early and the reason, and one that does not grip the breast the status not_gripped; if gravity
/// alone does not converge, the status is not_converged. The cost is that of all placements of the plates. Throws Error (input) when the plates miss the breast
/// or an option is out of range.
CompressionResult compress(const HexMesh& mesh, const CompressionOptions& options,
                           const MechanicsOptions& mechanics, Progress& progress = no_progress());

/// Writes the mechanics report and the keys of a compression; `mesh` is the one that was solved.
void write_report(const CompressionResult& result, const HexMesh& mesh,
                  const MechanicsOptions& mechanics, Report& report);

/// One line about the plates, from a report filled by write_report; empty if there are no plates.
std::vector<std::string> plate_lines(const Report& report);

}  // namespace breast
