// What a scan must be for the rest to make sense, and what to tell its reader.
#pragma once

#include <string>
#include <vector>

#include "segment/work.hpp"

namespace breast {

/// Median, over the tissue 4-8 mm below the breast's skin, of its brightness relative to the
/// brightest tissue within 25 mm: fat lies there, so 0.6-0.8 is usual without fat saturation.
double subcutaneous_brightness(const Work& work);
/// Throws Error (input) when the subcutaneous fat is darker than a third of its surroundings'
/// brightest tissue: it has been saturated.
void refuse_saturated_fat(const Work& work);

/// Cross-section of the breast on the border of the scan's voxels, cm2.
double cut_by_view_cm2(const Mask& breast);

/// Skin around which, within 10 mm, both principal radii exceed 250 mm, more than 30 mm in front of
/// the wall: a breast hanging free has none; one that rests on coil or table has. cm2.
double flat_skin_cm2(const Work& work);

/// What an adult's breast cannot be far from, whatever its shape.
struct Extents {
  /// Of the body on this side in front of the sternum's skin: there is breast and nothing else.
  double front_left_out_percent = 0;
  double lateral_border_mm = 0;  ///< farthest column on the wall from the midline
  double nipple_depth_mm = 0;    ///< from the nipple back to the wall
  double volume_ml = 0;
};
Extents extents_of(const Work& work, const Vec3& nipple, Side side);
/// One sentence for each of them that is out of the range seen in patients.
std::vector<std::string> extent_doubts(const Extents& found, double greatest_depth_mm);

}  // namespace breast
