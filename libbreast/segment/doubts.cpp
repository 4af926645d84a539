// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/doubts.hpp"

#include <cmath>
#include <utility>

#include "core/error.hpp"
#include "core/table.hpp"
#include "core/units.hpp"

namespace breast {

namespace {

// By this much a prone breast hangs in front of the skin over the sternum.
constexpr double hanging = 45;  // mm
// The score of the wall was one half at this largest deviation; it warns of doubtful sides of the chest.
constexpr double most_deviation = 6;  // mm

/// Volume (ml) within the breast that is darker than any of its tissues.
double enclosed_dark_ml(const Work& work) {
  double count = 0;
  for (std::size_t n = 0; n < work.breast.voxels.size(); ++n)
    count += work.breast.voxels[n] && work.enclosed_dark.voxels[n];
  return count * work.scan.grid.voxel_volume() / mm3_per_ml;
}

/// What is taken for a nipple that does not stand out.
std::string instead_of_papilla(const Segmentation& result) {
  if (!result.areola.found) return "the most anterior point of the smoothed skin";
  return message("the middle of the thickest and darkest skin, which is probably the areola, ",
                 std::lround(result.nipple_from_extreme), " mm from the most anterior point,");
}

void doubt_stages(Segmentation& result, const Work& work) {
  if (result.wall_confident_percent < 80) {
    result.doubts.push_back(
        message("chest wall uncertain on ", std::lround(100 - result.wall_confident_percent),
                " % of the breast's columns: check it (--overlay) and correct it with "
                "--chest-wall"));
  }
  if (!(result.wall_sigma_p95 < most_deviation)) {
    result.doubts.push_back(
        message("chest wall uncertain by ", format_fixed(result.wall_sigma_p95, 1),
                " mm (standard deviation) and more on a twentieth of the breast's columns (usually "
                "below ",
                most_deviation, "): check it (--overlay), mostly at the side"));
  }
  if (result.muscle_ratio < 0.12) {
    result.doubts.push_back(
        message("behind the chest wall the image has ", std::lround(100 * result.muscle_ratio),
                " % of the brightness of fat (muscle has 20-40 %): it may be lung, or fat may be "
                "saturated; check it (--overlay)"));
  }
  if (result.roll_degrees != 0) {
    result.doubts.push_back(message("the body is rotated by ", std::lround(result.roll_degrees),
                                    " degrees against the scan's axes: the scan was resampled "
                                    "along the axes of the body"));
  }
  if (result.cut_by_view_cm2 > 5) {
    result.doubts.push_back(message("the field of view truncates the breast on ",
                                    std::lround(result.cut_by_view_cm2),
                                    " cm2: volume and lateral support are those of the visible "
                                    "part"));
  }
  if (work.torso.one_breast) {
    result.doubts.push_back(message(
        "only one breast is in the field of view: the midline was placed at the deepest skin "
        "medial of it, at x = ",
        std::lround(result.midline_mm), " mm; check the sternal border"));
  }
  if (const double dark = enclosed_dark_ml(work); dark > 0) {
    result.doubts.push_back(
        message(format_fixed(dark, 1),
                " ml within the breast are darker than a tenth of its fat (a clip, a vessel, a "
                "cyst): they are labelled as the tissue that their brightness suggests"));
  }
  if (result.beside_ml > 150) {
    result.doubts.push_back(message(std::lround(result.beside_ml),
                                    " ml of tissue are separate from the torso (arms, or tissue "
                                    "wrapped around the field of view) and were omitted; see "
                                    "--overlay"));
  }
  if (result.compact_dark_mm > 20) {
    result.doubts.push_back(
        message("a ball of ", std::lround(result.compact_dark_mm),
                " mm radius fits into tissue labelled fibroglandular: this may be an implant, a "
                "cyst or a very dense breast; implants are not modelled"));
  }
  if (result.flat_skin_cm2 > 6) {
    result.doubts.push_back(
        message(std::lround(result.flat_skin_cm2),
                " cm2 of the skin are flat, as if the breast rested on the coil or table: "
                "backward assumes that it hangs freely"));
  }
  if (result.posture == Posture::prone && !(result.papilla_height > 0)) {
    result.doubts.push_back(message(
        "nothing stands out of the skin near the front of the breast: ", instead_of_papilla(result),
        " is taken for the nipple; check it (--overlay)"));
  }
}

/// What a reader should know of the contrast.
void doubt_contrast(Segmentation& result) {
  constexpr double much = 1;  // % of the breast
  if (result.exchanged_percent > much) {
    result.doubts.push_back(message("water and fat are exchanged in ",
                                    std::lround(result.exchanged_percent),
                                    " % of the breast: fat's share was turned over there; check "
                                    "fibroglandular tissue (--overlay)"));
  }
}

void doubt_extent(Segmentation& result, const Extents& found) {
  if (result.posture != Posture::prone) {
    if (found.nipple_in_front_mm > hanging) {
      result.doubts.push_back(message("the nipple stands ", std::lround(found.nipple_in_front_mm),
                                      " mm in front of the sternum's skin (supine below ", hanging,
                                      "): is the scan prone?"));
    }
    return;
  }
  for (std::string& doubt : extent_doubts(found, result.greatest_thickness))
    result.doubts.push_back(std::move(doubt));
}

}  // namespace

void add_doubts(Segmentation& result, const Work& work, const Extents& found) {
  doubt_stages(result, work);
  doubt_contrast(result);
  doubt_extent(result, found);
}

}  // namespace breast
