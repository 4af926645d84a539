// SPDX-License-Identifier: GPL-3.0-or-later
// A patient's own material set from her breast in two postures.
#pragma once

#include "identification/knowledge.hpp"
#include "identification/prior.hpp"
#include "identification/second_posture.hpp"
#include "identification/trust_region.hpp"

namespace breast {

struct IdentifyOptions {
  MechanicsOptions mechanics;  ///< its materials and supports are the middle of the prior
  Vec3 imaged_gravity{0, -9810, 0}, gravity{0, 9810, 0};  ///< mm/s²
  std::vector<std::string> parameters;                    ///< empty: all the set has
  PriorKind prior = PriorKind::set;
  bool align = false;
  double shift_mm = 4,
         turn_deg = 2;         ///< expected motion of the rib cage, rms in space
  /// The same as a covariance of shift (mm) and turn (degrees), where more is known of it.
  std::optional<Eigen::Matrix<double, 6, 6>> motion_covariance = {};
  int max_pairs = 25;          ///< solves of backward and forward, those for curvature included
  bool curvature = true;       ///< whether they are spent
  Eigen::VectorXd start = {};  ///< logarithms to begin at; empty: the middle of the prior
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
  double left_out = 0;  ///< distance of `without` from where it was seen
  double observer = 0;  ///< rms of the observer's error in space
};

struct Identified {
  std::vector<std::string>
      names;                   ///< of the logarithms, those of the rib cage's motion not among them
  TrustRegionResult fit;       ///< residuals and Jacobian with the prior's rows last
  Eigen::MatrixXd covariance;  ///< of all that is sought, with what curvature adds
  Eigen::MatrixXd prior;       ///< of the material parameters
  RigidMotion motion;
  HexMesh second;  ///< the second posture found, in the mesh's frame
  std::vector<KnownDirection> directions;
  std::vector<LandmarkFit> landmarks;
  double decided = 0;  ///< numbers of the material set decided by the data
  Misfit misfit;
  /// Where the misfit test fails, how much larger the data's variances must be than said: the
  /// covariance counts with it. 1 elsewhere.
  double discount = 1;
  MaterialSet materials;              ///< with supports and uncertainty
  std::vector<std::string> refusals;  ///< why trial points had no answer
  int pairs = 0;                      ///< of backward and forward
  std::size_t surface_points = 0;

  double factor(std::size_t k) const { return std::exp(fit.x[Eigen::Index(k)]); }
  double ln_sd(std::size_t k) const {
    return std::sqrt(covariance(Eigen::Index(k), Eigen::Index(k)));
  }
};

/// Weighted nonlinear least squares of the observations and the prior in the logarithms of the material
/// set's parts (and the rib cage's motion). Points without a stable equilibrium shorten the step. The
/// covariance is (JᵀJ)⁻¹ at the answer, widened by curvature: along each direction that the data leave
/// open the model is solved one deviation either way, and what the best known directions would have to move
/// to make up for its bend counts as their uncertainty. Throws Error (input) when there are fewer data than
/// parameters without a prior, and Error (not converged) when no stable body is found near the
/// middle of the prior.
Identified identify(const HexMesh& mesh, const Observations& seen, const IdentifyOptions& options,
                    Progress& progress = no_progress());

}  // namespace breast
