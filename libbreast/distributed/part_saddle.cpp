// SPDX-License-Identifier: GPL-3.0-or-later
#include "distributed/part_saddle.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "distributed/part_matrices.hpp"
#include "distributed/saddle_settings.hpp"

namespace breast {

namespace {

PetscErrorCode apply_map(Mat a, Vec z, Vec out) {
  void* context = nullptr;
  PetscCall(MatShellGetContext(a, &context));
  (*static_cast<const std::function<void(Vec, Vec)>*>(context))(z, out);
  return 0;
}

double values_of(Mat a) {
  MatInfo info;
  return MatGetInfo(a, MAT_GLOBAL_SUM, &info) == 0 ? info.nz_used : 0;
}

}  // namespace

struct PartSaddle::Impl {
  Impl(const Exchange& of, const Discretisation& in) : exchange(of), matrices(of, in) {}

  void scale(const SaddleMatrix& matrix);
  void schur_solve(const double* q, double* p) const;
  // This rank's part of a PETSc vector; `top` is in node axes.
  void write(const Constraints& axes, Eigen::VectorXd top, const Eigen::VectorXd& bottom,
             Vec vec) const;
  void read(const Constraints& axes, Vec vec, Eigen::VectorXd& top, Eigen::VectorXd& bottom) const;
  SaddleStep run(const Constraints& axes, const Eigen::VectorXd& top, const Eigen::VectorXd& bottom,
                 double tolerance, int most, double& residual) const;

