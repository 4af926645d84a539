// SPDX-License-Identifier: GPL-3.0-or-later
// Identification of a patient's own material set from her breast in two postures.
#pragma once

#include "identification/knowledge.hpp"
#include "identification/prior.hpp"
#include "identification/second_posture.hpp"
#include "solve/least_squares.hpp"

namespace breast {

struct IdentifyOptions {
  MechanicsOptions mechanics;  ///< its materials and supports are the centre of the prior
  Vec3 imaged_gravity{0, -9810, 0}, gravity{0, 9810, 0};  ///< mm/s²
  std::vector<std::string> parameters;                    ///< empty for all that the set has
  PriorKind prior = PriorKind::set;
  bool align = false;
  double shift_mm = 4,
         turn_deg = 2;  ///< expected motion of the rib cage, rms in space
  /// The same as a covariance of shift (mm) and rotation (degrees), if more is known about it.
  std::optional<Eigen::Matrix<double, 6, 6>> motion_covariance = {};
  int max_pairs = 25;          ///< limit on pairs of backward and forward solves
  bool curvature = true;       ///< whether the covariance is widened by curvature
  Eigen::VectorXd start = {};  ///< initial logarithms; empty for the centre of the prior
};

/// Probability below which a misfit is reported.
inline constexpr double misfit_level = 0.01;

/// Fit of one landmark, mm.
struct LandmarkFit {
  std::string name;
  Vec3 predicted{0, 0, 0};  ///< its position in the frame of the observations
  Vec3 without{0, 0, 0};    ///< the same as predicted by the other data without this landmark,
                            ///< linearised
  double residual = 0;
  double left_out = 0;  ///< distance of `without` from the observed position
  double observer = 0;  ///< rms of the observer's error in space
};

struct Identified {
  std::vector<std::string> names;  ///< names of the material parameters
  LeastSquaresResult fit;          ///< residuals and Jacobian with the prior's rows last
  Eigen::MatrixXd covariance;      ///< covariance of all unknowns, widened by curvature
  Eigen::MatrixXd prior;           ///< prior covariance of the material parameters
  RigidMotion motion;
  HexMesh second;  ///< the second posture found, in the frame of the mesh
  std::vector<KnownDirection> directions;
  std::vector<LandmarkFit> landmarks;
  double decided = 0;  ///< number of values of the material set that the data determine
  Misfit misfit;
  /// If the misfit test fails, the factor by which the variances of the data must exceed the stated
  /// ones; the covariance includes it. Otherwise 1.
  double discount = 1;
  MaterialSet materials;              ///< with supports and uncertainty
  std::vector<std::string> refusals;  ///< reasons why trial points had no solution
  int pairs = 0;                      ///< number of pairs of backward and forward solves
  std::size_t surface_points = 0;

  double factor(std::size_t k) const { return std::exp(fit.x[Eigen::Index(k)]); }
  double ln_sd(std::size_t k) const {
    return std::sqrt(covariance(Eigen::Index(k), Eigen::Index(k)));
  }
};

/// Weighted nonlinear least squares of the observations and the prior; the unknowns are the
/// logarithms of factors on the parts of the material set and, if requested, the motion of the rib
/// cage. A point without a stable equilibrium shortens the step. The covariance is (JᵀJ)⁻¹ at the
/// solution, widened by curvature: along each direction that the data leave open, the model is
/// solved at one standard deviation to either side, and the change of the best-known directions
/// that compensates its curvature is added to their uncertainty. Throws Error (input) if there are
/// fewer data than parameters without a prior, and Error (not converged) if no stable body is found
/// near the centre of the prior.
Identified identify(const HexMesh& mesh, const Observations& seen, const IdentifyOptions& options,
                    Progress& progress = no_progress());

}  // namespace breast
