// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/krylov/lowest_mode.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>
#include <vector>

namespace breast {

namespace {

// A direction of the search space and its image under the map.
struct Pair {
  Eigen::VectorXd v, av;
};

// Makes `direction` orthonormal to those in `space` and adds it, unless nothing is left of it.
void add(const LinearMap& a, const Eigen::VectorXd& weight, Eigen::VectorXd direction,
         std::vector<Pair>& space) {
  const auto length = [&] { return std::sqrt(direction.dot(weight.cwiseProduct(direction))); };
  const double before = length();
  if (!(before > 0) || !std::isfinite(before)) return;
  direction /= before;
  for (int sweep = 0; sweep < 2; ++sweep) {
    for (const Pair& other : space) {
      direction -= direction.dot(weight.cwiseProduct(other.v)) * other.v;
    }
  }
  const double left = length();
  if (!(left > 1e-8)) return;
  direction /= left;
  Eigen::VectorXd image = a(direction);
  space.push_back({std::move(direction), std::move(image)});
}

}  // namespace

LowestMode lowest_mode(const LinearMap& a, const LinearMap& p, const Eigen::VectorXd& weight,
                       const Eigen::VectorXd& start, double tolerance, int most) {
  std::vector<Pair> space;
  add(a, weight, start, space);
  LowestMode found;
  if (space.empty()) return found;
  found.value = space[0].v.dot(space[0].av);
  Eigen::VectorXd along;  // from the mode before to this one
  while (found.steps++ < most) {
    const Pair now = space[0];
    add(a, weight, p(now.av - found.value * weight.cwiseProduct(now.v)), space);
    if (along.size() > 0) add(a, weight, along, space);
    const int count = int(space.size());
    Eigen::MatrixXd small(count, count);
    for (int i = 0; i < count; ++i) {
      for (int j = 0; j < count; ++j) small(i, j) = space[i].v.dot(space[j].av);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solved(0.5 * (small + small.transpose()));
    const Eigen::VectorXd share = solved.eigenvectors().col(0);
    Pair next{Eigen::VectorXd::Zero(start.size()), Eigen::VectorXd::Zero(start.size())};
    for (int i = 0; i < count; ++i) {
      next.v += share[i] * space[i].v;
      next.av += share[i] * space[i].av;
    }
    along = next.v - share[0] * now.v;
    const double value = solved.eigenvalues()[0], gained = found.value - value;
    found.value = value;
    space.assign(1, std::move(next));
    if (!(gained > tolerance * std::abs(value))) break;
  }
  found.mode = space[0].v;
  return found;
}

}  // namespace breast
