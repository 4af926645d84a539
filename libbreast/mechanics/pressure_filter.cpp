// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/pressure_filter.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh/quality.hpp"

namespace breast {

namespace {

/// Elements at every node.
std::vector<std::vector<int>> elements_at_nodes(const HexTopology& mesh, std::size_t nodes) {
  std::vector<std::vector<int>> at(nodes);
  for (int e = 0; e < mesh.elements(); ++e) {
    for (int a = 0; a < mesh.nodes_per_element(); ++a) at[mesh.element(e)[a]].push_back(e);
  }
  return at;
}

std::vector<Vec3> centres(const HexTopology& mesh, const std::vector<Vec3>& nodal) {
  std::vector<Vec3> out;
  for (int e = 0; e < mesh.elements(); ++e) {
    out.push_back(element_position(mesh, nodal, e, Vec3::Zero()));
  }
  return out;
}

}  // namespace

std::vector<double> filter_pressure(const HexTopology& mesh, const std::vector<Vec3>& nodal,
                                    const std::vector<double>& pressure) {
  const std::vector<std::vector<int>> around = elements_at_nodes(mesh, nodal.size());
  const std::vector<Vec3> centre = centres(mesh, nodal);
  const std::vector<double> volume = element_volumes(mesh, nodal);
  std::vector<double> filtered;
  for (int e = 0; e < mesh.elements(); ++e) {
    // Normal equations of a + b·(x − x_e)/h; a neighbour counts once for every node it shares.
    Eigen::Matrix4d matrix = Eigen::Matrix4d::Zero();
    Eigen::Vector4d right = Eigen::Vector4d::Zero();
    const double h = std::cbrt(std::abs(volume[e]));
    for (int a = 0; a < mesh.nodes_per_element(); ++a) {
      for (const int other : around[mesh.element(e)[a]]) {
        if (mesh.tissue[other] != mesh.tissue[e]) continue;
        Eigen::Vector4d basis;
        basis << 1, (centre[other] - centre[e]) / h;
        matrix += std::abs(volume[other]) * basis * basis.transpose();
        right += std::abs(volume[other]) * pressure[other] * basis;
      }
    }
    // With too few neighbours for a slope, the weak regularisation of b leaves the weighted mean.
    matrix.diagonal().tail<3>().array() += 1e-9 * matrix(0, 0);
    filtered.push_back(matrix.ldlt().solve(right)[0]);
  }
  return filtered;
}

std::map<Tissue, PressureQuality> pressure_quality(const HexTopology& mesh,
                                                   const std::vector<Vec3>& nodal,
                                                   const std::vector<double>& pressure,
                                                   const std::vector<double>& filtered) {
  const std::vector<double> volume = element_volumes(mesh, nodal);
  struct Sums {
    double volume = 0, first = 0, second = 0, off = 0;
    double least = std::numeric_limits<double>::infinity(), greatest = -least;
  };
  std::map<Tissue, Sums> sums;
  for (int e = 0; e < mesh.elements(); ++e) {
    Sums& s = sums[mesh.tissue[e]];
    s.least = std::min(s.least, filtered[e]);
    s.greatest = std::max(s.greatest, filtered[e]);
    s.volume += volume[e];
    s.first += volume[e] * pressure[e];
    s.second += volume[e] * pressure[e] * pressure[e];
    s.off += volume[e] * (pressure[e] - filtered[e]) * (pressure[e] - filtered[e]);
  }
  std::map<Tissue, PressureQuality> quality;
  for (const auto& [tissue, s] : sums) {
    const double spread = s.second - s.first * s.first / s.volume;
    quality[tissue] = {spread > 1e-20 * s.second ? std::sqrt(s.off / spread) : 0, s.least,
                       s.greatest};
  }
  return quality;
}

}  // namespace breast
