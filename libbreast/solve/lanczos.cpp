#include "solve/lanczos.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace breast {

double largest_eigenvalue(const LinearMap& a, const Eigen::VectorXd& start, int steps) {
  Eigen::VectorXd diagonal(steps), beside(steps), last = Eigen::VectorXd::Zero(start.size());
  Eigen::VectorXd v = start / start.norm();
  int done = 0;
  while (done < steps) {
    Eigen::VectorXd w = a(v);
    if (done > 0) w -= beside[done - 1] * last;
    diagonal[done] = w.dot(v);
    w -= diagonal[done] * v;
    beside[done] = w.norm();
    last = std::move(v);
    if (!std::isfinite(beside[done])) return beside[done];
    if (!(beside[done++] > 1e-14 * std::abs(diagonal[0]))) break;  // an invariant space
    v = w / beside[done - 1];
  }
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> ritz;
  ritz.computeFromTridiagonal(diagonal.head(done), beside.head(done - 1));
  return ritz.eigenvalues()[done - 1] +
         std::abs(beside[done - 1] * ritz.eigenvectors()(done - 1, done - 1));
}

}  // namespace breast
