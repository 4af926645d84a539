// SPDX-License-Identifier: GPL-3.0-or-later
// Segmentation of a bilateral breast MR, prone or supine, into the labels of one breast (see
// docs/methods.md).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/progress.hpp"
#include "core/report.hpp"
#include "core/units.hpp"
#include "image/label_volume.hpp"
#include "segment/contrast/evidence.hpp"
#include "segment/tissue/areola.hpp"
#include "segment/tissue/tissue.hpp"
#include "surface/tri_mesh.hpp"

namespace breast {

/// Which tissue is bright.
enum class Contrast {
  automatic,       ///< by the evidence of the image
  fat_bright,      ///< as in T1; if the user says so, contrary evidence is only a warning
  fat_suppressed,  ///< fat is dark, muscle and gland are brighter
  dixon            ///< water and fat as two images
};
std::string_view contrast_name(Contrast contrast);

struct SegmentOptions {
  Side side = Side::left;
  /// Posture of the patient. A supine breast spreads beside and behind the front of the chest, so
  /// that the properties by which a prone breast is recognised (it lies in front of the sternum,
  /// with the nipple foremost) are only required of prone scans.
  Posture posture = Posture::prone;
  std::optional<Volume<float>> wall_labels;  ///< corrected label map, code 4 = behind the wall
  std::vector<Vec3> wall_points;             ///< clicked points on the wall (patient mm)
  /// `wall_points` are those of a surface: dense, and reaching beyond the searched wall.
  bool wall_points_of_surface = false;
  /// Number of its standard deviations by which the wall is moved, backwards if positive.
  double wall_shift = 0;
  Interior interior = Interior::threshold;
  Contrast contrast = Contrast::automatic;
  std::optional<Volume<float>> fat;  ///< fat image of the Dixon scan whose water image is given
  /// Second scan of the same examination, for the case that the first does not show the chest wall.
  std::optional<Volume<float>> also;
};

/// What a second scan did.
struct SecondScanUse {
  bool used = false;
  double residual_mm = 0, shift_mm = 0, turn_degrees = 0;  ///< as SecondScan
  double shared_percent = 100;                             ///< of the body in the first
  std::string change;                                      ///< one sentence
};

struct Segmentation {
  Posture posture = Posture::prone;
  LabelVolume labels;
  /// Data points with the scalars "surface" (0 skin, 1 chest wall) and "confidence" [0,1]. For a
  /// supine scan they are the skin of the whole side with normals, and the wall wherever it was
  /// observed.
  TriMesh points;
  double midline_mm = 0;                         ///< patient x of the sternum
  double bias_cv_before = 0, bias_cv_after = 0;  ///< coefficient of variation of fat
  double bias_range = 1;                     ///< brightest over dimmest fat, 1 %-99 % of the breast
  double muscle_ratio = 0, gland_ratio = 0;  ///< brightness relative to fat
  double fat_fraction = 0, fat_fraction_grown = 0, fibroglandular_agreement = 0;
  double fibroglandular_expected_dice = 1;                ///< expected_gland_dice (quality.hpp)
  double wall_confidence_mean = 0;                        ///< over the breast's columns
  double wall_expected_mm = 0, breast_expected_dice = 1;  ///< expected.hpp
  double wall_sigma_mean = 0, wall_sigma_p95 = 0;         ///< mm, over the breast's columns
  std::optional<double>
      muscle_back_percent;            ///< columns in which the muscle of wall_labels has a back
  double wall_confident_percent = 0;  ///< columns with confidence above 0.5
  double sternal_thickness = 0, greatest_thickness = 0;  ///< mm
  double nipple_from_extreme = 0;                        ///< mm
  Vec3 nipple_base{0, 0, 0};  ///< patient mm, on the areola's surface beneath the tip
  double papilla_height = 0;  ///< mm; 0 on a smooth dome
  double cut_by_view_cm2 = 0, flat_skin_cm2 = 0;  ///< of the breast (plausibility.hpp)
  double front_left_out_percent = 0, lateral_border_mm = 0, nipple_depth_mm = 0;  ///< Extents
  double view_behind_sternum_mm = 0;                                              ///< Extents
  Contrast kind = Contrast::fat_bright;  ///< of the scan that shows the tissues
  FatContrast contrast;                  ///< of that scan
  double exchanged_percent = 0;          ///< of the breast, where water and fat of a Dixon scan are
  /// Brightness of muscle over that of suppressed fat: median, and the twentieth of places where it
  /// is least; 0 where fat is not suppressed.
  double muscle_over_fat = 0, muscle_over_fat_low = 0;
  double unsuppressed_ml = 0;  ///< in front of the chest wall, where suppression of fat fails
  SecondScanUse also;
  double roll_degrees = 0;          ///< by which the labels' grid is turned against the scan's
  double wall_shift = 0;            ///< standard deviations the wall was moved by
  double debris_ml = 0;             ///< volume removed from the skin
  double beside_ml = 0;             ///< tissue separate from the torso
  double compact_dark_mm = 0;       ///< radius of the largest ball within fibroglandular tissue
  double lost_edges_percent = 0;    ///< of the edges of brightness (tissue/lost_edges.hpp)
  std::vector<std::string> doubts;  ///< results that the user should check
  Areola areola;                    ///< sought where no papilla stands out
};

/// Throws Error (input) saying which stage failed on this scan and what to try. A scan that is moved in needs no room
/// beside the work on it.
Segmentation segment_breast(Volume<float> scan, const SegmentOptions& options, Progress& progress,
                            Timer& timer);

}  // namespace breast
