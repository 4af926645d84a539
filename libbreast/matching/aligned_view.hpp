// SPDX-License-Identifier: GPL-3.0-or-later
// A patient's mammogram registered with the simulated view.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/report.hpp"
#include "image/colour_picture.hpp"
#include "matching/correspondence.hpp"
#include "matching/similarity.hpp"
#include "projection/mammogram_scan.hpp"

namespace breast {

enum class MatchEnd { from, to };  ///< which of a matcher's two views

class AlignedView {
 public:
  /// Keeps the scan. `nipple` is in pixels, if it was marked. Throws Error (input) beginning with
  /// `where` as require_view, ImageAxes, image_outline and align_outlines do, and if a nipple is
  /// marked but the mesh has none.
  AlignedView(MammogramScan scan, const Matcher& matcher, MatchEnd end,
              const std::optional<Vec2>& nipple, const std::string& where);

  /// Pixels (column, row from the centre of the top left one) of the patient's image.
  Vec2 pixel(const Vec2& uv) const { return axes_.pixel(alignment_.map.apply(uv)); }
  Vec2 uv(const Vec2& pixel) const { return alignment_.map.invert(axes_.mm(pixel)); }
  const MammogramScan& scan() const { return scan_; }
  const Alignment& alignment() const { return alignment_; }
  const std::vector<Vec2>& simulated_outline() const { return simulated_; }  ///< (u,v), mm
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
  /// Doubts: differences between header and simulation, or a poor fit.
  std::vector<std::string> doubts() const;

 private:
  int block() const;
  bool left() const { return scan_.header.side == Side::left; }

  MammogramScan scan_;
  ContactRecord compression_;
  std::string where_;
  ImageAxes axes_;
  std::vector<Vec2> simulated_;
  Alignment alignment_;
};

/// Throws Error (input) beginning with `where` when the header is of the other breast or another
/// view than the mesh.
void require_view(const MammogramHeader& header, const HexMesh& compressed,
                  const std::string& where);

}  // namespace breast
