#include "core/parallel.hpp"
#include "mechanics/assembly.hpp"

namespace breast {

namespace {

// out += Σ matrix_c v_c over cells: products in parallel, sums in cell order.
void add_products(const Cells& cells, const std::vector<double>& matrices, const Eigen::VectorXd& v,
                  bool transposed, Eigen::VectorXd& out) {
  const int n = 3 * cells.nodes_per_cell;
  Eigen::MatrixXd products(n, cells.count());
#pragma omp parallel for num_threads(threads()) schedule(static)
  for (int c = 0; c < cells.count(); ++c) {
    Eigen::VectorXd local(n);
    for (int a = 0; a < n / 3; ++a) local.segment<3>(3L * a) = v.segment<3>(3L * cells.cell(c)[a]);
    const Eigen::Map<const Eigen::MatrixXd> matrix(matrices.data() + std::size_t(c) * n * n, n, n);
    if (transposed) {
      products.col(c).noalias() = matrix.transpose() * local;
    } else {
      products.col(c).noalias() = matrix * local;
    }
  }
  for (int c = 0; c < cells.count(); ++c) {
    for (int a = 0; a < n / 3; ++a) {
      out.segment<3>(3L * cells.cell(c)[a]) += products.col(c).segment<3>(3L * a);
    }
  }
}

}  // namespace

Eigen::VectorXd ReferenceTangent::apply(const Eigen::VectorXd& v) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(v.size());
  add_products(*elements, element_matrices, v, false, out);
  if (faces->count() > 0) add_products(*faces, face_matrices, v, false, out);
  return out;
}

Eigen::VectorXd ReferenceTangent::apply_transpose(const Eigen::VectorXd& v) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(v.size());
  add_products(*elements, element_matrices, v, true, out);
  if (faces->count() > 0) add_products(*faces, face_matrices, v, true, out);
  return out;
}

}  // namespace breast
