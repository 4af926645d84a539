// How far the tissue is strained, and where a failed trial folds it.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>
#include <vector>

#include "contact/plates.hpp"
#include "mesh/hex_mesh.hpp"

namespace breast {

/// Principal stretches and det F over the quadrature points of a tissue.
struct StrainRange {
  double min_stretch = 1, max_stretch = 1, min_det_F = 1, max_det_F = 1;
};
/// Per tissue present, F from mesh.reference to `x` (3 per node).
std::map<Tissue, StrainRange> strain_ranges(const HexMesh& mesh, const Eigen::VectorXd& x);

/// Smallest det F from mesh.reference to `x` over quadrature points and corners, per element.
std::vector<double> smallest_det_F(const HexMesh& mesh, const Eigen::VectorXd& x);

/// One sentence on why `trial` was refused: the elements that fold, where they lie in the last good
/// shape (mm), their tissue, and what they are caught between. `trial` may be empty.
std::string explain_failure(const HexMesh& mesh, const Eigen::VectorXd& good,
                            const Eigen::VectorXd& trial, const PlatePair& plates);

}  // namespace breast
