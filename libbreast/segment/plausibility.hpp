// What a scan must be for the rest to make sense, and what to tell its reader.
#pragma once

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

}  // namespace breast
