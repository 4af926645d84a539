// SPDX-License-Identifier: GPL-3.0-or-later
// The derivatives of a state's landmarks as a table, and the arrays for its file.
#pragma once

#include "core/report.hpp"
#include "core/table.hpp"
#include "mesh/derivatives.hpp"
#include "sensitivity/chain.hpp"

namespace breast {

struct SensitivityResults {
  /// Table with columns landmark, parameter, per (its unit), derivative dx dy dz (mm), dlnu,
  /// seconds.
  Table table;
  Derivatives arrays;
};

/// Derivatives of all node positions by the tangent-linear method, for every parameter. Sets the
/// keys sensitivity/LANDMARK/PARAMETER/... and sensitivity/paddle/... of the report.
SensitivityResults tangent_results(const SensitivityChain& chain,
                                   const std::vector<Parameter>& parameters, const HexMesh& mesh,
                                   Report& report, Progress& progress = no_progress());
/// Derivatives of the landmarks only, by the adjoint method, and the influence of every element's
/// stiffness on them.
SensitivityResults adjoint_results(const SensitivityChain& chain,
                                   const std::vector<Parameter>& parameters, const HexMesh& mesh,
                                   Report& report, Progress& progress = no_progress());

}  // namespace breast
