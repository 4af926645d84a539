// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/dicom/like_mammogram.hpp"

#include <cmath>

#include "core/error.hpp"
#include "io/dicom/mammogram_header.hpp"

namespace breast {

LikeMammogram like_mammogram(const std::filesystem::path& file, View view,
                             const std::optional<double>& angle_deg) {
  const MammogramHeader header = read_mammogram_header(file);
  if (header.view != view) {
    throw input_error(file.string(), ": shows ", view_name(header.view), ", --view is ",
                      view_name(view));
  }
  if (!header.thickness_mm && !header.force_N) {
    throw input_error(
        file.string(),
        ": states neither a possible thickness nor a possible force of the compression; give "
        "--thickness or --force");
  }
  constexpr double farthest_deg = 30;
  if (!angle_deg && header.angle_deg &&
      std::abs(*header.angle_deg - view_angle_deg(view)) > farthest_deg) {
    throw input_error(file.string(), ": positioner angle ", *header.angle_deg, " degrees, but ",
                      view_name(view), " is at ", view_angle_deg(view), " +- ", farthest_deg,
                      "; give --angle");
  }
  return {header.side, angle_deg ? angle_deg : header.angle_deg, header.thickness_mm,
          header.force_N, header.remarks};
}

}  // namespace breast
