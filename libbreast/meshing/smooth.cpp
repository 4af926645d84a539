// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/smooth.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesh/quality.hpp"
#include "meshing/smoothing/corner_energy.hpp"
#include "meshing/smoothing/lbfgs.hpp"

namespace breast {

namespace {

// The unknowns in mm: three per inner node, and two per sliding node along an orthonormal tangent
// frame at its start, so that all unknowns have the same scale.
using Mat2 = Eigen::Matrix2d;
using Mat32 = Eigen::Matrix<double, 3, 2>;

struct Unknown {
  int node;
  int first;  // place in the vector
  bool slides = false;
  Mat2 to_parameters;  // (s,t) per mm of the two tangent unknowns
};

class Smoother {
 public:
  Smoother(const std::vector<int>& connectivity, const BodyMap& body, const SmoothOptions& options,
           const std::vector<bool>& held, const PlacedNodes& start)
      : energy_(connectivity, start.x), body_(body), options_(options), start_(start), now_(start) {
    for (int a = 0; a < int(start.x.size()); ++a) {
      if (!held.empty() && held[a]) continue;
      Unknown unknown{a, size_, start.support[a] != Support::interior, Mat2::Zero()};
      if (unknown.slides) unknown.to_parameters = tangent_frame(a);
      unknowns_.push_back(unknown);
      size_ += unknown.slides ? 2 : 3;
    }
    found_ = Eigen::VectorXd::Zero(size_);
  }

  /// Nodes of the last evaluation of the energy, or of the smallest one since place_found().
  const PlacedNodes& nodes() const { return now_; }
  CornerEnergy& energy() { return energy_; }
  void set_sliding_tether(double weight) { sliding_tether_ = weight; }
  /// Goes on minimising from the smallest energy found so far; returns the number of evaluations.
  int minimise(int evaluations) {
    const auto energy = [this](const Eigen::VectorXd& y, Eigen::VectorXd& gradient) {
      return value(y, gradient);
    };
    return minimise_lbfgs(energy, found_, {.evaluations = evaluations}).evaluations;
  }
  void place_found() { place(found_); }

 private:
  double value(const Eigen::VectorXd& y, Eigen::VectorXd& gradient) {
    place(y);
    double sum = energy_.evaluate(now_.x, node_gradient_);
    const double scale = 1 / (energy_.edge() * energy_.edge());
    gradient.resize(size_);
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const Unknown& unknown = unknowns_[i];
      const double weight = scale * (unknown.slides ? sliding_tether_ : options_.tether);
      const Vec3 moved = now_.x[unknown.node] - start_.x[unknown.node];
      sum += weight * moved.squaredNorm();
      const Vec3 total = node_gradient_[unknown.node] + 2 * weight * moved;
      if (unknown.slides) {
        gradient.segment<2>(unknown.first) = slopes_[i].transpose() * total;
      } else {
        gradient.segment<3>(unknown.first) = total;
      }
    }
    return sum;
  }

  void place(const Eigen::VectorXd& y) {
    slopes_.resize(unknowns_.size());
    for (std::size_t i = 0; i < unknowns_.size(); ++i) {
      const Unknown& unknown = unknowns_[i];
      const int a = unknown.node;
      if (!unknown.slides) {
        now_.x[a] = start_.x[a] + y.segment<3>(unknown.first);
        continue;
      }
      now_.st[a] = start_.st[a] + unknown.to_parameters * y.segment<2>(unknown.first);
      const Mat32 tangents = chart(a, now_.st[a], now_.x[a]);
      slopes_[i] = tangents * unknown.to_parameters;
    }
  }

