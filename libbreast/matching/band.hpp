// SPDX-License-Identifier: GPL-3.0-or-later
// Uncertainty band of the matched curve: the uncertainty of parameters and marking, propagated to
// the second image by derivatives of the two compressed shapes.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "core/table.hpp"
#include "matching/correspondence.hpp"

namespace breast {

/// Nodal derivative of a shape with respect to one parameter, mm per unit of the parameter.
using NodalField = std::vector<Vec3>;
/// Derivatives by parameter name (HexMesh::derivatives, tool sensitivity).
using DerivativeFields = std::map<std::string, NodalField>;

/// Standard deviation of a parameter, in the unit of its derivative (1 for a relative change,
/// degree, mm).
struct Prior {
  std::string parameter;
  double deviation = 0;
  std::string unit, source;
};
/// The default priors; see the table in band_priors.cpp for values and sources.
std::vector<Prior> default_priors();
/// The default priors with their sources as one paragraph, for help texts.
std::string default_priors_text();
/// Reads a table with columns parameter and standard_deviation; columns named unit and source are
/// kept.
std::vector<Prior> priors_from(const Table& table, const std::string& where);

/// A point of the band, with the standard deviation across the curve on either side of it, mm.
struct BandPoint {
  Vec2 uv;      ///< point of the curve, second image
  Vec2 normal;  ///< unit, across the curve
  double deviation = 0;
};
struct Band {
  std::vector<BandPoint> points;           ///< one per point of the curve
  std::map<std::string, double> by_cause;  ///< root mean square over the curve, mm
  double area_95 = 0;                      ///< mm² of the 95 % band
};
inline constexpr double half_width_50 = 0.6744897502, half_width_95 = 1.9599639845;

/// Linear propagation. If a parameter changes, the projection in the second image of the point that
/// is projected to a fixed position in the first moves by y' = π[x'_to − (∂x_to/∂ξ)(∂x_from/∂ξ)⁻¹
/// x'_from]; only the component across the curve counts. Parameters of the breast act on both
/// shapes together; those of a compression ("thickness", "angle", "standoff", "detector") are
/// independent in the two. With "angle" the detector rotates about the centre of the shape.
/// "repositioning" (mm) shifts the breast in each image, and "chain" is the chain's own error in
/// the second. The priors "picking" and "alignment_from" (mm) are errors of the mark along each
/// axis of the first image, "marking" and "alignment_to" errors of the position that is compared
/// with the curve in the second.
class BandModel {
 public:
  /// Keeps references. Throws Error (input) for a field that does not have a vector per node.
  BandModel(const Matcher& matcher, const DerivativeFields& from, const DerivativeFields& to,
            std::vector<Prior> priors);
  Band band(const MatchedCurve& curve) const;
  /// Priors that are not included, because the meshes have no derivative for them.
  const std::vector<std::string>& without() const { return without_; }
  std::string what_is_missing() const;  ///< the missing priors as a sentence
  /// True if no parameter has a derivative in both files, so that only errors of images and marks
  /// remain and the band says nothing about the model.
  bool counts_marks_only() const { return causes_.empty() && !without_.empty(); }

 private:
  struct Cause {
    std::string name;
    double deviation = 0;
    const NodalField *from = nullptr, *to = nullptr;
    bool turns = false;  ///< the beam turns with the compression
  };
  /// Motion in mm of a point relative to its detector per unit of the cause.
  Vec3 moved(const HexTopology& mesh, const ImageFrame& frame, const Vec3& centre,
             const NodalField& field, const ColumnPoint& point, const Vec3& at, bool turns) const;
  /// Shift of a curve point in the second image for one standard deviation of the cause.
  Vec2 shift(const ColumnPoint& point, const Mat3& carry, const Cause& cause) const;

  const Matcher& matcher_;
  std::vector<Cause> causes_;
  std::vector<std::string> without_;
  Vec3 from_centre_, to_centre_;  ///< centres of the two shapes, about which a beam rotates
  /// Standard deviations in mm along each axis of the first and of the second image, by cause.
  std::vector<std::pair<std::string, double>> in_first_, in_second_;
};

/// Signed distance across the curve from its nearest point, divided by the standard deviation
/// there: within ±1.96 for 95 % of true positions if the band is correct.
double standardised_distance(const Band& band, const Vec2& uv);

/// Centre of a shape's bounding box (mm), about which beam and detector rotate with the angle.
Vec3 turning_centre(const std::vector<Vec3>& points);

}  // namespace breast
