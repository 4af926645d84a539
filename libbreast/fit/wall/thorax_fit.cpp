// SPDX-License-Identifier: GPL-3.0-or-later
#include "fit/wall/thorax_fit.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/distances.hpp"
#include "core/error.hpp"
#include "fit/wall/ellipse_fit.hpp"

namespace breast {

namespace {

constexpr double knot_mm = 12;    // spacing of the spline, at the mean radius along angles
constexpr double reach_mm = 150;  // beyond the breast's rim
constexpr double widest_angle = 160 * std::numbers::pi / 180;
constexpr double raster_mm = 4;   // of data
constexpr double smooth_mm = 10;  // shorter features of the wall are smoothed away
constexpr double return_mm = 50;  // beyond data the surface is back on the ellipse by about this
constexpr double beside_mm = 10;  // beyond the rim the labels count instead of the sheet
constexpr double outlier_mm = 3;  // of wall data: Cauchy weights
constexpr double least_confidence = 0.3;  // of the labels in their chest wall
constexpr int rounds = 5;
constexpr double sheet_weight = 20;  // against wall data, per area

/// Wall data, each standing for raster_mm² of the wall seen along y.
struct Data {
  std::vector<Vec3> points;
  std::vector<double> weights;
};

/// Whether a point lies within the closed curve, both seen along y.
bool inside(const std::vector<Vec3>& curve, const Vec3& p) {
  bool in = false;
  for (std::size_t i = 0, j = curve.size() - 1; i < curve.size(); j = i++) {
    const Vec3 &a = curve[i], &b = curve[j];
    if ((a.z() > p.z()) == (b.z() > p.z())) continue;
    if (p.x() < a.x() + (b.x() - a.x()) * (p.z() - a.z()) / (b.z() - a.z())) in = !in;
  }
  return in;
}

double distance_to(const std::vector<Vec3>& curve, const Vec3& p) {
  double least = 1e30;
  for (const Vec3& q : curve) least = std::min(least, std::hypot(q.x() - p.x(), q.z() - p.z()));
  return least;
}

/// The sheet's rim, and points of the sheet up to it.
std::vector<Vec3> rim_of(const BreastGeometry& geometry) {
  std::vector<Vec3> rim;
  for (const Vec2& st : geometry.rim_wall) rim.push_back(geometry.wall.position(st));
  return rim;
}

Data sheet_data(const BreastGeometry& geometry, const std::vector<Vec3>& rim) {
  Data data;
  Vec2 low = geometry.rim_wall.front(), high = low;
  for (const Vec2& st : geometry.rim_wall) low = low.cwiseMin(st), high = high.cwiseMax(st);
  const Vec3 across = geometry.wall.position(high) - geometry.wall.position(low);
  const int ns = std::max(8, int(std::abs(across.x()) / raster_mm));
  const int nt = std::max(8, int(std::abs(across.z()) / raster_mm));
  for (int j = 0; j <= nt; ++j) {
    for (int i = 0; i <= ns; ++i) {
      const Vec2 st(low.x() + (high.x() - low.x()) * i / ns,
                    low.y() + (high.y() - low.y()) * j / nt);
      const Vec3 p = geometry.wall.position(st);
      if (!inside(rim, p) && distance_to(rim, p) > raster_mm) continue;
      data.points.push_back(p);
      data.weights.push_back(sheet_weight);
    }
  }
  return data;
}

/// The first muscle from the front in the columns of voxels beside the breast, where segment
/// observed it.
Data label_data(const LabelVolume& labels, const std::vector<Vec3>& rim) {
  Data data;
  const Grid& grid = labels.grid;
  const bool confident = labels.chest_wall_confidence.size() == grid.voxels();
  const int step_x = std::max(1, int(raster_mm / grid.spacing[0]));
  const int step_z = std::max(1, int(raster_mm / grid.spacing[2]));
  for (int k = 0; k < grid.size[2]; k += step_z) {
    for (int i = 0; i < grid.size[0]; i += step_x) {
      int j = 0;
      bool body = false;
      while (j < grid.size[1] && labels.at(i, j, k) != Tissue::muscle) {
        body = body || labels.at(i, j, k) != Tissue::air;
        ++j;
      }
      if (j == grid.size[1] || !body) continue;
      const double weight = confident ? labels.chest_wall_confidence[grid.offset(i, j, k)] : 1;
      const Vec3 p = grid.to_patient(Vec3(i, j - 0.5, k));
      if (!(weight > least_confidence) || inside(rim, p) || distance_to(rim, p) < beside_mm)
        continue;
      data.points.push_back(p);
      data.weights.push_back(weight);
    }
  }
  return data;
}

Expected expected_midline(const LabelVolume& labels, const Data& sheet, const Data& beside) {
  if (labels.midline_mm) return {*labels.midline_mm, 5};
  // Labels that do not know it reach to about the sternum.
  double medial = sheet.points.front().x();
  const bool left = labels.side == Side::left;
  for (const Data* data : {&sheet, &beside}) {
    for (const Vec3& p : data->points) {
      medial = left ? std::min(medial, p.x()) : std::max(medial, p.x());
    }
  }
  return {medial, 20};
}

/// The four by four coefficients at one place: the first one's indices, and their weights.
struct SplineWeights {
  int angle = 0, height = 0;
  double value[16];
};

class SplineFit {
 public:
  SplineFit(ThoraxSurface& thorax, const EllipticCylinder& base);
  void solve(const Data& data, const std::vector<double>& weights);

