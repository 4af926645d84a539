// SPDX-License-Identifier: GPL-3.0-or-later
// The mechanics options as a command line and the file of a shape state them.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace breast {

/// The parts of the model that are given; what is empty is left as it is (mechanics/options.hpp).
struct MechanicsTexts {
  std::string materials = {};           ///< name of a set, or a TSV file
  std::vector<std::string> scale = {};  ///< "TISSUE=PERCENT"
  std::string element = {};             ///< q1p0 | q2p1
  std::string invariants = {};          ///< isochoric | plain
  std::string bulk_ratio = {};          ///< K/μ, or "incompressible"
  std::string wall = {}, cut = {};
  std::string solver = "auto";  ///< auto | direct | multigrid
  std::optional<double> skin_compression = {}, skin_smoothing = {},
                        skin_prestretch = {};  ///< per cent, -, per cent
};

}  // namespace breast
