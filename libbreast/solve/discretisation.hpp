// SPDX-License-Identifier: GPL-3.0-or-later
// The unknowns of a problem and their couplings, defined on the imaged shape and shared by all
// terms.
#pragma once

#include <memory>

#include "solve/saddle_matrix.hpp"

namespace breast {

struct Discretisation {
  int node_count = 0;
  Cells cells;                                 ///< the elements
  std::shared_ptr<const NodePattern> pattern;  ///< null where no matrix is assembled
  std::shared_ptr<const PressureSpace> pressures;

  int nodes() const { return node_count; }
  long pressure_count() const { return long(pressures->rows) * pressures->elements(); }
  /// A matrix of the right sizes, all zero; needs the pattern.
  SaddleMatrix make_matrix() const;
};

}  // namespace breast
