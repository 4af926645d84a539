// SPDX-License-Identifier: GPL-3.0-or-later
// Bicubic Hermite sheets (C1 across patches) and the breast's geometry made of two of them.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/provenance.hpp"
#include "core/types.hpp"
#include "surface/thorax.hpp"

namespace breast {

/// Position and derivatives at one parameter (s,t) of a sheet.
struct SheetPoint {
  Vec3 x;
  Vec3 x_s, x_t;        ///< first derivatives with respect to (s,t) in [0,1]^2
  Vec3 normal() const;  ///< unit x_s × x_t
};

/// One tensor-product bicubic Hermite sheet over [0,1]^2 with nu × nv patches (docs/methods.md,
/// section 2). In patch coordinates ξ,η ∈ [0,1],
///
///     x = Σ H0iH0j x + H1iH0j S1 x_1 + H0iH1j S2 x_2 + H1iH1j S1S2 x_12
///
/// with H00 = 1−3ξ²+2ξ³, H10 = ξ(ξ−1)², H01 = ξ²(3−2ξ), H11 = ξ²(ξ−1). The scale factors S belong
/// to nodes, so that the sheet is C1 across patches of equal parameter width.
struct HermiteSheet {
  struct Node {
    Vec3 x = Vec3::Zero(), x_1 = Vec3::Zero(), x_2 = Vec3::Zero(), x_12 = Vec3::Zero();
    double scale_1 = 1, scale_2 = 1;
  };
  int nu = 0, nv = 0;
  std::vector<Node> nodes;  ///< (nu+1)*(nv+1), s index fastest

  Node& node(int i, int j) { return nodes[std::size_t(j) * (nu + 1) + i]; }
  const Node& node(int i, int j) const { return nodes[std::size_t(j) * (nu + 1) + i]; }
  /// Parameters outside [0,1]^2 are clamped to the border.
  Vec3 position(const Vec2& st) const;
  SheetPoint evaluate(const Vec2& st) const;
};

enum class RimEnd : std::uint8_t { thin_tissue = 0, slope = 1, margin = 2 };

/// Geometry of one breast: two sheets larger than the body, and the rim where the body ends.
/// The body is the skin inside rim.skin, the wall inside rim.wall, and the cut surface of straight
/// segments joining rim point i of the skin to rim point i of the wall.
struct BreastGeometry {
  Side side = Side::left;
  HermiteSheet skin;
  HermiteSheet wall;
  /// The surface of the chest wall and the thorax around it, on which the breast slides; absent in
  /// files of earlier versions.
  std::optional<ThoraxSurface> thorax;
  /// Closed curves with the same number of points (≥ 32, first not repeated), counter-clockwise in
  /// (s,t).
  std::vector<Vec2> rim_skin, rim_wall;
  std::vector<RimEnd> rim_end;
  Vec2 centre{0.5, 0.5};  ///< pole of the polar rim description in the skin's (s,t)
  Vec2 nipple_st{0.5, 0.5};
  Vec3 nipple{0, 0, 0};       ///< closest point on the skin sheet (mm, LPS)
  double skin_thickness = 0;  ///< mm as measured by segment, 0 unknown
  double fit_mean_mm = 0, fit_p95_mm = 0, fit_max_mm = 0;
  History history;
  std::string content_sha256;
};

}  // namespace breast
