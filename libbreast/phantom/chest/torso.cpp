// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/chest/torso.hpp"

#include <algorithm>
#include <cmath>

#include "core/elementary.hpp"
#include "phantom/normal.hpp"
#include "phantom/random.hpp"

namespace breast {

double smooth_step(double value, double low, double high) {
  const double t = std::clamp((value - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// (f − 1)/|∇f| of the section's superellipse, where f is homogeneous of degree one about the centre
// of the section.
double Torso::smooth_distance(const Vec3& x) const {
  const double v = x.y() - centre(x.z());
  const double qx = std::abs(x.x()) / p_.half_width, qy = std::abs(v) / p_.half_depth;
  const double px = elementary::pow(qx, p_.power - 1), py = elementary::pow(qy, p_.power - 1);
  const double sum = px * qx + py * qy;
  if (sum < 1e-6) return -std::min(p_.half_width, p_.half_depth);
  const double f = elementary::pow(sum, 1 / p_.power);
  const double fx = f / sum * px / p_.half_width, fy = f / sum * py / p_.half_depth;
  const double fz = fy * (p_.tilt + 2 * p_.bend * x.z());
  return (f - 1) / std::sqrt(fx * fx + fy * fy + fz * fz);
}

double Torso::groove(const Vec3& x) const {
  const double front = smooth_step(centre(x.z()) - x.y(), 0, 0.6 * p_.half_depth);
  const double across = x.x() / 15;
  return p_.sternal_groove * elementary::exp(-across * across) * front;
}

double Torso::fat_thickness(const Vec3& x) const {
  return p_.fat_medial + (p_.fat_lateral - p_.fat_medial) * smooth_step(std::abs(x.x()), 15, 150);
}

double Torso::wall_distance(const Vec3& x) const {
  return smooth_distance(x) + groove(x);
}

double Torso::skin_distance(const Vec3& x) const {
  return smooth_distance(x) - fat_thickness(x);
}

Torso::Distances Torso::distances(const Vec3& x) const {
  const double smooth = smooth_distance(x);
  return {smooth - fat_thickness(x), smooth + groove(x)};
}

Vec3 Torso::wall_normal(const Vec3& x) const {
  return level_set_normal([this](const Vec3& at) { return wall_distance(at); }, x);
}

Vec3 Torso::wall_point(double x, double z) const {
  double outside = centre(z) - 1.5 * p_.half_depth, inside = centre(z);
  for (int i = 0; i < 60; ++i) {
    const double y = 0.5 * (outside + inside);
    (wall_distance({x, y, z}) > 0 ? outside : inside) = y;
  }
  return {x, inside, z};
}

// 1 in front and 0 at the back, with a smooth transition at the flank.
double Torso::frontness(const Vec3& x) const {
  return smooth_step(centre(x.z()) - x.y(), -25, 45);
}

Matter Torso::interior(const Vec3& x, double depth) const {
  const double across = std::abs(x.x());
  // The muscles: pectoralis major from the sternum to the axilla, thinner below the sixth rib;
  // serratus and latissimus at the side; the erector spinae beside the spine at the back.
  const double pectoral = smooth_step(across, 4, 22) * smooth_step(x.z(), -75, -25);
  const double front = 2.5 + 2.5 * smooth_step(across, 4, 22) + 6 * pectoral;
  const double back = 9 + 22 * smooth_step(60 - across, 0, 25);
  const double w = frontness(x);
  double muscle = w * front + (1 - w) * back;
  if (depth > muscle + 16) return thorax(x);
  muscle += 1.5 * lattice_noise(seed_ + 5, x / 30);
  if (depth < muscle) {
    // Fat planes along the fibres, as seen within every pectoral muscle.
    const double strand =
        lattice_noise(seed_ + 6, {x.x() / 45, depth / 3.0, (x.z() + 0.5 * across) / 18});
    return strand > 0.55 ? Matter::ligament : Matter::muscle;
  }
  const double bone = 9, plane = 1.1;
  const double into = depth - muscle - plane;
  if (into < 0) return Matter::fat;
  if (into < bone) return bone_layer(x, into / bone);
  if (into < bone + 0.8) return Matter::fat;
  return thorax(x);
}

// Ribs run obliquely: anterior ends lower. Costal cartilage near the sternum. `depth` in [0,1].
Matter Torso::bone_layer(const Vec3& x, double depth) const {
  const double across = std::abs(x.x());
  const bool front = x.y() < centre(x.z());
  const double radial = 2 * depth - 1;
  if (front && across < 17) {
    const double edge = std::max(std::abs(radial), across / 17);
    return edge > 0.80 ? Matter::cortex : Matter::marrow;
  }
  const double run = front ? 0.32 * across : 0.32 * (2 * p_.half_width - across);
  const double phase = (x.z() - run + 3 * lattice_noise(seed_ + 7, x / 60)) / 27.0;
  const double vertical = (phase - std::floor(phase) - 0.5) * 27.0 / 6.8;
  const double rib = std::hypot(vertical, radial);
  if (rib > 1) return depth > 0.12 && depth < 0.9 ? Matter::muscle : Matter::fat;
  if (front && across < 58) return rib > 0.93 ? Matter::fat : Matter::cartilage;
  return rib > 0.72 ? Matter::cortex : Matter::marrow;
}

Matter Torso::thorax(const Vec3& x) const {
  const double back = 2 * p_.half_depth + centre(x.z()) - p_.half_depth;
  // Vertebral body with canal and spinous process, aorta beside it.
  const Vec3 spine(0, back - 52, x.z());
  const double vx = (x.x() - spine.x()) / 20, vy = (x.y() - spine.y()) / 16;
  const double vertebra = std::sqrt(vx * vx + vy * vy);
  if (vertebra < 1) {
    const double disc = x.z() / 25 - std::floor(x.z() / 25);
    if (disc < 0.18) return Matter::cartilage;
    return vertebra > 0.9 ? Matter::cortex : Matter::marrow;
  }
  if (std::abs(x.x()) < 13 && x.y() > spine.y() + 14) {
    return std::hypot(x.x(), x.y() - spine.y() - 22) < 7.5 ? Matter::blood : Matter::cortex;
  }
  if (std::abs(x.x()) < 42 && x.y() > spine.y() + 6) return Matter::brawn;
  if (std::hypot(x.x() - 24, x.y() - spine.y() + 12) < 11) return Matter::blood;
  // Heart, to the left and resting on the diaphragm, in a thin coat of fat.
  const Vec3 heart_centre(26, centre(x.z()) - 0.36 * p_.half_depth, -12);
  const double heart = ((x - heart_centre).cwiseQuotient(Vec3(56, 42, 56))).norm() +
                       0.05 * lattice_noise(seed_ + 8, x / 20);
  if (heart < 0.80) {
    const double cavity =
        ((x - heart_centre - Vec3(4, 3, 2)).cwiseQuotient(Vec3(36, 26, 36))).norm();
    return cavity < 0.8 ? Matter::blood : Matter::heart;
  }
  if (heart < 0.84) return Matter::fat;
  // Mediastinum between sternum and spine: fat with the great vessels.
  const double middle = std::abs(x.x() - 4 + 9 * lattice_noise(seed_ + 13, x / 35));
  if (middle < 17 && x.y() > spine.y() - 45) return Matter::brawn;
  if (middle < 8) return Matter::fat;
  // Liver under the right dome of the diaphragm; the left dome covers the stomach.
  const double right = (x - Vec3(-62, centre(-40), -138)).cwiseQuotient(Vec3(92, 92, 92)).norm();
  if (right < 1) {
    const double vessel = lattice_noise(seed_ + 9, x / 16);
    return std::abs(vessel) < 0.03 ? Matter::blood : Matter::liver;
  }
  const double left = (x - Vec3(72, centre(-40), -148)).cwiseQuotient(Vec3(80, 88, 88)).norm();
  if (left < 1) return Matter::brawn;
  const double vessel = std::abs(lattice_noise(seed_ + 10, x / 24)) +
                        std::abs(lattice_noise(seed_ + 12, x / 24 + Vec3(7, 3, 5)));
  return vessel < 0.11 ? Matter::blood : Matter::lung;
}

}  // namespace breast
