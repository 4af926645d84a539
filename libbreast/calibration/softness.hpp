// SPDX-License-Identifier: GPL-3.0-or-later
// Fit of stiffness and supports to the average motion of women's breasts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contact/compression.hpp"
#include "core/progress.hpp"
#include "material/law.hpp"
#include "mesh/hex_mesh.hpp"
#include "solve/least_squares.hpp"

namespace breast {

/// The unknowns: factors on a material set, and supports in kPa/mm.
struct Softness {
  double low_order = 0.03;  ///< on the constants of polynomial laws that are linear in I1 and I2
  double quadratic = 0.3;   ///< on the other constants
  double skin = 1;          ///< on the law of skin
  double wall = 0.01, cut = 0.01;
  std::optional<double> sternum = {};  ///< the attachment to it; absent: none

  std::vector<std::string> names() const;
  std::vector<double> values() const;
  Eigen::VectorXd logarithms() const;
  static Softness from_logarithms(const Eigen::VectorXd& x);
};

/// `base` scaled by these factors, with these supports. Muscle keeps its own law, or has that of
/// fibroglandular tissue times the factor `muscle` if it is given. Throws Error (input) when fat or
/// fibroglandular tissue has no polynomial law of equation (9).
MaterialSet softened(const MaterialSet& base, const Softness& softness,
                     std::optional<double> muscle = {});

/// A mean over women, mm or kPa, and the standard deviation among them.
struct Observed {
  std::string quantity;
  double mean = 0, sd = 0;
};

/// The data: motion of women's breasts from prone to supine, with the cohort that should match it,
/// and the mean pressure of the paddle on one breast.
struct SoftnessData {
  std::vector<HexMesh> cohort;  ///< imaged prone, with wall surfaces
  HexMesh pressed;
  double muscle_mm = 8;
  std::optional<double> muscle_stiffness = {};  ///< relative to fibroglandular tissue
  Observed lateral, posterior, ribs_change;     ///< means over `women` women
  int women = 63;
  Observed pressure{"pressure_kPa", 10, 2.5};  ///< of the paddle on `pressed`
  CompressionOptions press;                    ///< how `pressed` is compressed
  Softness expected;                           ///< centre of the prior
  double expected_ln_sd = 1.1;                 ///< a factor of three either way
};

struct SoftnessFound {
  Softness softness;
  LeastSquaresResult fit;
  std::vector<Observed> wanted;  ///< targets, with the standard deviations used as weights
  std::vector<double> found;     ///< resulting means of the cohort, and the resulting pressure
  MaterialSet materials;         ///< with its uncertainty
};

/// Least squares in the logarithms of Softness. A mean over n breasts is weighted by the standard
/// error of its difference from the women's mean, sd √(1/women + 1/n). Throws Error (not converged)
/// if there is no equilibrium with the expected softness.
SoftnessFound calibrate_softness(const MaterialSet& base, const SoftnessData& data,
                                 Progress& progress = no_progress());

}  // namespace breast
