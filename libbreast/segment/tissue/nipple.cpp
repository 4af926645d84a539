// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/tissue/nipple.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "segment/grid/filters.hpp"
#include "segment/tissue/skin_patch.hpp"

namespace breast {

namespace {

constexpr double ring_inside = 9, ring_outside = 25;  // mm: the areola's surface without papilla
// Less (mm, voxels' longest edge) is a smooth dome with steps.
constexpr double least_height = 1, least_steps = 0.6;

struct Apex {
  Vec3 extreme, chosen;  // mm from the grid's first voxel
};

/// Skin of the breast with nothing of the body beyond it within `reach` mm: where it ends, edges are convex too.
bool well_inside(const Mask& breast, const Mask& body, int i, int j, int k, double reach) {
  const Grid& grid = breast.grid;
  std::array<int, 3> steps;
  for (int d = 0; d < 3; ++d) steps[std::size_t(d)] = int(reach / grid.spacing[d]);
  for (int c = k - steps[2]; c <= k + steps[2]; c += std::max(1, steps[2] / 2)) {
    for (int b = j - steps[1]; b <= j + steps[1]; b += std::max(1, steps[1] / 4)) {
      for (int a = i - steps[0]; a <= i + steps[0]; a += std::max(1, steps[0] / 4)) {
        if (grid.contains(a, b, c) && body.at(a, b, c) && !breast.at(a, b, c)) return false;
      }
    }
  }
  return true;
}

/// The most convex point of a supine breast's skin.
Apex find_apex_anywhere(const Mask& breast, const Mask& body, const Volume<float>& share) {
  constexpr double from_end = 15;  // mm
  const Grid& grid = breast.grid;
  Apex apex{Vec3::Zero(), Vec3::Zero()};
  float least = 1;
  for (int k = 1; k + 1 < grid.size[2]; ++k) {
    for (int j = 1; j + 1 < grid.size[1]; ++j) {
      for (int i = 1; i + 1 < grid.size[0]; ++i) {
        if (!breast.at(i, j, k) || !(share.at(i, j, k) < least)) continue;
        const bool skin = !body.at(i, j - 1, k) || !body.at(i - 1, j, k) || !body.at(i + 1, j, k);
        if (!skin || !well_inside(breast, body, i, j, k, from_end)) continue;
        least = share.at(i, j, k);
        apex.chosen = grid.spacing.cwiseProduct(Vec3(i, j, k));
      }
    }
  }
  if (!(least < 1)) throw failed_error("the breast has no skin apart from its border");
  apex.extreme = apex.chosen;
  return apex;
}

/// Most anterior and most convex point of the skin.
Apex find_apex(const Mask& breast, const Mask& body, Posture posture) {
  const Grid& grid = breast.grid;
  Volume<float> filled(grid);
  for (std::size_t n = 0; n < filled.voxels.size(); ++n) filled.voxels[n] = body.voxels[n];
  const Volume<float> share = gaussian(filled, 4.5);
  if (posture != Posture::prone) return find_apex_anywhere(breast, body, share);
  Vec3 extreme(0, 1e9, 0);
  std::vector<Vec3> candidates;
  std::vector<float> convexity;
  for (int j = 0; j < grid.size[1]; ++j) {
    if ((j - 30 / grid.spacing[1]) * grid.spacing[1] > extreme[1]) break;
    for (int k = 0; k < grid.size[2]; ++k) {
      for (int i = 0; i < grid.size[0]; ++i) {
        if (!breast.at(i, j, k) || (j > 0 && body.at(i, j - 1, k))) continue;
        const Vec3 place = grid.spacing.cwiseProduct(Vec3(i, j - 0.5, k));
        if (place[1] < extreme[1]) extreme = place;
        candidates.push_back(place);
        convexity.push_back(share.at(i, j, k));
      }
    }
  }
  if (candidates.empty()) throw failed_error("the breast has no skin");
  Apex apex{extreme, extreme};
  double best = 1e9;
  for (std::size_t n = 0; n < candidates.size(); ++n) {
    if ((candidates[n] - extreme).norm() > 25) continue;
    // Depth behind the front breaks ties on a smooth dome: there the most anterior point is meant.
    const double score = convexity[n] + 0.02 * (candidates[n][1] - extreme[1]);
    if (score < best) {
      best = score;
      apex.chosen = candidates[n];
    }
  }
  return apex;
}

/// What stands out of the ring's surface: its centre (u, v) and greatest height, averaged over
/// discs of 2 mm.
struct Papilla {
  double a = 0, b = 0, height = 0;
};

Papilla standing_out(const std::vector<SkinFace>& faces, const TangentFrame& frame,
                     const Quadric& ring) {
  struct Sample {
    double a, b, height, area;
  };
  std::vector<Sample> samples;
  for (const SkinFace& face : faces) {
    const Vec3 p = frame.local(face.centre);
    const double seen = face.area.dot(frame.out);
    if (!(std::hypot(p[0], p[1]) < ring_inside + 2 && seen > 0)) continue;
    samples.push_back({p[0], p[1], p[2] - ring.dot(monomials(p[0], p[1])), seen});
  }
  std::vector<double> mean(samples.size(), 0);
  Papilla papilla;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    double area = 0;
    for (const Sample& other : samples) {
      if (std::hypot(other.a - samples[n].a, other.b - samples[n].b) > 2) continue;
      mean[n] += other.area * other.height;
      area += other.area;
    }
    mean[n] /= area;
    if (std::hypot(samples[n].a, samples[n].b) < ring_inside)
      papilla.height = std::max(papilla.height, mean[n]);
  }
  double total = 0;
  for (std::size_t n = 0; n < samples.size(); ++n) {
    const double weight = samples[n].area * std::max(0.0, mean[n] - 0.5 * papilla.height);
    papilla.a += weight * samples[n].a;
    papilla.b += weight * samples[n].b;
    total += weight;
  }
  if (total > 0) papilla.a /= total, papilla.b /= total;
  return papilla;
}

/// Most anterior point of a quadric through the skin about `start`: the apex of a smooth dome.
Vec3 dome_apex(const Mask& body, const Vec3& start) {
  constexpr double radius = 20;
  const std::vector<SkinFace> faces = skin_faces(body, start, radius);
  const TangentFrame frame = tangent_frame(faces, start);
  const Quadric q = quadric_through(faces, frame, 0, radius);
  // Stationary point of y = u_y a + v_y b + out_y h(a, b).
  const double s = frame.out[1];
  Eigen::Matrix2d matrix;
  matrix << 2 * s * q[3], s * q[4], s * q[4], 2 * s * q[5];
  const Vec2 right(-frame.u[1] - s * q[1], -frame.v[1] - s * q[2]);
  const bool convex = matrix.determinant() > 0 && matrix(0, 0) > 0;
  const Vec2 at = matrix.inverse() * right;
  if (!convex || !(at.norm() < radius)) return start;
  return frame.place(at[0], at[1], q.dot(monomials(at[0], at[1])));
}

}  // namespace

