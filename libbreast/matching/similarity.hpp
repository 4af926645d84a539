// SPDX-License-Identifier: GPL-3.0-or-later
// Registration of a simulated view to a patient's mammogram by rotation, translation and scale.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "matching/image_axes.hpp"
#include "matching/outline.hpp"

namespace breast {

/// Simulated (u,v) in mm to mm of the image axes.
struct Similarity {
  double scale = 1, rotation_deg = 0;  ///< from u towards v
  Vec2 shift{0, 0};                    ///< image of (u,v) = (0,0), mm

  Vec2 apply(const Vec2& uv) const;
  Vec2 invert(const Vec2& mm) const;
};

/// Data of both images, mm: the simulated one in (u,v), the other in image axes.
struct AlignmentData {
  std::vector<Vec2> simulated;  ///< outline
  double spacing = 0.4;         ///< mm, mean distance of its points
  std::vector<OutlinePoint> real;
  double plate_edge_u = 0;  ///< chest-wall edge of the simulated plates
  double scale = 1;         ///< expected
  /// The nipple in both images; if absent, the most anterior part of the outlines is used.
  std::optional<std::pair<Vec2, Vec2>> nipple;
};

struct Alignment {
  Similarity map;
  double residual_mm = 0;  ///< root mean square distance of the simulated outline from the real one
  /// Standard deviation of a point on the outline along each axis, derived from the outlines'
  /// residual (with one independent point every 30 mm, minus four parameters).
  double pose_mm = 0;
  double rotation_sd_deg = 0, scale_sd = 0;
  double nipple_mm = 0;  ///< remaining distance of the two nipples (or most anterior parts)
  double edge_mm = 0;    ///< simulated plate's edge in front of the image's border
  double used = 0;       ///< part of the simulated outline that lies within the image
  /// Standard deviation to be added to the band, from residual and pose, mm along each axis.
  double deviation_mm() const;
};

/// Least squares over the distances of the simulated outline from the real one (Huber beyond twice
/// their spread, which is estimated at the same time), the nipple (2 mm if marked; 5 mm for the
/// most anterior part otherwise), the chest-wall edge (parallel within 3°, position within 10 mm)
/// and the scale (within 5 % of the expected one), by Gauss–Newton with new nearest points in every step. Throws Error
/// (input) beginning with `where` if less than 40 % of the simulated outline lies within the image
/// or the fit does not converge.
Alignment align_outlines(const AlignmentData& data, const ImageAxes& axes,
                         const std::string& where);

/// Whether one residual is clearly better than another: this is above 1 mm, and that less than half of it.
bool fits_better(double residual_mm, double than_mm);

/// Throws Error (input) beginning with `where` if the image fits clearly better with its rows in reverse
/// order than as `found`. Of a symmetric breast the outline does not tell.
void check_upright(const AlignmentData& data, const ImageAxes& axes, const Alignment& found,
                   const std::string& where);

/// Throws Error (input) beginning with `where` if the image fits clearly better when its pixels are half to
/// twice as large as the header states: a magnification that is not stated, or that
/// the pixel spacing already contains.
void check_scale(const AlignmentData& data, const ImageAxes& axes, const Alignment& found,
                 const std::string& where);

}  // namespace breast
