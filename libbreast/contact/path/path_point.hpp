// SPDX-License-Identifier: GPL-3.0-or-later
// Forces, area and mean pressure of the plates in a converged state of the path.
#pragma once

#include <vector>

#include "contact/path/target.hpp"
#include "contact/plates.hpp"
#include "contact/solvers/solver.hpp"

namespace breast {

/// `paddle_area`: area (mm²) that touches the paddle.
PathPoint path_point(const ContactSolver& solver, const PlatePair& plates, const State& state,
                     const ContactStep& step, double paddle_area);

/// Drops the last points up to one of this thickness (mm).
void drop_points_beyond(double thickness, std::vector<PathPoint>& points);
/// Drops the last but one of two points of equal thickness: an accurate solve repeats a point.
void drop_repeated_point(std::vector<PathPoint>& points);

}  // namespace breast
