// SPDX-License-Identifier: GPL-3.0-or-later
// A patient's mammogram registered with the simulated view.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/report.hpp"
#include "image/colour_picture.hpp"
#include "matching/correspondence.hpp"
#include "matching/hanging.hpp"
#include "matching/similarity.hpp"
#include "projection/mammogram_scan.hpp"

namespace breast {

enum class MatchEnd { from, to };  ///< which of a matcher's two views

/// What a patient's mammogram is registered with.
struct SimulatedView {
  SimulatedView(const Matcher& matcher, MatchEnd end);

  Side side;
  ContactRecord compression;
  ViewPose pose;
  double plate_edge_u;         ///< chest-wall edge of the flat part of the plates, mm
  std::vector<Vec2> outline;   ///< (u,v), mm
  std::optional<Vec2> nipple;  ///< (u,v), mm
};

class AlignedView {
 public:
  /// Keeps the scan, with grey values turned if its air is bright. `nipple` is in pixels, if it was marked.
  /// Throws Error (input) beginning with `where` for the other breast or another view, as seen_air,
  /// hang_image, image_outline, align_outlines, check_upright and check_scale do, if a nipple is marked but
  /// the mesh has none, and if neither header nor outline says which way is up.
  AlignedView(MammogramScan scan, SimulatedView simulated, const std::optional<Vec2>& nipple,
              const std::string& where);

  /// Pixels (column, row from the centre of the top left one) of the patient's image.
  Vec2 pixel(const Vec2& uv) const { return hanging_.axes.pixel(alignment_.map.apply(uv)); }
  Vec2 uv(const Vec2& pixel) const { return alignment_.map.invert(hanging_.axes.mm(pixel)); }
  const MammogramScan& scan() const { return scan_; }
  const Alignment& alignment() const { return alignment_; }
  const std::vector<Vec2>& simulated_outline() const { return simulated_.outline; }  ///< (u,v), mm
  double pixel_mm() const { return scan_.header.pixel_mm; }

  /// The patient's image without marks, hung as in the clinic: the chest wall at the left edge for a
  /// left breast and at the right edge for a right one, lateral or superior at the top. Its pixels
  /// are means over blocks of the image's, hung_pixel_mm() wide.
  ColourPicture hung() const;
  double hung_pixel_mm() const { return block() * pixel_mm(); }
  /// The upper left corner of that picture in mm along the image axes: (x, y) mm from it lies at the
  /// corner plus (x, y) for a left breast and minus (x, y) for a right one.
  Vec2 hung_corner() const;

  /// Writes the keys aligned/VIEW/...: similarity, residuals, comparison of header and simulation.
  void report(Report& report) const;
  /// What of the header was ignored or found elsewhere than usual, and the residual.
  std::vector<std::string> remarks() const;
  /// Doubts: a header that contradicts the image, differences between header and simulation, or a poor fit.
  std::vector<std::string> doubts() const;

 private:
  int block() const;
  bool left() const { return scan_.header.side == Side::left; }

  MammogramScan scan_;
  SimulatedView simulated_;
  Hanging hanging_;
  Alignment alignment_;
};

}  // namespace breast
