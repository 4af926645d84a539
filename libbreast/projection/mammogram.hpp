// SPDX-License-Identifier: GPL-3.0-or-later
// A projection image on the detector plane, with its pose.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/provenance.hpp"
#include "core/types.hpp"
#include "mesh/view.hpp"
#include "mesh/view_pose.hpp"

namespace breast {

struct Mammogram {
  ViewPose pose;
  View view = View::cc;
  Side side = Side::left;
  int width = 0, height = 0;  ///< pixels along u and v
  double pixel = 0.25;        ///< mm
  double plate_edge_u = 0;    ///< mm, where the plates' flats begin; behind it tissue is thicker
  std::string energy =
      "fraction";  ///< the quantity in `path`: "fraction" (mm), "20 keV", or the name of a spectrum
  std::vector<float> path;       ///< line integral (or tissue-weighted mm) per pixel, u fastest
  std::vector<float> thickness;  ///< mm of tissue along each ray
  std::vector<float> fibroglandular;  ///< mm of fibroglandular tissue along each ray
  /// 1 if the column leaves the mesh through the chest wall or the cut. Where the image ends at the
  /// plates' edge, the column is continued with fat, and from where muscle fills most of it with
  /// muscle, to the thickness of the tissue in front of it, at most to the distance of the plates, and
  /// so are those that miss the mesh behind it; otherwise the other arrays are 0.
  std::vector<std::uint8_t> through_back;
  /// Whether a pixel has no value.
  bool blank(std::size_t pixel) const {
    return through_back[pixel] != 0 && !(thickness[pixel] > 0);
  }
  /// Whether `path` is mm of tissue instead of attenuation, so that it gives no detector signal.
  bool shows_fraction() const { return energy == "fraction"; }
  History history;
  std::string content_sha256;
};

}  // namespace breast