 private:
  int columns() const { return thorax_.angles + 3; }
  int rows() const { return thorax_.heights + 3; }
  int index(int i, int j) const { return j * columns() + i; }
  SplineWeights weights_at(const AxisPlace& place) const;
  void add_bending(std::vector<Eigen::Triplet<double>>& entries) const;

  ThoraxSurface& thorax_;
  Eigen::VectorXd base_;  // coefficients of the ellipse
};

// Coefficients f − f''h²/6 reproduce a smooth f to fourth order.
SplineFit::SplineFit(ThoraxSurface& thorax, const EllipticCylinder& base) : thorax_(thorax) {
  const double step = (thorax.angle_high - thorax.angle_low) / thorax.angles;
  base_.resize(columns() * rows());
  for (int i = 0; i < columns(); ++i) {
    const double angle = thorax.angle_low + (i - 1) * step;
    const double here = base.radius(angle);
    const double bend = base.radius(angle - step) - 2 * here + base.radius(angle + step);
    for (int j = 0; j < rows(); ++j) base_[index(i, j)] = here - bend / 6;
  }
}

SplineWeights SplineFit::weights_at(const AxisPlace& place) const {
  const double angle = angle_of(place);
  const SplinePlace at = spline_place(angle, thorax_.angle_low, thorax_.angle_high, thorax_.angles);
  const SplinePlace up =
      spline_place(place.height, thorax_.height_low, thorax_.height_high, thorax_.heights);
  const CubicSpline a = cubic_spline(at.t), z = cubic_spline(up.t);
  SplineWeights w;
  w.angle = at.interval, w.height = up.interval;
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 4; ++i) w.value[4 * j + i] = z.value[j] * a.value[i];
  }
  return w;
}

// Second differences of the coefficients, which stand for ∫ s_aa² + 2 s_az² + s_zz² of the deviation
// s from the ellipse, and its size: beyond data it fades away over return_mm.
void SplineFit::add_bending(std::vector<Eigen::Triplet<double>>& entries) const {
  const double bending = smooth_mm * smooth_mm * smooth_mm * smooth_mm / (knot_mm * knot_mm);
  const double fade = (smooth_mm / return_mm) * (smooth_mm / return_mm);
  const double size = fade * fade * knot_mm * knot_mm;
  const auto penalise = [&](std::initializer_list<std::pair<int, double>> stencil, double weight) {
    for (const auto& [row, r] : stencil) {
      for (const auto& [column, c] : stencil) entries.emplace_back(row, column, weight * r * c);
    }
  };
  for (int j = 0; j < rows(); ++j) {
    for (int i = 0; i < columns(); ++i) {
      penalise({{index(i, j), 1.0}}, size);
      if (i + 2 < columns()) {
        penalise({{index(i, j), 1.0}, {index(i + 1, j), -2.0}, {index(i + 2, j), 1.0}}, bending);
      }
      if (j + 2 < rows()) {
        penalise({{index(i, j), 1.0}, {index(i, j + 1), -2.0}, {index(i, j + 2), 1.0}}, bending);
      }
      if (i + 1 < columns() && j + 1 < rows()) {
        penalise({{index(i, j), 1.0},
                  {index(i + 1, j), -1.0},
                  {index(i, j + 1), -1.0},
                  {index(i + 1, j + 1), 1.0}},
                 2 * bending);
      }
    }
  }
}

