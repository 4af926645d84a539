#include "meshing/corner_energy.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"

namespace breast {

namespace {

constexpr std::array<std::array<int, 3>, 8> corner_neighbours = {
    {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

Mat3 corner_edges(const std::vector<Vec3>& x, const int* nodes, int corner) {
  Mat3 edges;
  for (int d = 0; d < 3; ++d)
    edges.col(d) = x[nodes[corner_neighbours[corner][d]]] - x[nodes[corner]];
  return edges;
}

Mat3 cofactor(const Mat3& a) {
  Mat3 c;
  c.col(0) = a.col(1).cross(a.col(2));
  c.col(1) = a.col(2).cross(a.col(0));
  c.col(2) = a.col(0).cross(a.col(1));
  return c;
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
    for (int c = 0; c < 8; ++c)
      volume += corner_edges(x, &connectivity_[8 * e], c).determinant() / 8;
  }
  edge_ = std::cbrt(std::abs(volume) / std::max<std::size_t>(1, energies_.size()));
  for (const int node : connectivity_) ++first_[node + 1];
  for (std::size_t a = 1; a < first_.size(); ++a) first_[a] += first_[a - 1];
  std::vector<int> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < connectivity_.size(); ++i) uses_[next[connectivity_[i]]++] = int(i);
}

double CornerEnergy::element(const std::vector<Vec3>& x, int e, Vec3* force) const {
  const int* nodes = &connectivity_[std::size_t(e) * 8];
  for (int a = 0; a < 8; ++a) force[a].setZero();
  const double theta = parameters_.theta, epsilon = parameters_.epsilon;
  double sum = 0;
  for (int c = 0; c < 8; ++c) {
    const Mat3 a = corner_edges(x, nodes, c) / edge_, cof = cofactor(a);
    const double det = a.col(0).dot(cof.col(0)), root = std::sqrt(epsilon * epsilon + det * det);
    // ½(det + root) without cancellation for a folded corner.
    const double chi = det > 0 ? 0.5 * (det + root) : 0.5 * epsilon * epsilon / (root - det);
    const double slope = chi / root;  // dχ/d det
    const double norm = a.squaredNorm(), shape_weight = std::cbrt(1 / (chi * chi));
    const double shape = norm * shape_weight / 3, size = 0.5 * (det * det + 1) / chi;
    const double value = (1 - theta) * shape + theta * size;
    double power = 1;
    for (int p = 1; p < parameters_.power; ++p) power *= value;
    sum += power * value;
    const double by_det =
        -(1 - theta) * 2.0 / 3 * shape / chi * slope + theta * (det / chi - size / chi * slope);
    const Mat3 stress = parameters_.power * power / edge_ *
                        ((1 - theta) * 2.0 / 3 * shape_weight * a + by_det * cof);
    for (int d = 0; d < 3; ++d) {
      force[corner_neighbours[c][d]] += stress.col(d);
      force[c] -= stress.col(d);
    }
  }
  return sum;
}

double CornerEnergy::evaluate(const std::vector<Vec3>& x, std::vector<Vec3>& gradient) {
  const int elements = int(energies_.size()), nodes = int(x.size());
  gradient.resize(nodes);
#pragma omp parallel num_threads(threads())
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
    for (int c = 0; c < 8; ++c) {
      least = std::min(least, corner_edges(x, &connectivity_[8 * e], c).determinant());
    }
  }
  return least / (edge_ * edge_ * edge_);
}

}  // namespace breast
