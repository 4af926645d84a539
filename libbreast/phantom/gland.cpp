// SPDX-License-Identifier: GPL-3.0-or-later
#include "phantom/gland.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/elementary.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "phantom/random.hpp"

namespace breast {

namespace {

constexpr double reach = 7;  // largest distance from a piece that is computed, mm

// Region in which gland may grow: an ellipsoid behind the nipple, extended towards the upper outer
// quadrant, 8 mm below the skin and 6 mm from the wall.
class Region {
 public:
  Region(const BreastShape& shape, double extent) : shape_(shape) {
    const double height = (shape.apex() - shape.foot()).norm();
    const double side = lateral_sign(shape.side());
    centre_ = shape.foot() + 0.50 * height * shape.axis() +
              0.10 * shape.parameters().radius *
                  (side * shape.radial(0) + 0.7 * shape.radial(0.5 * std::numbers::pi));
    across_ = extent * shape.parameters().radius;
    along_ = 0.46 * height;
  }
  bool holds(const Vec3& x) const {
    const Vec3 d = x - centre_;
    const double h = d.dot(shape_.axis());
    const double r = (d - h * shape_.axis()).norm();
    return std::hypot(h / along_, r / across_) < 1 && shape_.skin_distance(x) < -8 &&
           shape_.torso().wall_distance(x) > 6;
  }

 private:
  const BreastShape& shape_;
  Vec3 centre_;
  double across_, along_;
};

Vec3 perturbed(const Vec3& direction, double amount, RandomStream& stream) {
  return (direction + amount * Vec3(stream.normal(), stream.normal(), stream.normal()))
      .normalized();
}

// Grows one duct with its branches; there is a lobule at the end of every twig.
class Grower {
 public:
  Grower(const Region& region, RandomStream& stream, std::vector<GlandPiece>& pieces)
      : region_(region), stream_(stream), pieces_(pieces) {}

  void grow(Vec3 at, Vec3 direction, double radius, int generation) {
    const int steps = generation == 0 ? 3 : 2;
    for (int i = 0; i < steps; ++i) {
      direction = perturbed(direction, 0.16, stream_);
      const Vec3 next = at + stream_.uniform(4.5, 8.5) * direction;
      if (generation > 0 && !region_.holds(next)) break;
      pieces_.push_back({at, next, radius, generation <= 1});
      at = next;
      if (generation >= 1 && stream_.uniform() < 0.7) lobule(at);
    }
    if (generation == 5) {
      lobule(at);
      return;
    }
    const int branches = stream_.uniform() < 0.25 ? 3 : 2;
    for (int b = 0; b < branches; ++b) {
      grow(at, perturbed(direction, 0.42, stream_), std::max(0.45, 0.82 * radius), generation + 1);
    }
  }

 private:
  void lobule(const Vec3& at) {
    const Vec3 centre = at + 2.0 * Vec3(stream_.normal(), stream_.normal(), stream_.normal());
    if (!region_.holds(centre)) return;
    const Vec3 along = 2.5 * Vec3(stream_.normal(), stream_.normal(), stream_.normal());
    pieces_.push_back({centre - along, centre + along, stream_.uniform(1.8, 4.2), false});
  }
  const Region& region_;
  RandomStream& stream_;
  std::vector<GlandPiece>& pieces_;
};

double piece_distance(const GlandPiece& piece, const Vec3& x) {
  const Vec3 along = piece.to - piece.from, d = x - piece.from;
  const double length2 = along.squaredNorm();
  const double t = length2 > 0 ? std::clamp(d.dot(along) / length2, 0.0, 1.0) : 0.0;
  return (d - t * along).norm() - piece.radius;
}

/// Sphere around a piece. No point is nearer to the piece than to the sphere, to which the
/// distance is quicker to compute.
struct Sphere {
  Vec3 centre;
  double radius;
  explicit Sphere(const GlandPiece& piece)
      : centre(0.5 * (piece.from + piece.to)),
        radius(0.5 * (piece.to - piece.from).norm() + piece.radius + rounding) {}
  bool within(double distance, const Vec3& x) const {
    const double most = distance + radius;
    return most > 0 && (x - centre).squaredNorm() < most * most;
  }
  static constexpr double rounding = 1e-9;
};

// For every bin of 8 mm the pieces that may matter within it.
class Bins {
 public:
  Bins(const std::vector<GlandPiece>& pieces, const Vec3& low, const Vec3& high) : low_(low) {
    for (int a = 0; a < 3; ++a) size_[a] = 1 + int((high[a] - low[a]) / width);
    bins_.resize(std::size_t(size_[0]) * size_[1] * size_[2]);
    for (int n = 0; n < int(pieces.size()); ++n) {
      const double margin = pieces[n].radius + reach;
      int first[3], last[3];
      for (int a = 0; a < 3; ++a) {
        first[a] = cell(std::min(pieces[n].from[a], pieces[n].to[a]) - margin, a);
        last[a] = cell(std::max(pieces[n].from[a], pieces[n].to[a]) + margin, a);
      }
      for (int k = first[2]; k <= last[2]; ++k)
        for (int j = first[1]; j <= last[1]; ++j)
          for (int i = first[0]; i <= last[0]; ++i) bins_[at(i, j, k)].push_back(n);
    }
  }
  const std::vector<int>& near(const Vec3& x) const {
    return bins_[at(cell(x[0], 0), cell(x[1], 1), cell(x[2], 2))];
  }