  const Exchange& exchange;
  PartMatrices matrices;
  std::shared_ptr<const PressureSpace> space;
  Eigen::VectorXd kappa, stiff;  // stiff: 1/(1/μ + c)
  double weigh = 1, left_over = 1;
  std::function<void(const double*, double*)> schur_inverse;
  OwnedKsp split, gradients;
  OwnedVec right, left;  // (u, p)
  OwnedVec schur_right, schur_left;
};

// Volumes converted to forces, θκ/h with the size h of an element, so that one norm measures both
// equations.
void PartSaddle::Impl::scale(const SaddleMatrix& matrix) {
  const Ranks& ranks = exchange.ranks();
  space = matrix.space;
  const double count = double(ranks.sum(long(space->elements())));
  double volume = 0;
  for (int e = 0; e < space->elements(); ++e) volume += space->volume(e);
  const double size = std::cbrt(ranks.sum(volume) / count);
  kappa = matrix.kappa;
  weigh = ranks.sum(kappa.sum()) / count / size;
  // κc is the same in every element.
  left_over = 1 - kappa[0] * space->compliance[0];
  if (left_over < schur_nothing_left) left_over = 0;
  stiff = (matrix.shear.cwiseInverse() + space->compliance).cwiseInverse();
}

void PartSaddle::Impl::schur_solve(const double* from, double* to) const {
  const long count = space->rows * long(space->elements());
  const Eigen::VectorXd q = Eigen::Map<const Eigen::VectorXd>(from, count) / weigh;
  Eigen::Map<Eigen::VectorXd> p(to, count);
  p = space->divide(q, kappa);
  if (left_over == 0) return;
  if (gradients == nullptr) {
    p += left_over * space->divide(q, stiff);
    return;
  }
  double* values = nullptr;
  ask(VecGetArray(schur_right, &values));
  std::copy_n(q.data(), count, values);
  ask(VecRestoreArray(schur_right, &values));
  ask(KSPSolve(gradients, schur_right, schur_left));
  ask(VecGetArray(schur_left, &values));
  p += left_over * Eigen::Map<const Eigen::VectorXd>(values, count);
  ask(VecRestoreArray(schur_left, &values));
}

void PartSaddle::Impl::write(const Constraints& axes, Eigen::VectorXd top,
                             const Eigen::VectorXd& bottom, Vec vec) const {
  axes.project(top);
  axes.to_axes(top);
  const long own = 3L * exchange.part().owned;
  double* values = nullptr;
  ask(VecGetArray(vec, &values));
  std::copy_n(top.data(), own, values);
  std::copy_n(bottom.data(), bottom.size(), values + own);
  ask(VecRestoreArray(vec, &values));
}

void PartSaddle::Impl::read(const Constraints& axes, Vec vec, Eigen::VectorXd& top,
                            Eigen::VectorXd& bottom) const {
  const long own = 3L * exchange.part().owned;
  top = Eigen::VectorXd::Zero(3L * exchange.part().mesh.nodes());
  bottom.resize(space->rows * long(space->elements()));
  const double* values = nullptr;
  ask(VecGetArrayRead(vec, &values));
  std::copy_n(values, own, top.data());
  std::copy_n(values + own, bottom.size(), bottom.data());
  ask(VecRestoreArrayRead(vec, &values));
  exchange.from_owner(top);
  axes.from_axes(top);
  axes.project(top);
}

SaddleStep PartSaddle::Impl::run(const Constraints& axes, const Eigen::VectorXd& top,
                                 const Eigen::VectorXd& bottom, double tolerance, int most,
                                 double& residual) const {
  SaddleStep step;
  write(axes, top, weigh * bottom, right);
  double start = 0;
  ask(VecNorm(right, NORM_2, &start));
  ask(VecSet(left, 0));
  residual = 0;
  if (start > 0) {
    ask(KSPSetTolerances(split, tolerance, PETSC_DEFAULT, PETSC_DEFAULT, most));
    ask(KSPSolve(split, right, left));
    KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
    PetscInt iterations = 0;
    ask(KSPGetConvergedReason(split, &reason));
    ask(KSPGetIterationNumber(split, &iterations));
    ask(KSPGetResidualNorm(split, &residual));
    residual /= start;
    step.iterations = int(iterations);
    step.solved = reason > 0;
    if (reason < 0 && reason != KSP_DIVERGED_ITS) {
      residual = std::numeric_limits<double>::quiet_NaN();
    }
  }
  read(axes, left, step.u, step.p);
  return step;
}

PartSaddle::PartSaddle(const Exchange& exchange, const Discretisation& space)
    : SaddleSolverBase(exchange.part().mesh.nodes()),
      impl_(std::make_unique<Impl>(exchange, space)) {
  impl_->schur_inverse = [this](const double* q, double* p) { impl_->schur_solve(q, p); };
}
PartSaddle::~PartSaddle() = default;

Factorisation PartSaddle::factorise(const SaddleMatrix& matrix, const Constraints& constraints,
                                    bool /*may_shift*/) {
  constraints_ = constraints;
  ++factorisations_;
  Impl& m = *impl_;
  m.scale(matrix);
  m.split.reset();
  m.gradients.reset();
  if (!m.matrices.fill(matrix, constraints_, m.weigh, m.left_over)) return {false, 0, 1};
  if (m.matrices.sparse_schur() != nullptr) {
    m.gradients = schur_gradients(m.matrices.sparse_schur());
    ask(MatCreateVecs(m.matrices.sparse_schur(), m.schur_right.fresh(), m.schur_left.fresh()));
  }
  m.split = split_gmres(m.matrices.whole(), m.schur_inverse);
  ask(MatCreateVecs(m.matrices.whole(), m.right.fresh(), m.left.fresh()));
  return {true, 0, 1};
}

SaddleStep PartSaddle::solve_imposed(const SaddleMatrix& matrix, const Eigen::VectorXd& r,
                                     const Eigen::VectorXd& theta, const Eigen::VectorXd& imposed,
                                     double tolerance, int restarts) const {
  const ElementRows& b = matrix.divergence;
  Eigen::VectorXd top = -b.apply_transpose(matrix.space->divide(theta, matrix.kappa));
  Eigen::VectorXd bottom = -theta;
  if (imposed.size() > 0) {
    top -= matrix.stiffness.multiply(imposed);
    bottom -= b.apply(imposed);
  }
  impl_->exchange.complete(top);
  top -= r;
  double residual = 0;
  SaddleStep step = impl_->run(constraints_, top, bottom, gmres_part_of_tolerance * tolerance,
                               restarts * gmres_restart, residual);
  if (imposed.size() > 0) step.u += imposed;
  return step;
}

// Acts on (w, q) with w = −δX as [−K_X −Bᵀ; −B_X cM], which is close to [K −Bᵀ; B cM]
// (mechanics/reference_system.hpp). κBᵀM⁻¹ times the volumes is added to the forces on both sides,
// which makes the matrix similar to the one from which the multigrid levels are built.
SolveReference PartSaddle::solve_reference() const {
  return
      [this](const SaddleMatrix& matrix, const ReferenceTangent& tangent, const Constraints& moved,
             const Eigen::VectorXd& f, const Eigen::VectorXd& v, double tolerance, int most) {
        const PressureSpace& space = *matrix.space;
        const auto augment = [&](const Eigen::VectorXd& bottom) -> Eigen::VectorXd {
          return matrix.divergence.apply_transpose(space.divide(bottom, matrix.kappa));
        };
        const Map map = [&](const Eigen::VectorXd& u, const Eigen::VectorXd& q,
                            Eigen::VectorXd& top, Eigen::VectorXd& bottom) {
          Eigen::VectorXd w = u;
          moved.project(w);
          bottom = space.multiply(q, space.compliance) - tangent.b_x.apply(w);
          top = augment(bottom) - tangent.apply(w) - tangent.b.apply_transpose(q);
        };
        Eigen::VectorXd top = augment(v);
        impl_->exchange.complete(top);
        top += f;
        double residual = 0;
        SaddleStep step = solve_near(map, top, v, tolerance, most, residual);
        moved.project(step.u);
        return ReferenceStep{-step.u, step.p, step.iterations, residual};
      };
}

SaddleStep PartSaddle::solve_near(const Map& map, const Eigen::VectorXd& top,
                                  const Eigen::VectorXd& bottom, double tolerance, int most,
                                  double& residual) const {
  const Impl& m = *impl_;
  const std::function<void(Vec, Vec)> apply = [&](Vec z, Vec out) {
    Eigen::VectorXd u, p, above, below;
    m.read(constraints_, z, u, p);
    map(u, p, above, below);
    m.exchange.complete(above);
    m.write(constraints_, above, m.weigh * below, out);
  };
  PetscInt rows = 0, columns = 0;
  ask(MatGetLocalSize(m.matrices.whole(), &rows, &columns));
  OwnedMat shell;
  ask(MatCreateShell(PETSC_COMM_WORLD, rows, columns, PETSC_DETERMINE, PETSC_DETERMINE,
                     const_cast<void*>(static_cast<const void*>(&apply)), shell.fresh()));
  ask(MatShellSetOperation(shell, MATOP_MULT, reinterpret_cast<void (*)()>(apply_map)));
  ask(KSPSetOperators(m.split, shell, m.matrices.whole()));
  SaddleStep step = m.run(constraints_, top, bottom, tolerance, most, residual);
  ask(KSPSetOperators(m.split, m.matrices.whole(), m.matrices.whole()));
  return step;
}

bool PartSaddle::positive_definite() const {
  const Impl& m = *impl_;
  if (m.split == nullptr) return false;
  const Mat k = m.matrices.stiffness();
  const OwnedKsp ksp = lanczos(k, first_block(m.split), most_definite_steps);
  OwnedVec start, found;
  ask(MatCreateVecs(k, start.fresh(), found.fresh()));
  const Numbering& numbering = m.matrices.numbering();
  Eigen::VectorXd wave(3L * m.exchange.part().mesh.nodes());  // a vector that is not an eigenvector
  for (long i = 0; i < wave.size(); ++i) {
    wave[i] = std::sin(2.0 + 5.1 * double(3L * numbering.node[std::size_t(i / 3)] + i % 3));
  }
  constraints_.project(wave);
  constraints_.to_axes(wave);
  double* values = nullptr;
  ask(VecGetArray(start, &values));
  std::copy_n(wave.data(), 3L * numbering.owned, values);
  ask(VecRestoreArray(start, &values));
  ask(KSPSolve(ksp, start, found));
  KSPConvergedReason reason = KSP_CONVERGED_ITERATING;
  ask(KSPGetConvergedReason(ksp, &reason));
  if (reason < 0 && reason != KSP_DIVERGED_ITS) return false;
  std::vector<double> real(most_definite_steps + 1), imaginary(most_definite_steps + 1);
  PetscInt count = 0;
  ask(KSPComputeEigenvalues(ksp, PetscInt(real.size()), real.data(), imaginary.data(), &count));
  return count > 0 && *std::min_element(real.begin(), real.begin() + count) > 0;
}

double PartSaddle::matrix_values() const {
  return impl_->split == nullptr ? 0 : values_of(impl_->matrices.stiffness());
}

double PartSaddle::level_values() const {
  if (impl_->split == nullptr) return 0;
  PC pc = nullptr;
  PetscInt levels = 0;
  PetscReal grids = 0, operators = 1;
  ask(KSPGetPC(first_block(impl_->split), &pc));
  if (PCMGGetLevels(pc, &levels) != 0 || PCMGGetGridComplexity(pc, &grids, &operators) != 0)
    return 0;
  return operators * matrix_values();
}

}  // namespace breast
