// SPDX-License-Identifier: GPL-3.0-or-later
// Fit of an elliptic cylinder to chest-wall data, for the shape of the thorax where there are no
// data.
#pragma once

#include <vector>

#include "core/types.hpp"

namespace breast {

/// Centre and half axes (mm) at the height z0; the y coordinate of the centre changes with z by
/// `slope`.
struct EllipticCylinder {
  double centre_x = 0, centre_y = 0, z0 = 0, slope = 0;
  double half_width = 0, half_depth = 0;

  /// Distance from the axis to the surface, mm, at an angle from the front (radians).
  double radius(double angle) const;
};

/// Prior of a parameter: expected value and standard deviation.
struct Expected {
  double value = 0, sigma = 1;
};

/// Robust least squares (Cauchy weights) of distances, with priors for the parameters that an arc
/// of data does not determine: half axes 135 ± 15 and 95 ± 15 mm, slope 0 ± 0.3. `weights` holds
/// one weight for each point.
EllipticCylinder fit_elliptic_cylinder(const std::vector<Vec3>& points,
                                       const std::vector<double>& weights,
                                       const Expected& centre_x);

}  // namespace breast
