// SPDX-License-Identifier: GPL-3.0-or-later
// The observations of a breast in a second posture.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contact/compression.hpp"
#include "mesh/locate.hpp"

namespace breast {

/// A material point of the imaged breast, and its observed position.
struct SeenPoint {
  std::string name;
  Location at;           ///< in the imaged shape
  Vec3 seen{0, 0, 0};    ///< mm, in the second posture
  double deviation = 1;  ///< mm, standard deviation of each coordinate
};

/// The observed skin: points with unit normals of either sign.
struct SeenSurface {
  std::vector<Vec3> points, normals;
  double deviation = 2;  ///< standard deviation of the distance at one sampled place, mm
  /// Largest distance along the surface to the nearest point, mm; farther places have no data.
  double reach = 10;
};

/// Force of the paddle at a thickness between the plates of `press`.
struct SeenForce {
  double thickness = 0, force = 0, deviation = 1;  ///< mm, N
};

struct Observations {
  std::vector<SeenPoint> points;
  std::optional<SeenSurface> surface;
  std::vector<SeenForce> forces;
  /// Compression in which the forces were measured; its target is set by theirs.
  CompressionOptions press;

  std::size_t count() const { return 3 * points.size() + forces.size() + (surface ? 1 : 0); }
};

/// Standard deviation of one coordinate of a mark whose error in space is `rms_mm`.
double coordinate_deviation(double rms_mm);

}  // namespace breast
