// SPDX-License-Identifier: GPL-3.0-or-later
// Compression of a breast between two plates: gravity first, then the plates from just touching to
// the target. See methods in docs; equations (7)–(8) of the paper.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "contact/coverage.hpp"
#include "contact/deformation.hpp"
#include "contact/judgement.hpp"
#include "contact/path.hpp"
#include "contact/plates.hpp"
#include "contact/positioning.hpp"
#include "contact/self_contact.hpp"
#include "contact/solvers/make_solver.hpp"
#include "core/progress.hpp"
#include "core/report.hpp"
#include "mechanics/equilibrium.hpp"
#include "mechanics/options.hpp"

namespace breast {

enum class StopAt { thickness, reduction, force, pressure, area };

/// A place to stop: mm, %, N, kPa or cm².
struct CompressionStop {
  StopAt at = StopAt::reduction;
  double value = 50;
};

struct CompressionOptions {
  View view = View::cc;
  double angle_deg = 0;  ///< beam angle θ
  StopAt stop_at = StopAt::reduction;
  double target = 50;  ///< mm, %, N, kPa or cm²
  std::vector<CompressionStop> or_at = {};  ///< further ones: the first that is reached ends the path
  PlateOptions plates;
  Vec3 gravity{0, 0, -9810};  ///< mm/s², LPS
  ContactMethod method = ContactMethod::active_set;
  Positioning positioning = Positioning::hanging;
  double pull_N = 0;    ///< with which the hand that lifts the breast pulls it forwards
  double friction = 0;  ///< Coulomb's μ between skin and plates
  PathOptions path;
};

/// A compressed breast.
struct CompressionResult : Equilibrium {
  PlatePair plates;
  ViewPose pose;
  PathResult path;
  double thickness_mm = 0, reduction_percent = 0, initial_thickness_mm = 0;
  /// |plates + weight + chest wall + cut| over the larger of paddle force and weight.
  double force_balance = 0;
  Vec3 wall_reaction_N{0, 0, 0};  ///< of chest wall and held cut on the body
  double weight_N = 0;
  Coverage coverage;         ///< by the image, whose edge is that of the plates
  double projected_cm2 = 0;  ///< the breast's shadow in front of that edge
  std::vector<PositioningStage> stages;
  SelfContact self_contact;
  std::map<Tissue, StrainRange> strains;
  std::vector<double> profile_depth_mm, profile_thickness_mm;  ///< from the plate edge forwards
  std::vector<PressedPlace> places;                            ///< per plate of the contact record
  std::vector<Judgement> judgement;  ///< against clinical ranges, and of the solve
};

/// Compresses mesh.reference. A path that stops early leaves its last equilibrium with status
/// stopped_early and the reason; when gravity alone does not converge the status is not_converged.
/// Throws Error (input) when the plates miss the breast or an option is out of range.
CompressionResult compress(const HexMesh& mesh, const CompressionOptions& options,
                           const MechanicsOptions& mechanics, Progress& progress = no_progress());

/// The mechanics report with compression's own keys; `mesh` is the one that was solved.
void write_report(const CompressionResult& result, const HexMesh& mesh,
                  const MechanicsOptions& mechanics, Report& report);

/// The plates in one line, from a report filled by write_report; none where there are no plates.
std::vector<std::string> plate_lines(const Report& report);

}  // namespace breast
