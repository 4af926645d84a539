// SPDX-License-Identifier: GPL-3.0-or-later
#include "distributed/saddle_settings.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "solve/multigrid/pressure_schur.hpp"
#include "solve/multigrid/settings.hpp"
#include "solve/saddle.hpp"

namespace breast {

namespace {

// Sets an option of the first block's solver unless the user's PETSC_OPTIONS set it.
void prefer(const std::string& option, const std::string& value) {
  const std::string name = "-breast_fieldsplit_u_" + option;
  PetscBool given = PETSC_FALSE;
  ask(PetscOptionsHasName(nullptr, nullptr, name.c_str(), &given));
  if (given == PETSC_FALSE) ask(PetscOptionsSetValue(nullptr, name.c_str(), value.c_str()));
}

// PETSc takes the largest eigenvalue as conjugate gradients find it, from below; ours is a bound.
constexpr double above_largest = 1.05;
constexpr int coarsest_unknowns = 600;

// The same smoother and couplings as in our own multigrid (docs/methods.md, section 5). In contrast
// to it, the aggregates on the finest level contain neighbours of neighbours: on the block of 12³,
// GMRES takes a quarter more iterations and the set-up a fifth of the time.
void prefer_levels() {
  prefer("ksp_type", "preonly");
  prefer("pc_type", "gamg");
  prefer("pc_gamg_threshold", message(strong_coupling));
  prefer("pc_gamg_square_graph", "1");
  prefer("pc_gamg_threshold_scale", message(coupling_decay));
  prefer("pc_gamg_coarse_eq_limit", message(coarsest_unknowns));
  prefer("mg_levels_ksp_type", "chebyshev");
  prefer("mg_levels_ksp_max_it", message(smoother_degree));
  prefer("mg_levels_ksp_chebyshev_esteig", message("0,", smoothed_from, ",0,", above_largest));
  prefer("mg_levels_esteig_ksp_type", "cg");
  prefer("mg_levels_esteig_ksp_max_it", message(spectrum_steps));
  prefer("mg_levels_pc_type", "jacobi");
}

PetscErrorCode apply(PC pc, Vec q, Vec p) {
  void* context = nullptr;
  const double* in = nullptr;
  double* out = nullptr;
  PetscCall(PCShellGetContext(pc, &context));
  PetscCall(VecGetArrayRead(q, &in));
  PetscCall(VecGetArray(p, &out));
  (*static_cast<const std::function<void(const double*, double*)>*>(context))(in, out);
  PetscCall(VecRestoreArray(p, &out));
  PetscCall(VecRestoreArrayRead(q, &in));
  return 0;
}

// The solvers of the two fields.
std::pair<KSP, KSP> fields(KSP split) {
  PC pc = nullptr;
  ask(KSPGetPC(split, &pc));
  PetscInt count = 0;
  KSP* subs = nullptr;
  ask(PCFieldSplitSchurGetSubKSP(pc, &count, &subs));
  const std::pair<KSP, KSP> found{subs[0], subs[1]};
  ask(PetscFree(subs));
  return found;
}

}  // namespace

OwnedKsp split_gmres(Mat whole, const std::function<void(const double*, double*)>& schur) {
  prefer_levels();
  OwnedKsp ksp;
  ask(KSPCreate(PETSC_COMM_WORLD, ksp.fresh()));
  ask(KSPSetOptionsPrefix(ksp, "breast_"));
  ask(KSPSetOperators(ksp, whole, whole));
  ask(KSPSetType(ksp, KSPFGMRES));
  ask(KSPGMRESSetRestart(ksp, gmres_restart));
  PC pc = nullptr;
  ask(KSPGetPC(ksp, &pc));
  ask(PCSetType(pc, PCFIELDSPLIT));
  IS rows[2] = {nullptr, nullptr};
  ask(MatNestGetISs(whole, rows, nullptr));
  ask(PCFieldSplitSetIS(pc, "u", rows[0]));
  ask(PCFieldSplitSetIS(pc, "p", rows[1]));
  ask(PCFieldSplitSetType(pc, PC_COMPOSITE_SCHUR));
  ask(PCFieldSplitSetSchurFactType(pc, PC_FIELDSPLIT_SCHUR_FACT_LOWER));
  ask(PCFieldSplitSetSchurPre(pc, PC_FIELDSPLIT_SCHUR_PRE_SELF, nullptr));
  ask(KSPSetFromOptions(ksp));
  ask(KSPSetUp(ksp));
  const auto [u, p] = fields(ksp);
  ask(KSPSetType(p, KSPPREONLY));
  PC shell = nullptr;
  ask(KSPGetPC(p, &shell));
  ask(PCSetType(shell, PCSHELL));
  ask(PCShellSetContext(shell, const_cast<void*>(static_cast<const void*>(&schur))));
  ask(PCShellSetApply(shell, apply));
  ask(KSPSetUp(u));
  return ksp;
}

KSP first_block(KSP split) {
  return fields(split).first;
}

OwnedKsp schur_gradients(Mat sparse) {
  OwnedKsp ksp;
  ask(KSPCreate(PETSC_COMM_WORLD, ksp.fresh()));
  ask(KSPSetOptionsPrefix(ksp, "breast_schur_"));
  ask(KSPSetOperators(ksp, sparse, sparse));
  ask(KSPSetType(ksp, KSPCG));
  ask(KSPSetNormType(ksp, KSP_NORM_NATURAL));
  PC pc = nullptr;
  ask(KSPGetPC(ksp, &pc));
  ask(PCSetType(pc, PCJACOBI));
  PetscInt elements = 0;
  ask(MatGetSize(sparse, &elements, nullptr));
  const int steps = int(schur_steps_per_edge * std::cbrt(double(elements)));
  ask(KSPSetTolerances(ksp, schur_accuracy, PETSC_DEFAULT, PETSC_DEFAULT,
                       std::max(schur_least_steps, steps)));
  ask(KSPSetFromOptions(ksp));
  ask(KSPSetUp(ksp));
  return ksp;
}

OwnedKsp lanczos(Mat a, KSP levels, int most) {
  OwnedKsp ksp;
  ask(KSPCreate(PETSC_COMM_WORLD, ksp.fresh()));
  ask(KSPSetOperators(ksp, a, a));
  ask(KSPSetType(ksp, KSPCG));
  PC pc = nullptr;
  ask(KSPGetPC(levels, &pc));
  ask(KSPSetPC(ksp, pc));
  ask(KSPSetComputeEigenvalues(ksp, PETSC_TRUE));
  ask(KSPSetTolerances(ksp, 1e-8, PETSC_DEFAULT, PETSC_DEFAULT, most));
  return ksp;
}

}  // namespace breast
