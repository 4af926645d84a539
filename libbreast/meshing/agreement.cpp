// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/agreement.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "core/table.hpp"
#include "image/nearest_voxel.hpp"
#include "meshing/body_map.hpp"

namespace breast {

namespace {

constexpr double most_cut_off = 0.02;
constexpr int rings = 24, around = 96;
constexpr double reach = 60, step = 0.5;  // mm along a normal

constexpr double most_mean = 2, most_p95 = 5;  // mm

/// A surface of the labels, whose inside are the voxels of one kind.
class LabelSurface {
 public:
  enum class Kind { skin, wall };
  LabelSurface(const LabelVolume& labels, Kind kind)
      : labels_(labels), voxel_(labels.grid), kind_(kind) {}

  bool inside(const Vec3& p) const {
    const std::ptrdiff_t n = voxel_.at(p);
    const Tissue tissue = n < 0 ? Tissue::air : Tissue(labels_.tissue[n]);
    return kind_ == Kind::skin ? tissue != Tissue::air : tissue == Tissue::muscle;
  }
  bool sure(const Vec3& p) const {
    if (kind_ == Kind::skin || labels_.chest_wall_confidence.empty()) return true;
    const std::ptrdiff_t n = voxel_.at(p);
    return n >= 0 && labels_.chest_wall_confidence[n] >= 0.5F;
  }
  /// Distance to the nearest place on the line along the unit outward `normal` at which the inside
  /// ends; none where there is no such place within the reach.
  std::optional<double> distance(const Vec3& p, const Vec3& normal) const {
    const double slack = voxel_.half_width(normal);
    bool outwards = inside(p), inwards = outwards;
    for (double t = step; t <= reach; t += step) {
      const bool out = inside(p + t * normal), in = inside(p - t * normal);
      if ((outwards && !out) || (in && !inwards)) return std::max(0.0, t - 0.5 * step - slack);
      outwards = out, inwards = in;
    }
    return std::nullopt;
  }

 private:
  const LabelVolume& labels_;
  NearestVoxel voxel_;
  Kind kind_;
};

template <class At>
SurfaceAgreement compare(const HermiteSheet& sheet, const At& parameters,
                         const LabelSurface& surface) {
  SurfaceAgreement result;
  std::vector<WeightedDistance> found;
  double seen = 0, sure = 0;
  for (int r = 0; r < rings; ++r) {
    for (int i = 0; i < around; ++i) {
      const double rho = (r + 0.5) / rings;
      const SheetPoint at = sheet.evaluate(parameters(rho, double(i) / around));
      if (!surface.sure(at.x)) continue;
      const double area = rho * at.x_s.cross(at.x_t).norm();
      sure += area;
      const std::optional<double> distance = surface.distance(at.x, at.normal());
      if (!distance) continue;
      seen += area;
      if (found.empty() || *distance > result.distance.max_mm) {
        result.distance.max_mm = *distance;
        result.worst = at.x;
      }
      found.push_back({*distance, area});
    }
  }
  result.distance = summarise(std::move(found));
  result.seen = sure > 0 ? seen / sure : 1;
  return result;
}

std::optional<std::string> complaint(const char* name, const SurfaceAgreement& found) {
  if (found.distance.mean_mm <= most_mean && found.distance.p95_mm <= most_p95) return std::nullopt;
  const auto mm = [](double value) { return format_fixed(value, 1); };
  return message("the geometry does not agree with the labels: its ", name, " lies ",
                 mm(found.distance.mean_mm), " mm from theirs in the mean and ",
                 mm(found.distance.p95_mm), " mm or more over a twentieth of its area (at most ",
                 mm(most_mean), " and ", mm(most_p95), "), ", mm(found.distance.max_mm), " mm at (",
                 mm(found.worst.x()), ", ", mm(found.worst.y()), ", ", mm(found.worst.z()), ") mm");
}

}  // namespace

Agreement agreement_of(const BreastGeometry& geometry, const LabelVolume& labels) {
  const BodyMap body(geometry);
  using Kind = LabelSurface::Kind;
  return {compare(
              geometry.skin, [&](double rho, double u) { return body.skin(rho, u); },
              LabelSurface(labels, Kind::skin)),
          compare(
              geometry.wall, [&](double rho, double u) { return body.wall(rho, u); },
              LabelSurface(labels, Kind::wall))};
}

std::optional<std::string> mismatch(const Agreement& agreement) {
  // A sheet that meets no surface of the labels at all belongs to another body.
  if (agreement.skin.seen < 0.5) {
    return message("the geometry does not agree with the labels: along ",
                   format_fixed(100 * (1 - agreement.skin.seen), 0),
                   " % of its skin there is no skin of the labels within ", reach, " mm");
  }
  const auto skin = complaint("skin", agreement.skin);
  return skin ? skin : complaint("chest wall", agreement.wall);
}

std::optional<std::string> too_coarse(const BodyMeshReport& body) {
  const double lost = 1 - body.mesh_volume / body.body_volume;
  if (std::abs(lost) <= most_cut_off) return std::nullopt;
  return message("the flat faces of this mesh lose ", format_fixed(100 * lost, 1),
                 " % of the body's volume (usually below ", format_fixed(100 * most_cut_off, 1),
                 " %): give more --elements");
}

}  // namespace breast
