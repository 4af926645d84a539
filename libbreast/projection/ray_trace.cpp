// SPDX-License-Identifier: GPL-3.0-or-later
// Following packets of neighbouring rays through the pieces of a RayMesh.
#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>

#include "projection/ray_mesh.hpp"

namespace breast {

namespace {

// Rays are displaced by this from the requested position, so that none runs inside a face of a mesh
// that is aligned with the pixels (as the paper's cuboid is in CC).
const Vec2 aside(3.7e-7, 7.3e-7);

// Local coordinates of a point of face f at patch coordinates (s,r).
Vec3 face_local(int f, double s, double r) {
  const auto& corners = hex_face_corners[f];
  const Vec3 p0 = Trilinear::corner(corners[0]), p1 = Trilinear::corner(corners[1]),
             p3 = Trilinear::corner(corners[3]);
  return p0 + s * (p1 - p0) + r * (p3 - p0);
}

bool starts_before(const Chord& x, const Chord& y) {
  return x.enter != y.enter ? x.enter < y.enter : x.piece < y.piece;
}

}  // namespace

// Rays along a row of the detector.
struct RayMesh::Packet {
  int rays = 0;
  Lanes foot_x, slope_x, stretch;  // u from the source's foot, that over D, mm along the ray per mm
                                   // along n
  double foot_y = 0, slope_y = 0;
  Vec2 first{0, 0};  // position of the first ray
  double step = 0;
  Box box;  // of the positions the rays pass

  bool may_meet(const Box& other) const {
    return box.upper.x() >= other.lower.x() && box.lower.x() <= other.upper.x() &&
           box.upper.y() >= other.lower.y() && box.lower.y() <= other.upper.y();
  }
};

// The crossings of one ray with the faces of a piece, in order.
struct RayMesh::Crossings {
  struct Crossing {
    double distance;
    Vec3 local;
    std::int8_t face;
  };
  std::array<Crossing, 12> list;
  int n = 0;

  void insert(const Crossing& crossing) {
    int place = n++;
    for (; place > 0 && list[place - 1].distance > crossing.distance; --place) {
      list[place] = list[place - 1];
    }
    list[place] = crossing;
  }
};

Ray RayMesh::ray(const Vec2& uv) const {
  Ray ray{pose_.on_detector(uv + aside), pose_.n};
  if (pose_.source_distance > 0) ray.direction = (ray.origin - pose_.source()).normalized();
  return ray;
}

void RayMesh::trace(const Vec2& position, std::vector<Chord>& chords) const {
  ChordPacket packet;
  packet[0].swap(chords);
  trace(position, 0, 1, packet);
  packet[0].swap(chords);
}

int RayMesh::trace(const Vec2& position, double step, int count, ChordPacket& chords) const {
  const Vec2 uv = position + aside;
  const Vec2 cell = (uv - bins_lower_) / bin_mm;
  Packet packet;
  packet.first = position;
  packet.step = step;
  const double bin_end = bins_lower_.x() + bin_mm * (std::floor(cell.x()) + 1);
  do {
    chords[packet.rays].clear();
    ++packet.rays;
  } while (packet.rays < count && uv.x() + packet.rays * step < bin_end);
  if (!(cell.minCoeff() >= 0) || cell.x() >= bins_[0] || cell.y() >= bins_[1]) return packet.rays;
  const double per_distance = pose_.source_distance > 0 ? 1 / pose_.source_distance : 0;
  packet.foot_y = uv.y() - pose_.source_v;
  packet.slope_y = per_distance * packet.foot_y;
  for (int k = 0; k < packet_rays; ++k) {  // those beyond `rays` repeat the last
    packet.foot_x.of[k] = uv.x() + std::min(k, packet.rays - 1) * step;
    const double slope = per_distance * packet.foot_x.of[k];
    packet.slope_x.of[k] = slope;
    packet.stretch.of[k] = std::sqrt(1 + slope * slope + packet.slope_y * packet.slope_y);
  }
  packet.box = {uv, Vec2(packet.foot_x.of[packet.rays - 1], uv.y())};
  const int bin = int(cell.y()) * bins_[0] + int(cell.x());
  for (int k = bin_first_[bin]; k < bin_first_[bin + 1]; ++k) {
    if (!packet.may_meet(candidates_[k].box)) continue;
    trace_piece(candidates_[k].piece, packet, chords);
  }
  for (int k = 0; k < packet.rays; ++k) {
    std::sort(chords[k].begin(), chords[k].end(), starts_before);
  }
  return packet.rays;
}

void RayMesh::trace_piece(int p, const Packet& packet, ChordPacket& chords) const {
  const Corners& corners = corners_[p];
  std::array<Lanes, 8> x, y;
  for (int a = 0; a < 8; ++a) {
    const double above = corners.y[a] - packet.foot_y - packet.slope_y * corners.t[a];
    for (int k = 0; k < packet_rays; ++k) {
      x[a].of[k] = corners.x[a] - packet.foot_x.of[k] - packet.slope_x.of[k] * corners.t[a];
      y[a].of[k] = above;
    }
  }
  std::array<Crossings, packet_rays> crossings;
  const unsigned all = (1u << packet.rays) - 1;
  unsigned crossed = 0;
  for (int f = 0; f < 6; ++f) {
    if (!packet.may_meet(face_boxes_[p][f])) continue;
    const auto& q = hex_face_corners[f];
    const PatchCorners patch{{&x[q[0]], &x[q[1]], &x[q[2]], &x[q[3]]},
                             {&y[q[0]], &y[q[1]], &y[q[2]], &y[q[3]]}};
    PatchHits hits;
    patch_hits(patch, hits);
    for (int h = 0; h < 2; ++h) {
      for (unsigned left = hits.hit[h] & all; left != 0; left &= left - 1) {
        const int k = std::countr_zero(left);
        const double s = hits.s[h].of[k], r = hits.r[h].of[k];
        const double distance =
            packet.stretch.of[k] *
            ((1 - s) * (1 - r) * corners.t[q[0]] + s * (1 - r) * corners.t[q[1]] +
             s * r * corners.t[q[2]] + (1 - s) * r * corners.t[q[3]]);
        crossings[k].insert({distance, face_local(f, s, r), std::int8_t(f)});
        crossed |= 1u << k;
      }
    }
  }
  for (; crossed != 0; crossed &= crossed - 1) {
    const int k = std::countr_zero(crossed);
    add_chords(p, packet, k, crossings[k], chords[k]);
  }
}

void RayMesh::add_chords(int p, const Packet& packet, int k, const Crossings& crossings,
                         std::vector<Chord>& chords) const {
  constexpr double shortest = 1e-9;  // mm: a ray touching an edge
  for (int i = 0; i + 1 < crossings.n; ++i) {
    const auto &in = crossings.list[i], &out = crossings.list[i + 1];
    if (!(out.distance - in.distance > shortest)) continue;
    if (crossings.n > 2) {  // curved faces: the line may leave and come back
      const Ray along = ray(packet.first + Vec2(k * packet.step, 0));
      Vec3 middle = 0.5 * (in.local + out.local);
      const bool solved =
          pieces_[p].invert(along.at(0.5 * (in.distance + out.distance)), 1e-9, middle);
      if (!solved || !(middle.cwiseAbs().maxCoeff() <= 1 + 1e-9)) continue;
    }
    chords.push_back({p, in.distance, out.distance, in.local, out.local, in.face, out.face});
  }
}

}  // namespace breast
