// SPDX-License-Identifier: GPL-3.0-or-later
// The quantity that a simulated mammogram projects (`path`): tissue thickness or attenuation.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace breast {

/// Thickness in mm of each tissue along one ray.
struct TissuePath {
  double fat = 0, fibroglandular = 0, skin = 0, tumour = 0, muscle = 0;
  double total() const { return fat + fibroglandular + skin + tumour + muscle; }
};

/// Linear attenuation coefficients in 1/mm at one energy; muscle attenuates as fibroglandular tissue.
struct Attenuation {
  double fat = 0, fibroglandular = 0, skin = 0, tumour = 0;
};

/// Conversion of the tissue along a ray to one number.
class Energy {
 public:
  /// "fraction": mm of fibroglandular-equivalent tissue, fat counting half (the grey of
  /// Pathmanathan et al. 2008, chosen from the proportions of fat, fibroglandular tissue and air in
  /// a column).
  Energy() = default;
  /// The line integral −ln Σ w exp(−Σ μ mm) / Σ w, with one weight and one row of coefficients per
  /// energy.
  Energy(std::string name, const std::vector<double>& weights,
         const std::vector<Attenuation>& attenuation);

  double path(const TissuePath& mm) const;
  const std::string& name() const { return name_; }

 private:
  std::string name_ = "fraction";
  Eigen::ArrayXf weights_;  ///< empty for "fraction"; sum 1
  Eigen::ArrayXf fat_, fibroglandular_, skin_, tumour_;
};

}  // namespace breast
