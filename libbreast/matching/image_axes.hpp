// SPDX-License-Identifier: GPL-3.0-or-later
// The axes of a patient's mammogram: conversion of its pixels to mm along the axes of the simulated
// view.
#pragma once

#include <string>

#include "matching/image_field.hpp"
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
  /// Axes whose rows run anteriorly or posteriorly and whose columns along e_v.
  static ImageAxes upright(const MammogramHeader& header, bool anterior_is_right);

  Vec2 mm(const Vec2& pixel) const { return mm_per_pixel_.cwiseProduct(pixel); }
  Vec2 pixel(const Vec2& mm) const { return mm.cwiseQuotient(mm_per_pixel_); }
  bool contains(const Vec2& mm, double margin) const;  ///< margin in mm inside the field's border
  /// Coordinate u of the field's border at the chest, mm.
  double posterior_border() const;
  bool anterior_is_right() const { return mm_per_pixel_.x() > 0; }
  /// The axes of the same image with its rows in reverse order, or its columns.
  ImageAxes upside_down() const { return turned(Vec2(1, -1)); }
  ImageAxes mirrored() const { return turned(Vec2(-1, 1)); }
  /// The part of the image that is neither frame nor padding; at first all of it.
  const ImageField& field() const { return field_; }
  void restrict_to(const ImageField& field) { field_ = field; }

 private:
  ImageAxes(const Vec2& mm_per_pixel, const MammogramHeader& header);
  ImageAxes turned(const Vec2& signs) const {
    ImageAxes axes = *this;
    axes.mm_per_pixel_ = axes.mm_per_pixel_.cwiseProduct(signs);
    return axes;
  }

  Vec2 mm_per_pixel_;  ///< signed
  ImageField field_;
};

}  // namespace breast
