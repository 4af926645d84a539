// SPDX-License-Identifier: GPL-3.0-or-later
// How far a segmentation is, by the time that its stages take.
#pragma once

#include <array>
#include <cstddef>

#include "core/progress.hpp"

namespace breast {

/// Where a stage of segment_breast() begins, as a share of all of them. `Pace` converts it into a share of the time.
namespace stage_begin {
inline constexpr double body = 0, first_wall = 0.2, second_wall = 0.4, muscle = 0.5, tissue = 0.6,
                        breast = 0.7, gland = 0.8, result = 0.9;
}

/// Passes progress on with its fraction turned into the share of the time. The body takes time by the voxels of the scan
/// and by those of the working grid, bias and wall by the latter alone, tissue by the scan's voxels of the chosen side:
/// of a scan of 35 million voxels tissue takes four fifths, of one of 2.6 million a quarter.
class Pace final : public Progress {
 public:
  Pace(Progress& shown, std::size_t scanned, std::size_t working, std::size_t of_side);
  void update(std::string_view stage, double fraction, std::string_view detail) override;
  void note(std::string_view text) override { shown_.note(text); }
  /// The share of the time that has passed at a fraction in [0,1].
  double passed(double fraction) const;

 private:
  Progress& shown_;
  std::array<double, 9> passed_{};  ///< at the beginning of each stage, and at the end
};

}  // namespace breast
