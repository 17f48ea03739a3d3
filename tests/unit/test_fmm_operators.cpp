#include "fmm/fmm_operators.hpp"
#include "fmm/matrix_product.hpp"
#include "fmm/octree.hpp"
#include "tests/reference/point_cloud.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace skein {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// The columns of a padded matrix, without the padding of its rows.
template <class Real>
MatrixXd dense(const PaddedMatrix<Real>& matrix, const int n_rows) {
  MatrixXd result(n_rows, matrix.n_columns);
  for (int j = 0; j < matrix.n_columns; ++j)
    for (int i = 0; i < n_rows; ++i)
      result(i, j) = static_cast<double>(matrix.entry(
          static_cast<std::size_t>(j) * static_cast<std::size_t>(matrix.n_rows) + static_cast<std::size_t>(i)));
  return result;
}

TEST(MatrixProduct, AgreesWithEigenAndDoesNotMixColumns) {
  reference::Random random(3);
  for (const int n : {8, 24, 40, 112})
    for (const int depth : {1, 7, 30})
      for (const int columns : {1, 3, 4, 13, 64}) {
        MatrixXd a(n, depth), b(depth, columns), c(n, columns), one(n, 1);
        for (double& x : a.reshaped()) x = random.uniform(-1.0, 1.0);
        for (double& x : b.reshaped()) x = random.uniform(-1.0, 1.0);
        multiply(a.data(), n, n, depth, b.data(), depth, columns, c.data(), n);
        EXPECT_LT((c - a * b).norm(), 1e-14 * (1.0 + c.norm()));
        multiply(a.data(), n, n, depth, b.col(columns - 1).data(), depth, 1, one.data(), n);
        EXPECT_EQ(one.col(0), c.col(columns - 1)) << "a column's bits depend on its neighbours";
      }
}

TEST(Surface, HasItsPointsOnTheCube) {
  for (const int order : {2, 3, 4, 6, 7}) {
    const auto surface = make_surface(order);
    EXPECT_EQ(surface.rows(), 6 * (order - 1) * (order - 1) + 2);
    std::set<std::array<double, 3>> points;
    for (Eigen::Index i = 0; i < surface.rows(); ++i) {
      EXPECT_DOUBLE_EQ(surface.row(i).cwiseAbs().maxCoeff(), 1.0);
      points.insert({surface(i, 0), surface(i, 1), surface(i, 2)});
    }
    EXPECT_EQ(static_cast<Eigen::Index>(points.size()), surface.rows());
  }
}

/// Potential of unit charges at `from` with strengths q.
VectorXd potential(const Eigen::MatrixX3d& to, const Eigen::MatrixX3d& from, const VectorXd& q) {
  VectorXd result = VectorXd::Zero(to.rows());
  for (Eigen::Index i = 0; i < to.rows(); ++i)
    for (Eigen::Index j = 0; j < from.rows(); ++j) result(i) += q(j) / (to.row(i) - from.row(j)).norm();
  return result;
}

struct Charges {
  Eigen::MatrixX3d at;
  VectorXd strength;
};
Charges make_charges(const int n, const Eigen::RowVector3d& center, const double half_width) {
  reference::Random random(7);
  Charges charges{Eigen::MatrixX3d(n, 3), VectorXd(n)};
  for (int i = 0; i < n; ++i) {
    const Vec3 x = random.in_cube(half_width);
    charges.at.row(i) = center + Eigen::RowVector3d(x.x, x.y, x.z);
    charges.strength(i) = random.uniform(0.2, 1.3);
  }
  return charges;
}

/// Bits of all transfers between boxes that do not touch.
std::uint64_t far_transfers() {
  std::uint64_t bits = 0;
  for (signed char x = 0; x < 4; ++x)
    for (signed char y = 0; y < 4; ++y)
      for (signed char z = 0; z < 4; ++z)
        if (std::max({x, y, z}) > 1) bits |= std::uint64_t{1} << transfer_index({x, y, z});
  return bits;
}

class HarmonicOperators : public ::testing::TestWithParam<int> {
 protected:
  HarmonicOperators()
      : operators_(FarField::harmonic, GetParam(), 1e-14, 1e-3 * tolerance(), 0.0), surface_(make_surface(GetParam())) {
    operators_.require_transfers(far_transfers());
    operators_.require_passes(operators_);
  }
  const OperatorSet<double>& set() const { return operators_.set(); }
  int n() const { return set().n_surface; }
  double tolerance() const { return 3.0 * std::pow(10.0, 1.0 - 0.9 * GetParam()) + 1e-12; }

  VectorXd source_coefficients(const VectorXd& on_outer) const {
    return dense(set().to_source, set().rank).leftCols(n()) * on_outer;
  }
  VectorXd apply(const FactoredMatrix<double>& matrix, const VectorXd& c) const {
    const auto times = [](const PaddedMatrix<double>& factor, const VectorXd& column) {
      VectorXd product(factor.n_rows);
      multiply(factor.entry.data(), factor.n_rows, factor.n_rows, factor.n_columns, column.data(), factor.n_columns, 1,
               product.data(), factor.n_rows);
      return product;
    };
    return times(matrix.last, matrix.first.empty() ? c : times(matrix.first, c)).head(set().rank);
  }
  VectorXd source_density(const VectorXd& c) const { return dense(set().source_density, n()) * c; }
  VectorXd target_density(const VectorXd& c) const { return dense(set().target_density, n()) * c; }

