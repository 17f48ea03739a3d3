#include <skein/analysis/centreline.hpp>
#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/physics/background_flow.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/spring_forces.hpp>
#include <skein/solvers/rkc2.hpp>

#include "tests/accuracy/dense_operators.hpp"
#include "tests/support/direct_physics.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>

// A fiber along x in planar extension u = e (-x, y, 0): compressed, it buckles into a C, an S, ... above critical
// rates.
//
// Small motions about the fiber under load: d v/dt = G v - M K v + (dM v) f, with the flow's gradient G, the stiffness
// K of springs under load, and f their forces. The fiber under load is a surface of revolution but for the small part
// of the flow that makes its sections oval, which is left out; so motions fall apart into angular modes, of which m = 1
// bends. Written from the formulas alone: no kernel of the library is used for the operator.
//
// The first order in e puts the load on the fiber of full length; the fiber is shortened by it, by 2 to 3 % at 2 e = 2,
// and buckles later. Both are computed. The numbers are those of tests/reference/buckling.py.

namespace skein {
namespace {

using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double viscosity = 1.0;

/// The fiber under load: sections at x along the axis, with their radii. What the springs feel beyond that shape, to
/// first order, are the shifts.
struct Tube {
  FiberConfig config;
  VectorXd along, radius;              // [N_f]
  VectorXd along_shift, radius_shift;  // [N_f]

  Vector3d node(const int section, const int a) const {
    const double angle = 2.0 * EIGEN_PI * a / config.nodes_per_section;
    return {along[section], radius[section] * std::cos(angle), radius[section] * std::sin(angle)};
  }
  Vector3d shift(const int section, const int a) const {
    const double angle = 2.0 * EIGEN_PI * a / config.nodes_per_section;
    return {along_shift[section], radius_shift[section] * std::cos(angle), radius_shift[section] * std::sin(angle)};
  }
};

Tube make_straight(const FiberConfig& config) {
  const double spacing = 2.0 * config.radius * std::sin(EIGEN_PI / config.nodes_per_section);
  const VectorXd zero = VectorXd::Zero(config.sections);
  Tube tube{config, zero, VectorXd::Constant(config.sections, config.radius), zero, zero};
  for (int s = 0; s < config.sections; ++s) tube.along[s] = (s - 0.5 * (config.sections - 1)) * spacing;
  return tube;
}

/// Rest length of the spring from node 0 of a section to node b, `apart` sections away.
double rest_length(const FiberConfig& config, const int apart, const int b) {
  const double chord = 2.0 * config.radius * std::sin(EIGEN_PI * b / config.nodes_per_section);
  const double spacing = 2.0 * config.radius * std::sin(EIGEN_PI / config.nodes_per_section);
  return std::hypot(apart * spacing, chord);
}

bool is_spring(const int s, const int t, const int b) { return std::abs(s - t) <= 1 && !(s == t && b == 0); }

/// Of the spring from node 0 of section s to node b of section t.
double tension(const Tube& tube, const int s, const int t, const int b) {
  const Vector3d d = tube.node(s, 0) - tube.node(t, b);
  const double l = rest_length(tube.config, std::abs(s - t), b);
  const double stretch = d.norm() - l + d.normalized().dot(tube.shift(s, 0) - tube.shift(t, b));
  return tube.config.spring_stiffness * stretch / l;
}

/// Force of its springs on node 0 of a section.
Vector3d force_on(const Tube& tube, const int s) {
  Vector3d force = Vector3d::Zero();
  for (int t = std::max(0, s - 1); t <= std::min(tube.config.sections - 1, s + 1); ++t)
    for (int b = 0; b < tube.config.nodes_per_section; ++b) {
      if (!is_spring(s, t, b)) continue;
      force -= tension(tube, s, t, b) * (tube.node(s, 0) - tube.node(t, b)).normalized();
    }
  return force;
}

/// Minus the derivative of the force on node 0 of section s by the position of node b of section t, for one spring.
Matrix3d loaded_spring(const Tube& tube, const int s, const int t, const int b) {
  const Vector3d d = tube.node(s, 0) - tube.node(t, b);
  const double r = d.norm(), l = rest_length(tube.config, std::abs(s - t), b);
  const Matrix3d along = d * d.transpose() / (r * r);
  return tube.config.spring_stiffness / l * along + tension(tube, s, t, b) / r * (Matrix3d::Identity() - along);
}

Matrix3d stiffness_block(const Tube& tube, const int s, const int t, const int b) {
  if (is_spring(s, t, b)) return -loaded_spring(tube, s, t, b);
  if (s != t || b != 0) return Matrix3d::Zero();
  Matrix3d sum = Matrix3d::Zero();
  for (int u = std::max(0, s - 1); u <= std::min(tube.config.sections - 1, s + 1); ++u)
    for (int c = 0; c < tube.config.nodes_per_section; ++c)
      if (is_spring(s, u, c)) sum += loaded_spring(tube, s, u, c);
  return sum;
}

/// Derivative of M(d) f by d.
Matrix3d mobility_change(const Vector3d& d, const Vector3d& f, const double blob) {
  const double r2 = d.squaredNorm(), e2 = blob * blob, a2 = r2 + e2, a3 = std::pow(a2, 1.5);
  const double df = d.dot(f);
  const Matrix3d change = f * (2.0 * d / a3 - 3.0 * (r2 + 2.0 * e2) / (a3 * a2) * d).transpose() +
                          (df * Matrix3d::Identity() + d * f.transpose()) / a3 -
                          3.0 * df / (a3 * a2) * d * d.transpose();
  return change / (8.0 * EIGEN_PI * viscosity);
}

/// The operators of one angular mode, in the real basis of displacements (a cos, b cos, c sin)(m angle).
class ModeOperators {
 public:
  explicit ModeOperators(const Tube& tube) : tube_(tube) {
    const int n = tube.config.nodes_per_section;
    std::vector<Vector3d> force;
    for (int s = 0; s < tube.config.sections; ++s) force.push_back(force_on(tube, s));
    for (int s = 0; s < tube.config.sections; ++s) {
      Matrix3d sum = Matrix3d::Zero();
      for (int t = 0; t < tube.config.sections; ++t)
        for (int b = 0; b < n; ++b) {
          const Vector3d f = dense::section_frame(2.0 * EIGEN_PI * b / n) * force[t];
          const Matrix3d change = mobility_change(tube.node(s, 0) - tube.node(t, b), f, tube.config.blob);
          changes_.push_back(change);
          sum += change;
        }
      sums_.push_back(sum);
    }
  }

