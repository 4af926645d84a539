// SPDX-License-Identifier: GPL-3.0-or-later
#include "meshing/smoothing/corner_energy.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"

namespace breast {

namespace {

// For every corner the edges along ξ, η, ζ through it, from the node on the low side to the one on
// the high side.
constexpr std::array<std::array<std::array<int, 2>, 3>, 8> corner_edges = {{
    {{{0, 1}, {0, 3}, {0, 4}}},
    {{{0, 1}, {1, 2}, {1, 5}}},
    {{{3, 2}, {1, 2}, {2, 6}}},
    {{{3, 2}, {0, 3}, {3, 7}}},
    {{{4, 5}, {4, 7}, {0, 4}}},
    {{{4, 5}, {5, 6}, {1, 5}}},
    {{{7, 6}, {5, 6}, {2, 6}}},
    {{{7, 6}, {4, 7}, {3, 7}}},
}};
// The corners whose Jacobians average to that of a sample: the corners themselves, then the 12
// mid-edges (along an edge the Jacobian of the trilinear map is linear).
constexpr std::array<std::array<int, 2>, 20> samples = {{
    {0, 0}, {1, 1}, {2, 2}, {3, 3}, {4, 4}, {5, 5}, {6, 6}, {7, 7}, {0, 1}, {1, 2},
    {3, 2}, {0, 3}, {4, 5}, {5, 6}, {7, 6}, {4, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7},
}};

std::array<Mat3, 8> corner_jacobians(const std::vector<Vec3>& x, const int* nodes, double edge) {
  std::array<Mat3, 8> jacobians;
  for (int c = 0; c < 8; ++c) {
    for (int d = 0; d < 3; ++d) {
      const auto& [low, high] = corner_edges[c][d];
      jacobians[c].col(d) = (x[nodes[high]] - x[nodes[low]]) / edge;
    }
  }
  return jacobians;
}

Mat3 cofactor(const Mat3& a) {
  Mat3 c;
  c.col(0) = a.col(1).cross(a.col(2));
  c.col(1) = a.col(2).cross(a.col(0));
  c.col(2) = a.col(0).cross(a.col(1));
  return c;
}

// f(A)^p and its derivative.
double sample_energy(const Mat3& a, const CornerEnergy::Parameters& p, Mat3& stress) {
  const Mat3 cof = cofactor(a);
  const double det = a.col(0).dot(cof.col(0)), root = std::sqrt(p.epsilon * p.epsilon + det * det);
  // ½(det + root) without cancellation for a folded corner.
  const double chi = det > 0 ? 0.5 * (det + root) : 0.5 * p.epsilon * p.epsilon / (root - det);
  const double slope = chi / root;  // dχ/d det
  const double shape_weight = std::cbrt(1 / (chi * chi));
  const double shape = a.squaredNorm() * shape_weight / 3, size = 0.5 * (det * det + 1) / chi;
  const double value = (1 - p.theta) * shape + p.theta * size;
  double power = 1;
  for (int i = 1; i < p.power; ++i) power *= value;
  const double by_det =
      -(1 - p.theta) * 2.0 / 3 * shape / chi * slope + p.theta * (det / chi - size / chi * slope);
  stress = p.power * power * ((1 - p.theta) * 2.0 / 3 * shape_weight * a + by_det * cof);
  return power * value;
}

}  // namespace

CornerEnergy::CornerEnergy(const std::vector<int>& connectivity, const std::vector<Vec3>& x)
    : connectivity_(connectivity),
      first_(x.size() + 1, 0),
      uses_(connectivity.size()),
      forces_(connectivity.size()),
      energies_(connectivity.size() / 8) {
  double volume = 0;
  for (std::size_t e = 0; e < energies_.size(); ++e) {
    for (const Mat3& a : corner_jacobians(x, &connectivity_[8 * e], 1))
      volume += a.determinant() / 8;
  }
  edge_ = std::cbrt(std::abs(volume) / double(std::max<std::size_t>(1, energies_.size())));
  for (const int node : connectivity_) ++first_[node + 1];
  for (std::size_t a = 1; a < first_.size(); ++a) first_[a] += first_[a - 1];
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < connectivity_.size(); ++i) uses_[next[connectivity_[i]]++] = int(i);
}

double CornerEnergy::element(const std::vector<Vec3>& x, int e, Vec3* force) const {
  const std::array<Mat3, 8> corners =
      corner_jacobians(x, &connectivity_[std::size_t(e) * 8], edge_);
  std::array<Mat3, 8> stresses;
  stresses.fill(Mat3::Zero());
  double sum = 0;
  Mat3 stress;
  for (int s = 0; s < 8; ++s) {
    sum += sample_energy(corners[s], parameters_, stress);
    stresses[s] = stress;
  }
  for (int s = 8; s < (parameters_.mid_edges ? 20 : 8); ++s) {
    const auto& [low, high] = samples[s];
    sum += sample_energy(0.5 * (corners[low] + corners[high]), parameters_, stress);
    stresses[low] += 0.5 * stress;
    stresses[high] += 0.5 * stress;
  }
  for (int a = 0; a < 8; ++a) force[a].setZero();
  for (int c = 0; c < 8; ++c) {
    for (int d = 0; d < 3; ++d) {
      const auto& [low, high] = corner_edges[c][d];
      force[high] += stresses[c].col(d) / edge_;
      force[low] -= stresses[c].col(d) / edge_;
    }
  }
  return sum;
}

double CornerEnergy::evaluate(const std::vector<Vec3>& x, std::vector<Vec3>& gradient) {
  const int elements = int(energies_.size()), nodes = int(x.size());
  gradient.resize(nodes);
  // A few milliseconds of work do not justify a barrier on a busy machine.
  const int team = elements < 8000 ? 1 : threads();
#pragma omp parallel num_threads(team)
  {
#pragma omp for schedule(static)
    for (int e = 0; e < elements; ++e) energies_[e] = element(x, e, &forces_[std::size_t(e) * 8]);
#pragma omp for schedule(static)
    for (int a = 0; a < nodes; ++a) {
      gradient[a].setZero();
      for (int i = first_[a]; i < first_[a + 1]; ++i) gradient[a] += forces_[uses_[i]];
    }
  }
  double sum = 0;
  for (const double energy : energies_) sum += energy;
  return sum;
}

double CornerEnergy::min_det(const std::vector<Vec3>& x) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < energies_.size(); ++e) {
    const auto corners = corner_jacobians(x, &connectivity_[8 * e], edge_);
    for (int s = 0; s < (parameters_.mid_edges ? 20 : 8); ++s) {
      const Mat3 a = 0.5 * (corners[samples[s][0]] + corners[samples[s][1]]);
      least = std::min(least, a.determinant());
    }
  }
  return least;
}

}  // namespace breast