  FmmOperators<double> operators_;
  Eigen::MatrixX3d surface_;
};

TEST_P(HarmonicOperators, DensitiesStandForChargesFarAway) {
  const Charges charges = make_charges(30, {0, 0, 0}, 1.0);
  const VectorXd q =
      source_density(source_coefficients(potential(outer_surface * surface_, charges.at, charges.strength)));
  Eigen::MatrixX3d far(3, 3);
  far << 3.2, 0.1, -0.4, 9.0, 2.0, 1.0, -3.0, -3.0, 3.0;
  const VectorXd expected = potential(far, charges.at, charges.strength);
  EXPECT_LT((potential(far, inner_surface * surface_, q) - expected).norm(), tolerance() * expected.norm());
}

TEST_P(HarmonicOperators, TransfersServeTheirMirrorImages) {
  const Charges charges = make_charges(30, {0, 0, 0}, 1.0);
  const VectorXd c = source_coefficients(potential(outer_surface * surface_, charges.at, charges.strength));
  const Charges places = make_charges(20, {0, 0, 0}, 1.0);
  for (const std::array<signed char, 3> t :
       {std::array<signed char, 3>{2, 0, 0}, {-2, 1, 0}, {3, -3, -2}, {0, -1, 2}, {-3, -3, -3}}) {
    const signed char transfer[3] = {t[0], t[1], t[2]};
    VectorXd sign(set().rank);
    for (int i = 0; i < set().rank; ++i) sign(i) = set().sign(i, reflected_axes(transfer));
    const VectorXd local = sign.cwiseProduct(apply(set().transfer[transfer_index(transfer)], sign.cwiseProduct(c)));
    // The source box stands at 2 t from the target box's centre.
    const Eigen::RowVector3d shift(2.0 * t[0], 2.0 * t[1], 2.0 * t[2]);
    Eigen::MatrixX3d shifted = charges.at.rowwise() + shift;
    const VectorXd expected = potential(places.at, shifted, charges.strength);
    const VectorXd got = potential(places.at, outer_surface * surface_, target_density(local));
    EXPECT_LT((got - expected).norm(), tolerance() * expected.norm())
        << int{t[0]} << ' ' << int{t[1]} << ' ' << int{t[2]};
  }
}

TEST_P(HarmonicOperators, DistantTransfersAreThin) {
  for (const FactoredMatrix<double>& transfer : set().transfer) {
    if (transfer.empty() || transfer.first.empty()) continue;
    EXPECT_EQ(transfer.last.n_columns, math::smaller(transfer.first.n_rows, transfer.last.n_columns));
    EXPECT_LT(2 * transfer.first.n_rows, set().rank);
  }
  const signed char corner[3] = {3, 3, 3}, touching[3] = {2, 0, 0};
  const int thin = set().transfer[transfer_index(corner)].last.n_columns;
  EXPECT_LT(3 * thin, set().rank);
  EXPECT_GT(set().transfer[transfer_index(touching)].last.n_columns, thin);
}

TEST_P(HarmonicOperators, PassBetweenChildAndParent) {
  for (const int octant : {7, 0, 5}) {
    const Eigen::RowVector3d side(octant & 1 ? 1.0 : -1.0, octant & 2 ? 1.0 : -1.0, octant & 4 ? 1.0 : -1.0);
    VectorXd sign(set().rank);
    for (int i = 0; i < set().rank; ++i) sign(i) = set().sign(i, 7 & ~octant);
    // Up: charges in the child, in the child's units; the parent's unit is twice as long.
    const Charges charges = make_charges(30, {0, 0, 0}, 1.0);
    const VectorXd child = source_coefficients(potential(outer_surface * surface_, charges.at, charges.strength));
    const VectorXd parent = sign.cwiseProduct(dense(set().to_parent, set().rank) * sign.cwiseProduct(child));
    Eigen::MatrixX3d far(2, 3);
    far << 3.5, 0.3, -0.2, -2.0, 4.0, 1.0;
    const Eigen::MatrixX3d in_parent = (charges.at.rowwise() + side) / 2.0;
    VectorXd expected = potential(far, in_parent, charges.strength);
    EXPECT_LT((potential(far, inner_surface * surface_, source_density(parent)) - expected).norm(),
              tolerance() * expected.norm());
    // Down: a distant charge seen by the parent, then by the child.
    Charges distant = make_charges(5, {7.0, -3.0, 4.0}, 1.0);
    const VectorXd local = dense(set().to_target, set().rank).leftCols(n()) *
                           potential(inner_surface * surface_, distant.at, distant.strength);
    const VectorXd below = sign.cwiseProduct(dense(set().to_child, set().rank) * sign.cwiseProduct(local));
    const Charges places = make_charges(10, {0, 0, 0}, 1.0);
    const Eigen::MatrixX3d from_child = (2.0 * distant.at).rowwise() - side;
    expected = potential(places.at, from_child, distant.strength);
    EXPECT_LT((potential(places.at, outer_surface * surface_, target_density(below)) - expected).norm(),
              tolerance() * expected.norm());
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, HarmonicOperators, ::testing::Values(4, 5, 6, 8, 10));

}  // namespace
}  // namespace skein
