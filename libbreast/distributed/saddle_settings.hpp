// SPDX-License-Identifier: GPL-3.0-or-later
// Settings of PETSc's solvers: GMRES split by field, GAMG, conjugate gradients. For the .cpp files
// of this folder only.
#pragma once

#include <functional>

#include "distributed/petsc.hpp"

namespace breast {

/// Flexible GMRES for `whole` (a 2 × 2 nested matrix) with a block-triangular preconditioner: GAMG
/// for the first block and `schur` for the Schur complement of the second. `schur` maps an array of
/// this rank's pressures to another and must outlive the result.
OwnedKsp split_gmres(Mat whole, const std::function<void(const double*, double*)>& schur);
/// The solver of the first block of split_gmres.
KSP first_block(KSP split);
/// Conjugate gradients for the sparse approximation of the Schur complement, to a relative residual
/// of a tenth.
OwnedKsp schur_gradients(Mat sparse);
/// Conjugate gradients that record estimates of eigenvalues, with the preconditioner of `levels`.
OwnedKsp lanczos(Mat a, KSP levels, int most);

}  // namespace breast
