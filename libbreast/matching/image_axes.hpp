// SPDX-License-Identifier: GPL-3.0-or-later
// The axes of a patient's mammogram: conversion of its pixels to mm along the axes of the simulated
// view.
#pragma once

#include <string>

#include "projection/mammogram.hpp"
#include "projection/mammogram_scan.hpp"

namespace breast {

/// Pixel (column, row), counted from the centre of the top left one, to mm on the detector along
/// e_u (anterior) and e_v of the view, and back. The header's Patient Orientation determines the
/// flips. The origin is that pixel, so that only a similarity remains to be found.
class ImageAxes {
 public:
  /// Throws Error (input) beginning with `where` when the orientation is missing or the rows do
  /// not run anteriorly or posteriorly.
  ImageAxes(const MammogramHeader& header, const ViewPose& pose, const std::string& where);

  Vec2 mm(const Vec2& pixel) const { return mm_per_pixel_.cwiseProduct(pixel); }
  Vec2 pixel(const Vec2& mm) const { return mm.cwiseQuotient(mm_per_pixel_); }
  bool contains(const Vec2& mm, double margin) const;  ///< margin in mm inside the border
  /// Coordinate u of the image border at the chest, mm.
  double posterior_border() const;
  bool anterior_is_right() const { return mm_per_pixel_.x() > 0; }
  /// The axes of the same image with its rows in reverse order.
  ImageAxes upside_down() const {
    ImageAxes axes = *this;
    axes.mm_per_pixel_.y() *= -1;
    return axes;
  }

 private:
  Vec2 mm_per_pixel_;  ///< signed
  Vec2 last_pixel_;
};

}  // namespace breast
