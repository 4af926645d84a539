// SPDX-License-Identifier: GPL-3.0-or-later
#include "segment/wall/legendre_surface.hpp"
#include "core/statistics/percentile.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace breast {

namespace {

constexpr int degree_x = 6, degree_z = 3, surface_terms = (degree_x + 1) * (degree_z + 1);
using Coefficients = Eigen::Matrix<double, surface_terms, 1>;

Coefficients basis(double x, double z) {
  const auto legendre = [](double t, int degree, double* p) {
    p[0] = 1;
    p[1] = t;
    for (int n = 1; n < degree; ++n) p[n + 1] = ((2 * n + 1) * t * p[n] - n * p[n - 1]) / (n + 1);
  };
  double px[degree_x + 1], pz[degree_z + 1];
  legendre(x, degree_x, px);
  legendre(z, degree_z, pz);
  Coefficients b;
  for (int n = 0, term = 0; n <= degree_z; ++n) {
    for (int m = 0; m <= degree_x; ++m) b[term++] = px[m] * pz[n];
  }
  return b;
}

}  // namespace

HeightField legendre_surface(const HeightField& depth, const HeightField& confidence,
                             const WallDomain& domain) {
  const auto place = [&](int i, int k) {
    const double x = 2.0 * (i - domain.first) / std::max(1, domain.last - domain.first) - 1;
    const double z = 2.0 * k / std::max(1, depth.nz - 1) - 1;
    return basis(x, z);
  };
  HeightField fit(depth.nx, depth.nz, no_depth);
  double scale = 1e9;  // first pass: plain weighted least squares
  for (int pass = 0; pass < 6; ++pass) {
    Eigen::Matrix<double, surface_terms, surface_terms> matrix =
        1e-3 * Eigen::Matrix<double, surface_terms, surface_terms>::Identity();
    Coefficients right = Coefficients::Zero();
    std::vector<double> residuals;
    for (int k = 0; k < depth.nz; ++k) {
      for (int i = domain.first; i <= domain.last; i += 2) {
        const double w0 = confidence.at(i, k);
        if (!(w0 > 0)) continue;
        const Coefficients b = place(i, k);
        const double r = pass ? depth.at(i, k) - fit.at(i, k) : 0;
        if (pass) residuals.push_back(std::abs(r));
        const double u = r / scale, tukey = u * u < 1 ? (1 - u * u) * (1 - u * u) : 0;
        const double w = (0.01 + w0) * (0.001 + tukey);
        matrix.selfadjointView<Eigen::Lower>().rankUpdate(b, w);
        right += w * depth.at(i, k) * b;
      }
    }
    const Coefficients solution = matrix.selfadjointView<Eigen::Lower>().ldlt().solve(right);
    for (int k = 0; k < depth.nz; ++k) {
      for (int i = domain.first; i <= domain.last; ++i) fit.at(i, k) = place(i, k).dot(solution);
    }
    if (!residuals.empty()) {
      scale = std::max(4.685 * 1.4826 * median(residuals), 4.0);
    } else if (pass == 0) {
      scale = 20;
    }
  }
  return fit;
}

}  // namespace breast