  MatrixXd mobility(const int mode) const {
    return real_mode(mode, [this](const int s, const int t, const int b) {
      return dense::mobility_block(tube_.node(s, 0) - tube_.node(t, b), tube_.config.blob, viscosity);
    });
  }
  MatrixXd stiffness(const int mode) const {
    return real_mode(mode, [this](const int s, const int t, const int b) { return stiffness_block(tube_, s, t, b); });
  }
  /// What displacements change of M f with the forces held.
  MatrixXd mobility_changes(const int mode) const {
    return real_mode(mode, [this](const int s, const int t, const int b) -> Matrix3d {
      const int n = tube_.config.nodes_per_section;
      const Matrix3d moved = -changes_[static_cast<std::size_t>((s * tube_.config.sections + t) * n + b)];
      return s == t && b == 0 ? Matrix3d(moved + sums_[static_cast<std::size_t>(s)]) : moved;
    });
  }

 private:
  template <class RowBlock>
  MatrixXd real_mode(const int mode, const RowBlock& row_block) const {
    const Eigen::MatrixXcd complex = dense::make_angular_mode(tube_.config, mode, row_block);
    // Displacements around the section are -i c exp(i m angle): their real part is c sin(m angle).
    Eigen::VectorXcd phase(complex.rows());
    for (Eigen::Index i = 0; i < phase.size(); ++i) phase[i] = i % 3 == 2 ? std::complex<double>(0.0, -1.0) : 1.0;
    const Eigen::MatrixXcd turned = phase.conjugate().asDiagonal() * complex * phase.asDiagonal();
    EXPECT_LT(turned.imag().cwiseAbs().maxCoeff(), 1e-10 * turned.real().cwiseAbs().maxCoeff() + 1e-9);
    return turned.real();
  }

