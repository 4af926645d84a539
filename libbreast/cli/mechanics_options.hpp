// SPDX-License-Identifier: GPL-3.0-or-later
// The mechanics options that backward, forward and compress share, as given on the command line.
#pragma once

#include <string>
#include <vector>

#include "cli/tool.hpp"
#include "core/mechanics_texts.hpp"

namespace breast {

/// The parts of the model that the command line gives; scales are checked in form only.
struct MechanicsChoices : MechanicsTexts {
  std::string default_set = {};   ///< material set for a file that states no model; empty: none
  bool keep_unconverged = false;  ///< write the file even if not converged, with this status
};

/// The options of the model, and a paragraph that says where it comes from: from the file `from`, as
/// the help calls it.
void declare_mechanics(Tool& tool, MechanicsChoices& choices, const std::string& from);

/// --estimate: step (the present value first), q2 or none.
void declare_estimate(Tool& tool, std::string& estimate);

/// Direction of gravity as given to forward and backward.
struct GravityChoices {
  std::string posture;          ///< supine | prone | upright | off
  std::vector<double> gravity;  ///< three numbers instead, mm/s²; may be empty
  Vec3 vector() const;          ///< mm/s², LPS
};

/// --posture (the present value first) and --gravity. A gravity below 50 mm/s² that is not 0 is
/// refused, asking whether another unit was meant.
void declare_gravity(Tool& tool, GravityChoices& choices, const std::string& help);

/// "upright", "off" or "gx,gy,gz" in mm/s². Throws Error (input) for anything else, and for a size
/// below 50 mm/s² that is not 0.
Vec3 parse_gravity(const std::string& text);

}  // namespace breast
