#include "tail_algebra.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skein {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// P_0 .. P_degree of Legendre at x.
VectorXd legendre(const int degree, const double x) {
  VectorXd value(degree + 1);
  value(0) = 1.0;
  if (degree > 0) value(1) = x;
  for (int n = 1; n < degree; ++n) value(n + 1) = ((2 * n + 1) * x * value(n) - n * value(n - 1)) / (n + 1);
  return value;
}

struct GaussRule {
  VectorXd point, weight;

  /// Roots of P_n by Newton's method.
  explicit GaussRule(const int n) : point(n), weight(n) {
    for (int i = 0; i < n; ++i) {
      double x = std::cos(std::numbers::pi * (i + 0.75) / (n + 0.5)), slope = 1.0;
      for (int step = 0; step < 20; ++step) {
        const VectorXd p = legendre(n, x);
        slope = n * (x * p(n) - p(n - 1)) / (x * x - 1.0);
        x -= p(n) / slope;
      }
      point(i) = x;
      weight(i) = 2.0 / ((1.0 - x * x) * slope * slope);
    }
  }
};

int n_polynomials_of(const int degree) { return (degree + 1) * (degree + 2) * (degree + 3) / 6; }

/// In the order of add_tail_velocity.
Eigen::MatrixX3i list_powers(const int degree) {
  Eigen::MatrixX3i powers(n_polynomials_of(degree), 3);
  Index row = 0;
  for (int i = 0; i <= degree; ++i)
    for (int j = 0; i + j <= degree; ++j)
      for (int k = 0; i + j + k <= degree; ++k) powers.row(row++) << i, j, k;
  return powers;
}

VectorXd find_norms(const Eigen::MatrixX3i& powers) {
  VectorXd norm(powers.rows());
  for (Index a = 0; a < powers.rows(); ++a)
    norm(a) = std::sqrt((2 * powers(a, 0) + 1) * (2 * powers(a, 1) + 1) * (2 * powers(a, 2) + 1) / 8.0);
  return norm;
}

/// The product rule of a Gauss rule, and orthonormal polynomials there, times its weights.
struct BoxRule {
  Eigen::MatrixX3d points;
  MatrixXd weighted;  ///< [n_polynomials, n_points]

  BoxRule(const int n_axis, const Eigen::MatrixX3i& powers)
      : points(n_axis * n_axis * n_axis, 3), weighted(powers.rows(), n_axis * n_axis * n_axis) {
    const GaussRule rule(n_axis);
    const VectorXd norm = find_norms(powers);
    const int degree = powers.maxCoeff();
    for (Index q = 0; q < points.rows(); ++q) {
      const Index at[3] = {q % n_axis, q / n_axis % n_axis, q / (n_axis * n_axis)};
      VectorXd value[3];
      double weight = 1.0;
      for (int c = 0; c < 3; ++c) {
        points(q, c) = rule.point(at[c]);
        weight *= rule.weight(at[c]);
        value[c] = legendre(degree, points(q, c));
      }
      for (Index a = 0; a < powers.rows(); ++a)
        weighted(a, q) = weight * norm(a) * value[0](powers(a, 0)) * value[1](powers(a, 1)) * value[2](powers(a, 2));
    }
  }
};

constexpr int nearest[3] = {2, 0, 0};

}  // namespace

TailAlgebra::TailAlgebra(const int degree)
    : degree_(degree),
      n_polynomials_(n_polynomials_of(degree)),
      powers_(list_powers(degree)),
      norm_(find_norms(powers_)) {
  const BoxRule rule(degree + 1, powers_);
  points_ = rule.points;
  at_points_ = rule.weighted;
}

int TailAlgebra::parity(const int row) const {
  int parity = 1 << row / n_polynomials_;
  for (int c = 0; c < 3; ++c) parity ^= (powers_(row % n_polynomials_, c) & 1) << c;
  return parity;
}

MatrixXd TailAlgebra::to_points() const {
  const Index n = n_polynomials_, n_points = points_.rows();
  MatrixXd result = MatrixXd::Zero(3 * n_points, 3 * n);
  for (int c = 0; c < 3; ++c)
    result.block(c * n_points, c * n, n_points, n) = at_points_.transpose() * norm_.asDiagonal();
  return result;
}

