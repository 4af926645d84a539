// SPDX-License-Identifier: GPL-3.0-or-later
// Fit of stiffness and supports to the average motion of women's breasts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "contact/compression.hpp"
#include "core/progress.hpp"
#include "mesh/hex_mesh.hpp"
#include "solve/least_squares.hpp"

namespace breast {

/// Factors on the laws of a material set, and the supports of wall and cut.
struct Softness {
  double low_order = 0.03;  ///< on the constants that are linear in I1 and I2
  double quadratic = 0.3;   ///< on the other constants
  double skin = 1;          ///< on the law of skin
  std::string wall = "slide:0.01", cut = "spring:0.01";
};

/// The model of `base` scaled by these factors, with these supports. Muscle keeps its own law, or has that
/// of fibroglandular tissue times the factor `muscle` if it is given. Throws Error (input) when the law of
/// fat or fibroglandular tissue has no quadratic terms.
MechanicsOptions softened(const MaterialSet& base, const Softness& softness,
                          std::optional<double> muscle = {});

/// A mean over women, mm or kPa, and the standard deviation among them.
struct Observed {
  std::string quantity;
  double mean = 0, sd = 0;
  /// Standard deviation of the mean that no model here explains, such as that of the arms' place.
  double unmodelled = 0;
};

/// A breast imaged prone, with its wall surface. Breasts of one woman share her weight in every mean.
struct CohortBreast {
  std::string name, woman;
  HexMesh mesh;
};

/// The breast between plates that the fit sees, and the mean pressure of the paddle on it.
struct PressedBreast {
  HexMesh mesh;
  CompressionOptions press;
  Observed pressure{"pressure_kPa", 10, 2.5};
};

/// The data: motion of women's breasts from prone to supine, and the cohort that should match it.
struct SoftnessData {
  std::vector<CohortBreast> cohort;
  double muscle_mm = 8;
  std::optional<double> muscle_stiffness = {};  ///< relative to fibroglandular tissue
  std::vector<Observed> motion;  ///< means over `women` women, of motion_quantities()
  int women = 63;
  std::optional<PressedBreast> pressed;
  Softness expected;            ///< centre of the prior
  double expected_ln_sd = 1.1;  ///< a factor of three either way
  double law_ln_sd = 1.1;       ///< the same for low_order and quadratic
};

/// An unknown: a factor on the laws of the base, or a number of a support.
struct CalibratedParameter {
  std::string name;
  double value = 0;
};

/// The fit without one woman, by one linearised step from the fit with all.
struct WithoutWoman {
  std::string woman;
  std::vector<double> factors;    ///< of each parameter, relative to the fit with all
  std::vector<double> predicted;  ///< her own quantities with these factors
};

struct SoftnessFound {
  std::vector<CalibratedParameter> parameters;
  LeastSquaresResult fit;
  std::vector<Observed> wanted;  ///< targets, with the standard deviations used as weights
  std::vector<double> found;     ///< resulting means of the cohort, and the resulting pressure
  std::vector<std::vector<double>> of_breast;  ///< per breast, its quantities
  std::vector<WithoutWoman> without;           ///< empty for a single woman
  MaterialSet materials;                       ///< with its uncertainty
};

/// Least squares in the logarithms of low_order, quadratic, skin and the parameters of the supports. A mean over
/// the n women of the cohort is weighted by the standard error of its difference from the mean of the data, sd
/// √(1/women + 1/n), and by what is unmodelled. Throws Error (input) for a quantity that is not one of
/// motion_quantities(), and Error (not converged) if there is no equilibrium with the expected softness.
SoftnessFound calibrate_softness(const MaterialSet& base, const SoftnessData& data,
                                 Progress& progress = no_progress());

}  // namespace breast
