// A projection image on the detector plane with the pose that made it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/provenance.hpp"
#include "core/types.hpp"

namespace breast {

/// Beam and image axes of the contract: n from paddle to detector, e_u = anterior (0,-1,0),
/// e_v = n × e_u. Parallel projection of patient point x: (u,v) = ((x−origin)·e_u, (x−origin)·e_v).
/// Cone: the point source stands source_distance above the detector's chest-wall edge at (0,
/// source_v).
struct ViewPose {
  Vec3 n{0, 0, -1}, e_u{0, -1, 0}, e_v{-1, 0, 0};
  Vec3 origin{0, 0,
              0};  ///< mm, LPS, on the detector plane; image (u,v) = (0,0) is pixel (0,0)'s centre
  double angle_deg = 0;
  double source_distance = 0;  ///< mm from detector to point source; 0 = parallel beam
  double source_v = 0;         ///< mm

  Vec3 source() const { return origin + source_v * e_v - source_distance * n; }
  Vec3 on_detector(const Vec2& uv) const { return origin + uv.x() * e_u + uv.y() * e_v; }
  Vec2 project(const Vec3& patient) const;
};
/// n = (s sin θ, 0, −cos θ), s = lateral_sign(side).
ViewPose view_pose(Side side, double angle_deg);
/// Default beam angle of "CC" (0), "MLO" (45), "ML" (90) in degrees; throws Error (input)
/// otherwise.
double view_angle_deg(const std::string& view);

struct Mammogram {
  ViewPose pose;
  std::string view;
  Side side = Side::left;
  int width = 0, height = 0;  ///< pixels along u and v
  double pixel = 0.25;        ///< mm
  double plate_edge_u = 0;    ///< mm, where the plates' flats begin; behind it tissue is thicker
  std::string energy =
      "fraction";                ///< what `path` is: "fraction" (mm), "20 keV", a spectrum's name
  std::vector<float> path;       ///< line integral (or tissue-weighted mm) per pixel, u fastest
  std::vector<float> thickness;  ///< mm of tissue along each ray
  std::vector<float> fibroglandular;  ///< mm of fibroglandular tissue along each ray
  /// 1: the column leaves the mesh through the chest wall or the cut; nothing is known of it and
  /// the other arrays hold 0.
  std::vector<std::uint8_t> through_back;
  History history;
  std::string content_sha256;
};

}  // namespace breast
