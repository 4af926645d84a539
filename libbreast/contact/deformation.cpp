// SPDX-License-Identifier: GPL-3.0-or-later
#include "contact/deformation.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "mesh/gauss.hpp"
#include "mesh/shape.hpp"

namespace breast {

namespace {

std::vector<HexShape> gauss_shapes(int order) {
  std::vector<HexShape> shapes;
  for (const auto& point : gauss_cube(order + 1)) shapes.push_back(hex_shape(order, point.at));
  return shapes;
}

/// The deformation gradient F = ∂x/∂X of an element at a point.
Mat3 deformation_gradient(const HexMesh& mesh, const Eigen::VectorXd& x, int element,
                          const HexShape& shape) {
  Mat3 now = Mat3::Zero(), before = Mat3::Zero();
  for (int a = 0; a < mesh.nodes_per_element(); ++a) {
    const int node = mesh.element(element)[a];
    now += x.segment<3>(3 * node) * shape.gradients.col(a).transpose();
    before += mesh.reference[std::size_t(node)] * shape.gradients.col(a).transpose();
  }
  return now * before.inverse();
}

}  // namespace

std::map<Tissue, StrainRange> strain_ranges(const HexMesh& mesh, const Eigen::VectorXd& x) {
  const std::vector<HexShape> shapes = gauss_shapes(mesh.order);
  std::map<Tissue, StrainRange> ranges;
  for (int e = 0; e < mesh.elements(); ++e) {
    StrainRange& range = ranges[mesh.tissue[std::size_t(e)]];
    for (const HexShape& shape : shapes) {
      const Mat3 F = deformation_gradient(mesh, x, e, shape);
      const Vec3 squares =
          Eigen::SelfAdjointEigenSolver<Mat3>(F.transpose() * F, Eigen::EigenvaluesOnly)
              .eigenvalues();
      const double det = F.determinant();
      range.min_stretch = std::min(range.min_stretch, std::sqrt(std::max(0.0, squares[0])));
      range.max_stretch = std::max(range.max_stretch, std::sqrt(squares[2]));
      range.min_det_F = std::min(range.min_det_F, det);
      range.max_det_F = std::max(range.max_det_F, det);
    }
  }
  return ranges;
}

std::vector<double> smallest_det_F(const HexMesh& mesh, const Eigen::VectorXd& x) {
  std::vector<HexShape> shapes = gauss_shapes(mesh.order);
  for (int corner = 0; corner < 8; ++corner) {
    shapes.push_back(hex_shape(mesh.order, hex_node_local(mesh.order, corner)));
  }
  std::vector<double> smallest(std::size_t(mesh.elements()));
  for (int e = 0; e < mesh.elements(); ++e) {
    double least = 1e30;
    for (const HexShape& shape : shapes) {
      least = std::min(least, deformation_gradient(mesh, x, e, shape).determinant());
    }
    smallest[std::size_t(e)] = least;
  }
  return smallest;
}

}  // namespace breast