MatrixXd TailAlgebra::project(const int (&place)[3], const int degree) const {
  const Eigen::MatrixX3i powers = list_powers(degree);
  const BoxRule rule(degree + 1, powers);
  const Index n = powers.rows(), n_points = rule.points.rows();
  MatrixXd isotropic(n_points, n_points), along(n_points, n_points), kernel(n_points, n_points);
  const auto difference = [&](const Index to, const Index from, const int c) {
    return rule.points(to, c) - rule.points(from, c) - 2.0 * place[c];
  };
  for (Index from = 0; from < n_points; ++from)
    for (Index to = 0; to < n_points; ++to) {
      double r_squared = 0.0;
      for (int c = 0; c < 3; ++c) r_squared += difference(to, from, c) * difference(to, from, c);
      const double fifth = 1.0 / (r_squared * r_squared * std::sqrt(r_squared));
      isotropic(to, from) = -1.125 * fifth;
      along(to, from) = 1.875 * fifth / r_squared;
    }
  MatrixXd result(3 * n, 3 * n);
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b) {
      for (Index from = 0; from < n_points; ++from)
        for (Index to = 0; to < n_points; ++to)
          kernel(to, from) = along(to, from) * difference(to, from, a) * difference(to, from, b) +
                             (a == b ? isotropic(to, from) : 0.0);
      result.block(a * n, b * n, n, n) = rule.weighted * (kernel * rule.weighted.transpose());
      if (a != b) result.block(b * n, a * n, n, n) = result.block(a * n, b * n, n, n);
    }
  return result;
}

ThinMatrices TailAlgebra::make_transfer(const int index, const double tolerance) const {
  const int place[3] = {index & 3, index >> 2 & 3, index >> 4};
  // Boxes two cells apart or more see less of each other: there a lower degree does.
  const int degree = std::max({place[0], place[1], place[2]}) > 2 ? std::max(1, degree_ - 2) : degree_;
  const MatrixXd low = project(place, degree);
  const double allowed = tolerance * project(nearest, 2).norm();
  const MatrixXd range = leading_range(low, std::min(0.3, allowed / low.norm()));
  const MatrixXd first = range.transpose() * low;
  // From orthonormal polynomials of this degree to those of Legendre of all degrees.
  const Eigen::MatrixX3i powers = list_powers(degree);
  const Index n = powers.rows();
  ThinMatrices result{MatrixXd::Zero(rank(), range.cols()), MatrixXd::Zero(range.cols(), rank())};
  for (Index at = 0, k = 0; at < n_polynomials_; ++at) {
    if (powers_.row(at).sum() > degree) continue;
    for (int c = 0; c < 3; ++c) {
      result.last.row(c * n_polynomials_ + at) = norm_(at) * range.row(c * n + k);
      result.first.col(c * n_polynomials_ + at) = norm_(at) * first.col(c * n + k);
    }
    ++k;
  }
  return result;
}

MatrixXd TailAlgebra::make_pass_up() const {
  // P_b((y + 1) / 2) = sum of along(b, a) P_a(y)
  const GaussRule rule(degree_ + 1);
  MatrixXd along = MatrixXd::Zero(degree_ + 1, degree_ + 1);
  for (Index q = 0; q < rule.point.size(); ++q) {
    const VectorXd parent = legendre(degree_, 0.5 * (rule.point(q) + 1.0)), child = legendre(degree_, rule.point(q));
    for (int a = 0; a <= degree_; ++a) along.col(a) += 0.5 * (2 * a + 1) * rule.weight(q) * child(a) * parent;
  }
  const Index n = n_polynomials_;
  MatrixXd result = MatrixXd::Zero(3 * n, 3 * n);
  for (Index b = 0; b < n; ++b)
    for (Index a = 0; a < n; ++a) {
      double entry = 1.0 / 16.0;  // (eps / half-width)^4
      for (int c = 0; c < 3; ++c) entry *= powers_(a, c) <= powers_(b, c) ? along(powers_(b, c), powers_(a, c)) : 0.0;
      for (int c = 0; c < 3; ++c) result(c * n + b, c * n + a) = entry;
    }
  return result;
}

}  // namespace skein
