// SPDX-License-Identifier: GPL-3.0-or-later
#include "solve/discretisation.hpp"

namespace breast {

SaddleMatrix Discretisation::make_matrix() const {
  SaddleMatrix matrix{NodeMatrix(pattern), {}, {}, {}, {}, pressures, {}};
  matrix.divergence.resize(cells, pressures->rows);
  matrix.kappa = matrix.shear = Eigen::VectorXd::Zero(pressures->elements());
  matrix.diagonal = Eigen::VectorXd::Zero(pattern->unknowns());
  return matrix;
}

}  // namespace breast