 private:
  static constexpr double width = 8;
  int cell(double x, int axis) const {
    return std::clamp(int(std::floor((x - low_[axis]) / width)), 0, size_[axis] - 1);
  }
  std::size_t at(int i, int j, int k) const {
    return (std::size_t(k) * size_[1] + j) * size_[0] + i;
  }
  Vec3 low_;
  int size_[3];
  std::vector<std::vector<int>> bins_;
};

}  // namespace

std::vector<GlandPiece> grow_gland(const BreastShape& shape, const GlandParameters& parameters,
                                   std::uint64_t seed) {
  std::vector<GlandPiece> pieces;
  RandomStream stream(seed);
  const Region region(shape, parameters.extent);
  Grower grower(region, stream, pieces);
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int lobe = 0; lobe < parameters.lobes; ++lobe) {
    // Lobes fan out from the nipple over a cone of about 60 degrees.
    const double polar = 1.05 * std::sqrt((lobe + 0.5) / parameters.lobes);
    const double azimuth = golden * lobe + stream.normal(0, 0.2);
    const Vec3 out = shape.radial(azimuth);
    const Vec3 direction = -elementary::cos(polar) * shape.axis() + elementary::sin(polar) * out;
    const Vec3 sinus = shape.apex() - 9.0 * shape.axis() + 3.0 * elementary::sin(polar) * out;
    pieces.push_back({shape.apex(), sinus, 1.1, true});
    grower.grow(sinus, direction, 1.25, 0);
  }
  if (pieces.empty()) throw input_error("phantom gland: no lobe could grow");
  return pieces;
}

GlandField::GlandField(const BreastShape& shape, const GlandParameters& parameters,
                       std::uint64_t seed)
    : seed_(seed) {
  if (!(parameters.fraction > 0 && parameters.fraction < 0.6)) {
    throw input_error("phantom gland fraction ", parameters.fraction,
                      ": must lie between 0 and 0.6");
  }
  const std::vector<GlandPiece> pieces = grow_gland(shape, parameters, seed);
  pieces_ = pieces.size();
  Vec3 low = pieces[0].from, high = low;
  for (const GlandPiece& piece : pieces) {
    low = low.cwiseMin(piece.from).cwiseMin(piece.to);
    high = high.cwiseMax(piece.from).cwiseMax(piece.to);
  }
  low.array() -= 14, high.array() += 14;
  lattice_.origin = low;
  for (int a = 0; a < 3; ++a) lattice_.size[a] = 2 + int((high[a] - low[a]) / lattice_.spacing);
  lattice_.values.resize(std::size_t(lattice_.size[0]) * lattice_.size[1] * lattice_.size[2]);
  fill(pieces);
  calibrate(shape, parameters.fraction);
}

// Distance to the nearest piece, with a margin made irregular by noise of two wavelengths.
void GlandField::fill(const std::vector<GlandPiece>& pieces) {
  const Vec3 extent(lattice_.size[0], lattice_.size[1], lattice_.size[2]);
  const Bins bins(pieces, lattice_.origin, lattice_.origin + lattice_.spacing * extent);
  const std::vector<Sphere> around(pieces.begin(), pieces.end());
  duct_.assign(lattice_.values.size(), float(reach));
#pragma omp parallel for schedule(dynamic) num_threads(threads())
  for (int k = 0; k < lattice_.size[2]; ++k)
    for (int j = 0; j < lattice_.size[1]; ++j)
      for (int i = 0; i < lattice_.size[0]; ++i) {
        const Vec3 x = node(i, j, k);
        double nearest = reach, duct = reach;
        for (int n : bins.near(x)) {
          double& distance = pieces[n].duct ? duct : nearest;
          if (around[n].within(distance, x))
            distance = std::min(distance, piece_distance(pieces[n], x));
        }
        if (nearest < reach) {
          nearest += 2.6 * lattice_noise(seed_ + 1, x / 22) +
                     1.8 * lattice_noise(seed_ + 2, x / 9) +
                     1.2 * lattice_noise(seed_ + 5, x / 3.7);
        }
        lattice_.values[lattice_.at(i, j, k)] = float(nearest);
        duct_[lattice_.at(i, j, k)] = float(duct);
      }
}