void SplineFit::solve(const Data& data, const std::vector<double>& weights) {
  const int n = columns() * rows();
  std::vector<Eigen::Triplet<double>> entries;
  add_bending(entries);
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n);
  constexpr double area = raster_mm * raster_mm;
  for (std::size_t k = 0; k < data.points.size(); ++k) {
    const AxisPlace place = about_axis(thorax_, data.points[k]);
    const SplineWeights w = weights_at(place);
    double deviation = std::hypot(place.left, place.front);
    int at[16];
    for (int m = 0; m < 16; ++m) {
      at[m] = index(w.angle + m % 4, w.height + m / 4);
      deviation -= w.value[m] * base_[at[m]];
    }
    for (int m = 0; m < 16; ++m) {
      right[at[m]] += area * weights[k] * w.value[m] * deviation;
      for (int q = 0; q < 16; ++q) {
        entries.emplace_back(at[m], at[q], area * weights[k] * w.value[m] * w.value[q]);
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor(matrix);
  const Eigen::VectorXd found = factor.solve(right);
  if (factor.info() != Eigen::Success || !found.allFinite()) {
    throw failed_error("wall surface: its least-squares system is singular");
  }
  const Eigen::VectorXd all = base_ + found;
  thorax_.coefficients.assign(all.data(), all.data() + n);
}

/// Ends of the surface: the rim and reach_mm around it.
ThoraxSurface empty_surface(const EllipticCylinder& base, const std::vector<Vec3>& rim) {
  ThoraxSurface thorax;
  thorax.origin = Vec3(base.centre_x, base.centre_y, base.z0);
  thorax.slope = base.slope;
  double low = 0, high = 0, bottom = 0, top = 0;
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const AxisPlace place = about_axis(thorax, rim[i]);
    const double angle = angle_of(place);
    if (i == 0) low = high = angle, bottom = top = place.height;
    low = std::min(low, angle), high = std::max(high, angle);
    bottom = std::min(bottom, place.height), top = std::max(top, place.height);
  }
  const double mean = 0.5 * (base.half_width + base.half_depth), turn = reach_mm / mean;
  thorax.angle_low = std::max(-widest_angle, low - turn);
  thorax.angle_high = std::min(widest_angle, high + turn);
  thorax.height_low = bottom - reach_mm;
  thorax.height_high = top + reach_mm;
  thorax.angles = int(std::ceil((thorax.angle_high - thorax.angle_low) * mean / knot_mm));
  thorax.heights = int(std::ceil((thorax.height_high - thorax.height_low) / knot_mm));
  return thorax;
}

/// Distance to the surface to first order, mm; infinite beyond it.
double distance_from(const ThoraxSurface& thorax, const Vec3& p) {
  const std::optional<Level> level = thorax.at(p);
  return level ? level->value / level->gradient.norm() : std::numeric_limits<double>::infinity();
}

Data within(const ThoraxSurface& thorax, const Data& all) {
  Data kept;
  for (std::size_t k = 0; k < all.points.size(); ++k) {
    const AxisPlace place = about_axis(thorax, all.points[k]);
    const double angle = angle_of(place);
    if (!(angle > thorax.angle_low && angle < thorax.angle_high)) continue;
    if (!(place.height > thorax.height_low && place.height < thorax.height_high)) continue;
    kept.points.push_back(all.points[k]);
    kept.weights.push_back(all.weights[k]);
  }
  return kept;
}

}  // namespace

ThoraxSurface fit_thorax(const LabelVolume& labels, const BreastGeometry& geometry,
                         ThoraxReport& report) {
  const std::vector<Vec3> rim = rim_of(geometry);
  const Data sheet = sheet_data(geometry, rim);
  Data beside = label_data(labels, rim);
  Data all = beside;
  all.points.insert(all.points.end(), sheet.points.begin(), sheet.points.end());
  all.weights.insert(all.weights.end(), sheet.points.size(), 1.0);
  const EllipticCylinder base =
      fit_elliptic_cylinder(all.points, all.weights, expected_midline(labels, sheet, beside));
  ThoraxSurface thorax = empty_surface(base, rim);
  beside = within(thorax, beside);
  SplineFit fit(thorax, base);
  Data both = sheet;
  both.points.insert(both.points.end(), beside.points.begin(), beside.points.end());
  std::vector<double> weights = sheet.weights;
  weights.insert(weights.end(), beside.weights.begin(), beside.weights.end());
  std::vector<double> distances(beside.points.size(), 0);
  for (int round = 0; round < rounds; ++round) {
    fit.solve(both, weights);
    for (std::size_t k = 0; k < beside.points.size(); ++k) {
      distances[k] = std::abs(distance_from(thorax, beside.points[k]));
      const double ratio = distances[k] / outlier_mm;
      weights[sheet.points.size() + k] = beside.weights[k] / (1 + ratio * ratio);
    }
  }
  const Distances summary = summarise(distances);
  report.half_width_mm = base.half_width;
  report.half_depth_mm = base.half_depth;
  report.wall_points = beside.points.size();
  report.wall_mean_mm = summary.mean_mm;
  report.wall_p95_mm = summary.p95_mm;
  for (const Vec3& p : sheet.points) {
    report.sheet_max_mm = std::max(report.sheet_max_mm, std::abs(distance_from(thorax, p)));
  }
  return thorax;
}

}  // namespace breast
