// The MECHANICS options from their names on a command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "mechanics/mechanics.hpp"

namespace breast {

/// Names are those of the MECHANICS options: materials (set or file), "TISSUE=PERCENT" scales,
/// "q1p0" | "q2p1", "isochoric" | "plain", bulk ratio K/μ (none: incompressible), "free" | "fixed"
/// | "roller", "auto" | "direct" | "multigrid". Throws Error (input) for any other.
MechanicsOptions mechanics_options(const std::string& materials,
                                   const std::vector<std::string>& scale,
                                   const std::string& element, const std::string& invariants,
                                   std::optional<double> bulk_ratio, const std::string& cut,
                                   const std::string& solver);

/// The same from a command line's choices: a struct with members of these names, which belongs to a
/// layer this one does not include.
template <class Choices>
MechanicsOptions mechanics_options(const Choices& c) {
  return mechanics_options(c.materials, c.scale, c.element, c.invariants, c.bulk_ratio, c.cut,
                           c.solver);
}

/// "none" | "step" | "q2". Throws Error (input) for any other.
Estimate estimate_from_name(const std::string& name);

}  // namespace breast