namespace {

// Volume (mm³) of the breast as readers outline it: skin to wall within the fold.
double outlined_volume(const BreastShape& shape) {
  constexpr double step = 3;
  const double half = 1.4 * shape.parameters().radius, top = shape.parameters().height + 10;
  const Vec3 across = shape.radial(0), up = shape.radial(0.5 * std::numbers::pi);
  double volume = 0;
  for (double a = -half; a <= half; a += step)
    for (double b = -half; b <= half; b += step)
      for (double h = -30; h <= top; h += step) {
        const Vec3 x = shape.foot() + a * across + b * up + h * shape.axis();
        if (shape.beyond_fold(x, 0.0) < 0 && shape.skin_distance(x) < 0 &&
            shape.torso().wall_distance(x) > 0) {
          volume += step * step * step;
        }
      }
  return volume;
}

}  // namespace

// Shifts the margin of the lobes so that lobes and main ducts together fill the required share of
// the breast's volume.
void GlandField::calibrate(const BreastShape& shape, double fraction) {
  const double cell = lattice_.spacing * lattice_.spacing * lattice_.spacing,
               breast = outlined_volume(shape);
  std::vector<float> inside;
  for (int k = 0; k < lattice_.size[2]; ++k)
    for (int j = 0; j < lattice_.size[1]; ++j)
      for (int i = 0; i < lattice_.size[0]; ++i) {
        const std::size_t at = lattice_.at(i, j, k);
        const bool duct = duct_[at] < 0;
        if (!duct && lattice_.values[at] >= float(reach) - 2) continue;
        const Vec3 x = node(i, j, k);
        if (shape.skin_distance(x) < -3 && shape.torso().wall_distance(x) > 2)
          inside.push_back(duct ? -std::numeric_limits<float>::infinity() : lattice_.values[at]);
      }
  const std::size_t wanted = std::size_t(fraction * breast / cell);
  if (wanted >= inside.size()) {
    throw input_error("phantom gland fraction ", fraction, ": the tree reaches only ",
                      double(inside.size()) * cell / breast, " of the breast; lower it");
  }
  std::nth_element(inside.begin(), inside.begin() + std::ptrdiff_t(wanted), inside.end());
  const float shift = inside[wanted];
  for (std::size_t n = 0; n < duct_.size(); ++n)
    lattice_.values[n] = std::min(lattice_.values[n] - shift, duct_[n]);
  duct_ = {};
  volume_ml_ = double(wanted) * cell / mm3_per_ml;
}

double GlandField::distance(const Vec3& x) const {
  const Vec3 at = (x - lattice_.origin) / lattice_.spacing;
  int cell[3];
  for (int a = 0; a < 3; ++a) {
    if (!(at[a] >= 0 && at[a] < lattice_.size[a] - 1)) return reach;
    cell[a] = int(at[a]);
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const int d[3] = {corner & 1, corner >> 1 & 1, corner >> 2};
    double weight = 1;
    for (int a = 0; a < 3; ++a) weight *= d[a] ? at[a] - cell[a] : 1 - at[a] + cell[a];
    sum += weight * lattice_.values[lattice_.at(cell[0] + d[0], cell[1] + d[1], cell[2] + d[2])];
  }
  return sum;
}

Matter GlandField::matter(const Vec3& x) const {
  const double d = distance(x);
  if (d < 0) return Matter::gland;
  // Cooper's ligaments: thin curved sheets, the zero set of a slowly varying noise, interrupted by
  // another noise.
  if (lattice_noise(seed_ + 4, x / 19) > 0.02 &&
      std::abs(lattice_noise(seed_ + 3, x / 15)) < 0.020) {
    return Matter::ligament;
  }
  return Matter::fat;
}

}  // namespace breast
