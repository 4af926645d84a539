// SPDX-License-Identifier: GPL-3.0-or-later
// How PETSc is asked to solve: GMRES split by field, GAMG, conjugate gradients. For the .cpp files of
// this folder only.
#pragma once

#include <functional>

#include "distributed/petsc.hpp"

namespace breast {

/// Flexible GMRES on `whole` (a nest of 2 × 2), its preconditioner block triangular: GAMG for the
/// first block, `schur` (from an array of this rank's pressures to another) for the second's Schur
/// complement. `schur` must outlive the result.
OwnedKsp split_gmres(Mat whole, const std::function<void(const double*, double*)>& schur);
/// Of split_gmres: the solver of the first block.
KSP first_block(KSP split);
/// Conjugate gradients to a tenth on the sparse stand-in for the Schur complement.
OwnedKsp schur_gradients(Mat sparse);
/// Conjugate gradients that keep what they learn of eigenvalues, with the preconditioner of `levels`.
OwnedKsp lanczos(Mat a, KSP levels, int most);

}  // namespace breast
