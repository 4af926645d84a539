// The MECHANICS options that backward, forward and compress share, as given on the command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cli/tool.hpp"

namespace breast {

struct MechanicsChoices {
  std::string materials = "seed2008";    ///< name of a set, or a TSV file
  std::vector<std::string> scale;        ///< "TISSUE=PERCENT", checked in form only
  std::string element = "q1p0";          ///< q1p0 | q2p1
  std::string invariants = "isochoric";  ///< isochoric | plain
  std::optional<double> bulk_ratio;      ///< K/μ; none: exactly incompressible
  std::string cut = "free";              ///< free | fixed | roller
  std::string solver = "auto";           ///< auto | direct
  bool keep_unconverged = false;         ///< write the file even so, its status saying so
};

void declare_mechanics(Tool& tool, MechanicsChoices& choices);

}  // namespace breast