Nipple find_nipple(const Mask& breast, const Mask& body, Posture posture) {
  const Apex apex = find_apex(breast, body, posture);
  Vec3 tip = apex.chosen, base = apex.chosen;
  double height = 0;
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<SkinFace> faces = skin_faces(body, tip, ring_outside + 8);
    const TangentFrame frame = tangent_frame(faces, tip);
    const Quadric ring = quadric_through(faces, frame, ring_inside, ring_outside);
    const Papilla papilla = standing_out(faces, frame, ring);
    // Near the field of view's edge the ring may lie to one side only and say nothing.
    const double least = std::max(least_height, least_steps * breast.grid.spacing.maxCoeff());
    if (!(papilla.height > least && papilla.height < 20)) {
      if (round == 0 && posture == Posture::prone) tip = base = dome_apex(body, tip);
      break;
    }
    const double foot = ring.dot(monomials(papilla.a, papilla.b));
    tip = frame.place(papilla.a, papilla.b, foot + papilla.height);
    base = frame.place(papilla.a, papilla.b, foot);
    height = papilla.height;
  }
  Nipple nipple;
  const auto patient = [&](const Vec3& p) {
    return breast.grid.to_patient(p.cwiseQuotient(breast.grid.spacing));
  };
  nipple.tip = patient(tip);
  nipple.base = patient(base);
  nipple.height = height;
  nipple.from_extreme = (tip - apex.extreme).norm();
  nipple.extreme = patient(apex.extreme);
  return nipple;
}

}  // namespace breast
