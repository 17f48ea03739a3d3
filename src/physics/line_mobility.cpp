#include "line_mobility.hpp"

#include "kernels/regularized_stokeslet.hpp"

namespace skein {

LineMobility make_line_mobility(const int n_nodes, const double spacing, const double blob) {
  LineMobility line{Eigen::MatrixXd(n_nodes, n_nodes), Eigen::MatrixXd(n_nodes, n_nodes)};
  for (int i = 0; i < n_nodes; ++i)
    for (int j = 0; j < n_nodes; ++j) {
      const double d = (i - j) * spacing;
      const auto weight = regularized_stokeslet::weights(d, 0.0, 0.0, blob * blob);
      line.across(i, j) = regularized_stokeslet::scale(1.0) * weight.isotropic;
      line.along(i, j) = line.across(i, j) + regularized_stokeslet::scale(1.0) * weight.along * d * d;
    }
  return line;
}

Eigen::VectorXd list_line_places(const int n_nodes, const double spacing) {
  return Eigen::VectorXd::LinSpaced(n_nodes, -0.5, 0.5) * ((n_nodes - 1) * spacing);
}

}  // namespace skein
