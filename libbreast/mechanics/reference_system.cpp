// SPDX-License-Identifier: GPL-3.0-or-later
#include "mechanics/reference_system.hpp"

#include "solve/krylov/gmres.hpp"

namespace breast {

ReferenceSystem::ReferenceSystem(const SaddleMatrix& matrix, const ReferenceTangent& tangent,
                                 const SaddleSolver& solver, const Constraints& moved, double size)
    : matrix_(matrix),
      tangent_(tangent),
      solver_(solver),
      moved_(moved),
      weigh_(matrix.kappa.mean() / (100 * size)) {}

// Acts on (w, q) with w = −δX as [−K_X −Bᵀ; −B_X cM], or as [−K_Xᵀ B_Xᵀ; B cM] for the transpose;
// both are close to [K −Bᵀ; B cM]. Rows belong to forces at x, columns to displacements of X: the
// constraints of the two differ where nodes slide.
Eigen::VectorXd ReferenceSystem::apply(bool transposed, const Eigen::VectorXd& z) const {
  const PressureSpace& space = *matrix_.space;
  const long m = long(space.rows) * space.elements(), n = z.size() - m;
  Eigen::VectorXd w = z.head(n);
  const Eigen::VectorXd q = z.tail(m);
  if (!transposed) moved_.project(w);
  Eigen::VectorXd top =
      transposed ? Eigen::VectorXd(tangent_.b_x.apply_transpose(q) - tangent_.apply_transpose(w))
                 : Eigen::VectorXd(-tangent_.apply(w) - tangent_.b.apply_transpose(q));
  (transposed ? moved_ : solver_.constraints()).project(top);
  Eigen::VectorXd bottom = space.multiply(q, space.compliance);
  if (transposed) {
    bottom += tangent_.b.apply(w);
  } else {
    bottom -= tangent_.b_x.apply(w);
  }
  Eigen::VectorXd out(z.size());
  out << top, weigh_ * bottom;
  return out;
}

Eigen::VectorXd ReferenceSystem::precondition(const Eigen::VectorXd& y) const {
  const PressureSpace& space = *matrix_.space;
  const long m = long(space.rows) * space.elements(), n = y.size() - m;
  const Eigen::VectorXd top = y.head(n), bottom = y.tail(m) / weigh_;
  Eigen::VectorXd w = solver_.back_solve(
      top + matrix_.divergence.apply_transpose(space.divide(bottom, matrix_.kappa)));
  const Eigen::VectorXd q = solver_.schur_solve(matrix_, bottom - matrix_.divergence.apply(w));
  Eigen::VectorXd out(y.size());
  out << w, q;
  return out;
}

ReferenceStep ReferenceSystem::run(bool transposed, const Eigen::VectorXd& f,
                                   const Eigen::VectorXd& v, double tolerance,
                                   int max_iterations) const {
  Eigen::VectorXd free = f, right(f.size() + v.size());
  (transposed ? moved_ : solver_.constraints()).project(free);
  right << free, weigh_ * v;
  const GmresResult solved = gmres([&](const Eigen::VectorXd& z) { return apply(transposed, z); },
                                   [&](const Eigen::VectorXd& y) { return precondition(y); }, right,
                                   tolerance, max_iterations);
  Eigen::VectorXd w = solved.x.head(f.size());
  if (!transposed) moved_.project(w);
  return {-w, solved.x.tail(v.size()), solved.iterations,
          solved.x.allFinite() ? solved.residual : std::numeric_limits<double>::quiet_NaN()};
}

ReferenceStep ReferenceSystem::solve(const Eigen::VectorXd& f, const Eigen::VectorXd& v,
                                     double tolerance, int max_iterations) const {
  return run(false, f, v, tolerance, max_iterations);
}

ReferenceStep ReferenceSystem::solve_transposed(const Eigen::VectorXd& f, const Eigen::VectorXd& v,
                                                double tolerance, int max_iterations) const {
  return run(true, f, v, tolerance, max_iterations);
}

}  // namespace breast