  // Position and slopes of a sliding node's surface at its parameters.
  Mat32 chart(int a, const Vec2& st, Vec3& x) const {
    if (start_.support[a] == Support::cut) {
      x = body_.cut(st.y(), st.x());
      return body_.cut_slopes(st.y(), st.x());
    }
    const bool skin = start_.support[a] == Support::skin;
    const SheetPoint point = (skin ? body_.skin_sheet() : body_.wall_sheet()).evaluate(st);
    x = point.x;
    Mat32 slopes;
    slopes << point.x_s, point.x_t;
    return slopes;
  }
  // Inverse of the upper-triangular factor R of the slopes = Q R; a rim node moves along its rim
  // only.
  Mat2 tangent_frame(int a) const {
    Vec3 x;
    const Mat32 slopes = chart(a, start_.st[a], x);
    const double length = slopes.col(0).norm(), along = slopes.col(0).dot(slopes.col(1)) / length;
    Mat2 frame = Mat2::Zero();
    frame(0, 0) = 1 / length;
    if (start_.support[a] == Support::cut && on_rim(start_.st[a].y())) return frame;
    frame(1, 1) = length / slopes.col(0).cross(slopes.col(1)).norm();
    frame(0, 1) = -along * frame(1, 1) / length;
    return frame;
  }

  CornerEnergy energy_;
  const BodyMap& body_;
  SmoothOptions options_;
  double sliding_tether_ = options_.tether;
  PlacedNodes start_, now_;
  Eigen::VectorXd found_;  // the unknowns with the smallest energy
  std::vector<Unknown> unknowns_;
  std::vector<Mat32> slopes_;
  std::vector<Vec3> node_gradient_;
  int size_ = 0;
};

HexTopology topology_of(const std::vector<int>& connectivity) {
  HexTopology mesh;
  mesh.connectivity = connectivity;
  return mesh;
}

// Improves the corners and returns the relative change of the mesh's volume. Nodes that slide out of
// a narrow part of the body leave it outside flat faces. Where this costs too much volume, the
// sliding nodes are held more strongly, in three steps of a hundred: the energy of a badly shaped
// corner, a power of its distortion, outweighs any weaker hold.
double improve_corners(const std::vector<int>& connectivity, const std::vector<Vec3>& start,
                       const SmoothOptions& options, Smoother& smoother, SmoothReport& report) {
  const HexTopology mesh = topology_of(connectivity);
  const double volume = mesh_volume(mesh, start);
  double change = 0, tether = options.tether;
  for (int hold = 0; hold < 4; ++hold, tether *= 100) {
    smoother.set_sliding_tether(tether);
    report.evaluations += smoother.minimise(options.evaluations);
    smoother.place_found();
    change = mesh_volume(mesh, smoother.nodes().x) / volume - 1;
    if (std::abs(change) <= options.volume_change) break;
  }
  return change;
}

}  // namespace

double worst_shape(const std::vector<int>& connectivity, const std::vector<Vec3>& x) {
  const MeshQuality quality = mesh_quality(topology_of(connectivity), x);
  const double folded = quality.min_det / std::max(quality.max_det, 1e-300);
  return quality.min_det > 0 ? quality.min_scaled_jacobian
                             : std::min(quality.min_scaled_jacobian, folded);
}

SmoothReport smooth_nodes(const std::vector<int>& connectivity, const BodyMap& body,
                          const SmoothOptions& options, const std::vector<bool>& held,
                          PlacedNodes& nodes) {
  SmoothReport report;
  report.before = report.after = worst_shape(connectivity, nodes.x);
  Smoother smoother(connectivity, body, options, held, nodes);
  // First the folds are removed with the plain energy and a regularisation that follows the worst
  // corner; then the p-norm improves the worst corners.
  smoother.set_sliding_tether(1);
  double worst = smoother.energy().min_det(nodes.x);
  for (int round = 0; round < options.untangling_rounds && worst < 1e-3; ++round) {
    smoother.energy().set(
        {options.theta, 1, std::max(1e-3, 0.5 * std::abs(worst - 0.02)), options.mid_edges});
    report.evaluations += smoother.minimise(60);
    worst = smoother.energy().min_det(smoother.nodes().x);
  }
  smoother.energy().set(
      {options.theta, options.power, worst > 0 ? 1e-6 : std::abs(worst), options.mid_edges});
  const double change = improve_corners(connectivity, nodes.x, options, smoother, report);
  const double after = worst_shape(connectivity, smoother.nodes().x);
  if (after > report.before && std::abs(change) <= options.volume_change) {
    nodes = smoother.nodes();
    report.after = after;
    report.kept = true;
  }
  return report;
}

}  // namespace breast