  const Tube& tube_;
  std::vector<Matrix3d> changes_, sums_;
};

/// The flow's gradient on motions along x (0), outwards (1), around (2) of the angular mode 0 or 1.
Matrix3d flow_gradient(const int mode, const double rate) {
  Matrix3d g = Matrix3d::Zero();
  g(0, 0) = -rate;
  if (mode == 0) {
    g(1, 1) = 0.5 * rate;  // e y on a circle, its mean part
  } else {
    g.block<2, 2>(1, 1) << 0.75 * rate, -0.25 * rate, -0.25 * rate, 0.75 * rate;
  }
  return g;
}

MatrixXd flow_operator(const int mode, const double rate, const int sections) {
  MatrixXd g = MatrixXd::Zero(3 * sections, 3 * sections);
  for (int s = 0; s < sections; ++s) g.block<3, 3>(3 * s, 3 * s) = flow_gradient(mode, rate);
  return g;
}

enum class Load { on_full_length, on_compressed };

/// The change of sections (x, radius, 0) that would bring a fiber under load to rest, to first order; of the rate, too,
/// where the load is on the full length.
VectorXd find_newton_step(const Tube& tube, const double rate, const Load load) {
  const int n = tube.config.sections;
  const ModeOperators operators(tube);
  VectorXd shape(3 * n), force(3 * n);
  for (int s = 0; s < n; ++s) {
    shape.segment<3>(3 * s) << tube.along[s], tube.radius[s], 0.0;
    force.segment<3>(3 * s) = force_on(tube, s);
  }
  const MatrixXd g = flow_operator(0, rate, n), m = operators.mobility(0);
  MatrixXd slope = -m * operators.stiffness(0);
  if (load == Load::on_compressed) slope += g + operators.mobility_changes(0);
  // Turning about the axis changes nothing: least squares.
  return slope.completeOrthogonalDecomposition().solve(-(g * shape + m * force));
}

Tube put_under_load(const FiberConfig& config, const double rate, const Load load) {
  Tube tube = make_straight(config);
  for (int iteration = 0; iteration < 6; ++iteration) {
    const VectorXd step = find_newton_step(tube, rate, load);
    const bool first_order = load == Load::on_full_length;
    for (int s = 0; s < config.sections; ++s) {
      (first_order ? tube.along_shift : tube.along)[s] += step[3 * s];
      (first_order ? tube.radius_shift : tube.radius)[s] += step[3 * s + 1];
    }
    if (first_order || step.cwiseAbs().maxCoeff() < 1e-9 * config.radius) return tube;
  }
  ADD_FAILURE() << "no steady compressed fiber found";
  return tube;
}

enum class Parity { even, odd };

/// Columns span the bends whose deflection is even or odd along the fiber.
MatrixXd make_parity_basis(const int sections, const Parity parity) {
  MatrixXd basis = MatrixXd::Zero(3 * sections, 3 * (sections / 2));
  const double sign = parity == Parity::even ? 1.0 : -1.0;
  for (int s = 0; s < sections / 2; ++s)
    for (int c = 0; c < 3; ++c) {
      basis(3 * s + c, 3 * s + c) = std::sqrt(0.5);
      basis(3 * (sections - 1 - s) + c, 3 * s + c) = std::sqrt(0.5) * (c == 0 ? -sign : sign);
    }
  return basis;
}

/// Growth rates of bends, the fastest first. 1 / time
std::vector<double> find_growth_rates(const double rate, const Parity parity, const Load load) {
  const FiberConfig config;
  const Tube tube = put_under_load(config, rate, load);
  const ModeOperators operators(tube);
  const MatrixXd motion = flow_operator(1, rate, config.sections) - operators.mobility(1) * operators.stiffness(1) +
                          operators.mobility_changes(1);
  const MatrixXd basis = make_parity_basis(config.sections, parity);
  const MatrixXd reduced = basis.transpose() * motion * basis;
  EXPECT_LT((motion * basis - basis * reduced).norm(), 1e-8 * motion.norm()) << "the parities mix";
  std::vector<double> rates;
  const Eigen::VectorXcd values = Eigen::EigenSolver<MatrixXd>(reduced, false).eigenvalues();
  for (const std::complex<double> value : values) rates.push_back(value.real());
  std::sort(rates.rbegin(), rates.rend());
  return rates;
}

/// 2 e at which the second growth rate of a parity passes zero; the first belongs to a rigid motion that always grows.
double find_critical_rate(const Parity parity, const Load load, double low, double high) {
  const auto growth = [&](const double rate) { return find_growth_rates(0.5 * rate, parity, load)[1]; };
  double at_low = growth(low), at_high = growth(high);
  EXPECT_LT(at_low, 0.0);
  EXPECT_GT(at_high, 0.0);
  const double middle = low - at_low * (high - low) / (at_high - at_low);  // nearly a straight line
  const double at_middle = growth(middle);
  (at_middle < 0.0 ? low : high) = middle;
  (at_middle < 0.0 ? at_low : at_high) = at_middle;
  return low - at_low * (high - low) / (at_high - at_low);
}

TEST(Buckling, GrowthRatesToFirstOrderInTheRate) {
  const auto even = find_growth_rates(1.25, Parity::even, Load::on_full_length);
  EXPECT_NEAR(even[0], 3.30, 0.02 * 3.30);   // C
  EXPECT_NEAR(even[1], 1.25, 0.001 * 1.25);  // the whole fiber drifts away from the axis as the fluid does
  const auto odd = find_growth_rates(1.25, Parity::odd, Load::on_full_length);
  EXPECT_NEAR(odd[0], 2.41, 0.02 * 2.41);  // the whole fiber turns, slower than a line of the fluid
  EXPECT_NEAR(odd[1], 1.69, 0.02 * 1.69);  // S
}

TEST(Buckling, CriticalRatesToFirstOrderInTheRate) {
  EXPECT_NEAR(find_critical_rate(Parity::even, Load::on_full_length, 0.4, 0.45), 0.4248, 0.03 * 0.4248);
  EXPECT_NEAR(find_critical_rate(Parity::odd, Load::on_full_length, 1.7, 1.9), 1.813, 0.03 * 1.813);
}

TEST(Buckling, ACompressedFiberIsShorterAndBucklesLater) {
  EXPECT_NEAR(find_critical_rate(Parity::even, Load::on_compressed, 0.4, 0.45), 0.42905, 0.001 * 0.42905);
  EXPECT_NEAR(find_critical_rate(Parity::odd, Load::on_compressed, 1.8, 2.0), 1.8990, 0.001 * 1.8990);
}

TEST(Buckling, ASimulatedFiberBucklesAtTheGrowthRateOfACompressedOne) {
  FiberConfig config;
  config.start_amplitude = 2e-4;
  config.start_plane = 0.0;
  SceneConfig scene;
  scene.fluid.viscosity = viscosity;
  scene.flows = {{.kind = FlowKind::planar_extension, .rate = 1.25}};
  scene.fibers = {config};
  Physics physics = test::make_direct_physics(scene);
  const auto& fibers = physics.fibers;
  FiberDynamics dynamics(physics);
  State state{0.0, 0, to_device("position", make_surface_nodes(fibers))};
  Rkc2Options options;
  options.tolerance = 1e-4;
  options.length_scale = fibers[0].length();
  options.time_scale = 1.0 / 1.25;
  options.max_step = 0.03;
  options.displacement = 1e-5 * fibers[0].spacing();
  Rkc2 integrator(dynamics, options, fibers[0].n_nodes());

  const auto deflection = [&] {
    const auto line = physics.sections.compute_centreline(state.position);
    return line[40].y + line[39].y - line.front().y - line.back().y;  // not of the drift
  };
  const auto go_to = [&](const double time) {
    while (state.time < time) integrator.advance(state, time);
    return deflection();
  };
  const double early = go_to(0.8), late = go_to(1.2);
  EXPECT_LT(std::abs(late), 0.1 * fibers[0].length());  // still small
  const double growth = find_growth_rates(1.25, Parity::even, Load::on_compressed)[0];
  EXPECT_NEAR(std::log(late / early) / 0.4, growth, 0.01 * growth);
}

}  // namespace
}  // namespace skein
