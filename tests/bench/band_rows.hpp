// SPDX-License-Identifier: GPL-3.0-or-later
// What the programs share that judge the band of cc2mlo against true places: which places, where a
// turned detector shows them, the row that tabulate coverage reads.
#pragma once

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "matching/band.hpp"
#include "mesh/shape.hpp"

namespace breast {

inline double prior(const std::string& name, double spread) {
  for (const Prior& p : default_priors()) {
    if (p.parameter == name) return spread * p.deviation;
  }
  throw input_error("no prior ", name);
}

/// (u,v) in the base image of a place seen by a detector that has turned about `centre` (band.hpp).
inline Vec2 seen(const Vec3& x, const Vec3& centre, const ImageFrame& base, Side side,
                 double turned) {
  const ViewPose pose = view_pose(side, base.pose.angle_deg + turned, base.pose.turn_deg,
                                  base.pose.lean_deg, base.pose.bend_deg);
  return base.pose.project(centre) + Vec2((x - centre).dot(pose.e_u), (x - centre).dot(pose.e_v));
}

/// Elements of a body in CC and MLO compression whose middle both base images show, at most `most`
/// of them, spread over its mesh.
inline std::vector<int> shown_elements(const Matcher& base, const std::array<HexMesh, 2>& body,
                                       std::size_t most) {
  constexpr double inside = 5;  // mm in front of the posterior edge
  std::vector<int> shown;
  for (int e = 0; e < body[0].elements(); ++e) {
    const auto u = [&](const HexMesh& mesh, const ImageFrame& frame) {
      return frame.pose.project(element_position(mesh, mesh.points, e, Vec3::Zero())).x();
    };
    if (u(body[0], base.from_frame()) > inside && u(body[1], base.to_frame()) > inside) {
      shown.push_back(e);
    }
  }
  std::vector<int> chosen;
  const std::size_t count = std::min(most, shown.size());
  for (std::size_t k = 0; k < count; ++k) chosen.push_back(shown[k * shown.size() / count]);
  return chosen;
}

/// sample, place, distance_mm across the curve at its nearest point,
/// deviation_mm of the band there.
inline void print_row(int sample, int place, const Band& band, const Vec2& truth) {
  const BandPoint* nearest = nullptr;
  for (const BandPoint& point : band.points) {
    if (nearest == nullptr || (truth - point.uv).norm() < (truth - nearest->uv).norm()) {
      nearest = &point;
    }
  }
  std::printf("%d\t%d\t%.4f\t%.4f\n", sample, place, (truth - nearest->uv).dot(nearest->normal),
              nearest->deviation);
}

}  // namespace breast
