// SPDX-License-Identifier: GPL-3.0-or-later
// Both mammograms of a patient with the two simulated views: points in their pixels, curves drawn
// on them, and the uncertainty that the registration adds to the band.
#pragma once

#include <string>
#include <vector>

#include "core/table.hpp"
#include "image/colour_picture.hpp"
#include "matching/aligned_view.hpp"
#include "matching/match_queries.hpp"

namespace breast {

/// One image with its source and the nipple in pixels, if it was marked.
struct PatientImage {
  MammogramScan scan;
  std::string where;
  std::optional<Vec2> nipple;
};

class PatientViews {
 public:
  /// Images of the matcher's first and second view. Throws Error (input), see AlignedView.
  PatientViews(PatientImage from, PatientImage to, const Matcher& matcher);

  const AlignedView& from() const { return from_; }
  const AlignedView& to() const { return to_; }
  /// The priors with alignment_from and alignment_to added.
  std::vector<Prior> with_alignment(std::vector<Prior> priors) const;
  /// The second image with the registered outline, bands, curve, arc and nipple drawn over it, for
  /// every query.
  ColourPicture picture(const Matcher& matcher, const std::vector<MatchResult>& results) const;
  void report(Report& report) const;
  std::vector<std::string> remarks() const;
  std::vector<std::string> doubts() const;

 private:
  AlignedView from_, to_;
};

/// One row per point of every curve: query, stretch, depth_mm, TO_u_mm and TO_v_mm (TO is the name of the
/// second view), deviation_mm ("-" without band), and with `views` the curve and both edges of the
/// 95 % band in pixels of the patient's second image.
Table curve_points_table(const Matcher& matcher, const std::vector<MatchResult>& results,
                         const PatientViews* views);

}  // namespace breast
