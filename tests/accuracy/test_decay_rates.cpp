#include <skein/dynamics/fiber_dynamics.hpp>
#include <skein/dynamics/spectral_radius_at.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/spring_forces.hpp>

#include "tests/accuracy/dense_operators.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

// Small motions of a straight fiber in a fluid at rest: dx/dt = -M K x. With M = C C^T the rates of decay are the
// eigenvalues of C^T K C. A section looks the same from each of its nodes, so the motions fall apart into angular
// modes: displacements (along x, outwards, around) times exp(i m angle), m = 0 .. N_c/2. The numbers are those of
// tests/reference/decay_rates.py.

namespace skein {
namespace {

struct Decay {
  Eigen::VectorXd rate;     // ascending, 1 / time
  Eigen::MatrixXcd motion;  // a column for each rate
};

template <class Matrix>
auto solve(const Matrix& mobility, const Matrix& stiffness) {
  const Eigen::LLT<Matrix> factor(mobility);
  EXPECT_EQ(factor.info(), Eigen::Success) << "the mobility is not positive definite";
  const Matrix lower = factor.matrixL();
  return std::pair(Eigen::SelfAdjointEigenSolver<Matrix>(lower.adjoint() * stiffness * lower), lower);
}

Decay decay_of_mode(const FiberConfig& config, const double viscosity, const int mode) {
  const auto [solver, lower] = solve<Eigen::MatrixXcd>(dense::make_mobility_mode(config, viscosity, mode),
                                                       dense::make_stiffness_mode(config, mode));
  return {solver.eigenvalues(), lower * solver.eigenvectors()};
}

/// Share of a motion's displacement that goes along x (0), outwards (1) or around (2).
double share_of(const Eigen::VectorXcd& motion, const int component) {
  double part = 0.0;
  for (Eigen::Index i = component; i < motion.size(); i += 3) part += std::norm(motion[i]);
  return part / motion.squaredNorm();
}

/// Rates above those of rigid motions whose motion goes mostly along one component.
std::vector<double> rates_along(const Decay& decay, const int component) {
  const double rigid = 1e-7 * decay.rate.tail<1>()[0];
  std::vector<double> rates;
  for (Eigen::Index i = 0; i < decay.rate.size(); ++i)
    if (decay.rate[i] > rigid && share_of(decay.motion.col(i), component) > 0.5) rates.push_back(decay.rate[i]);
  return rates;
}

int count_rigid(const Decay& decay) {
  const double rigid = 1e-7 * decay.rate.tail<1>()[0];
  return static_cast<int>((decay.rate.array().abs() < rigid).count());
}

void expect_close(const double found, const double known) { EXPECT_NEAR(found, known, 1e-3 * known); }

class DecayRates : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    for (int mode = 0; mode <= 9; ++mode) modes_.push_back(decay_of_mode(FiberConfig{}, 1.0, mode));
  }
  static void TearDownTestSuite() { modes_.clear(); }
  static std::vector<Decay> modes_;
};
std::vector<Decay> DecayRates::modes_;

TEST_F(DecayRates, BendingIsSlowest) {
  const Decay& bending = modes_[1];
  ASSERT_EQ(count_rigid(bending), 2);  // a translation and a rotation for each sense of turning
  expect_close(bending.rate[2], 0.672931);
  expect_close(bending.rate[3], 4.30693);
  for (int mode = 0; mode <= 9; ++mode)
    for (Eigen::Index i = mode == 0 || mode == 1 ? 2 : 0; i < modes_[mode].rate.size(); ++i)
      EXPECT_GT(modes_[mode].rate[i], 0.67) << mode;
}

TEST_F(DecayRates, StretchingAndTorsion) {
  ASSERT_EQ(count_rigid(modes_[0]), 2);  // the translation along x and the rotation about it
  const auto stretching = rates_along(modes_[0], 0);
  const auto torsion = rates_along(modes_[0], 2);
  // Slow for so stiff a rod: the fluid inside cannot follow and is sheared.
  expect_close(stretching[0], 5.05267);
  expect_close(stretching[1], 15.4378);
  expect_close(stretching[2], 31.0052);
  expect_close(stretching[3], 50.6988);
  expect_close(torsion[0], 13.3861);
  expect_close(torsion[1], 51.8244);
}

TEST_F(DecayRates, SectionsWarpBeforeTheyOvalize) {
  expect_close(rates_along(modes_[1], 0)[0], 84.59);
  expect_close(modes_[2].rate[0], 84.0678);
  expect_close(rates_along(modes_[2], 1)[0], 251.708);
}

TEST_F(DecayRates, FastestMotionOfEachAngularMode) {
  const std::vector<double> known = {7400.75, 5467.89, 11057.8, 5097.51};
  for (int mode = 0; mode < 4; ++mode) expect_close(modes_[mode].rate.tail<1>()[0], known[mode]);
}

/// Displacements of the nodes in a motion of an angular mode; its largest component is 1.
std::vector<Vec3> displace_nodes(const FiberConfig& config, const int mode, const Eigen::VectorXcd& motion) {
  const double largest = motion.cwiseAbs().maxCoeff();
  std::vector<Vec3> displacement;
  for (int section = 0; section < config.sections; ++section)
    for (int a = 0; a < config.nodes_per_section; ++a) {
      const double angle = 2.0 * EIGEN_PI * a / config.nodes_per_section;
      const Eigen::Vector3cd local = std::polar(1.0 / largest, mode * angle) * motion.segment<3>(3 * section);
      const Eigen::Vector3d u = dense::section_frame(angle) * local.real();
      displacement.push_back({u.x(), u.y(), u.z()});
    }
  return displacement;
}

TEST_F(DecayRates, SimulatedFibersDecayAtTheseRates) {
  const FiberConfig config;
  const auto fibers = make_fibers({config});
  const SpringForces springs(fibers);
  DirectMobility mobility(1.0, Precision::in_double);
  const auto straight = make_surface_nodes(fibers);
  const Scalars blob = to_device("blob", make_blobs(fibers));
  const double step = 1e-5 * config.radius;

  const auto velocity_at = [&](const double amplitude, const std::vector<Vec3>& displacement) {
    std::vector<Vec3> shape = straight;
    for (std::size_t i = 0; i < shape.size(); ++i) shape[i] = shape[i] + amplitude * displacement[i];
    const Vectors position = to_device("position", shape);
    const Vectors force("force", shape.size()), velocity("velocity", shape.size());
    springs.add_forces(0.0, position, force);
    mobility.add_velocity({position, force, blob}, position, velocity);
    return to_host(velocity);
  };
  for (int mode = 0; mode < 4; ++mode) {
    for (const Eigen::Index which : {2, 3, 5, 120, 239}) {
      const double rate = modes_[mode].rate[which];
      const auto displacement = displace_nodes(config, mode, modes_[mode].motion.col(which));
      const auto ahead = velocity_at(step, displacement), behind = velocity_at(-step, displacement);
      double error = 0.0;
      for (std::size_t i = 0; i < displacement.size(); ++i)
        error = std::max(error, norm((ahead[i] - behind[i]) / (2.0 * step * rate) + displacement[i]));
      EXPECT_LT(error, 1e-5) << "mode " << mode << ", rate " << rate;
    }
  }
}

TEST_F(DecayRates, SectionsOvalizingInPhaseDecayFastest) {
  double fastest = 0.0;
  for (const Decay& mode : modes_) fastest = std::max(fastest, mode.rate.tail<1>()[0]);
  expect_close(fastest, 1.1057e4);
  EXPECT_EQ(fastest, modes_[2].rate.tail<1>()[0]);
  EXPECT_NEAR(2.0 / fastest, 1.81e-4, 5e-7);  // the longest stable step of forward Euler

  // In phase: the outward displacement has one sign all along the fiber.
  const Eigen::VectorXcd motion = modes_[2].motion.rightCols<1>();
  const std::complex<double> middle = motion[3 * 40 + 1];
  for (int section = 0; section < 80; ++section) EXPECT_GT(std::real(motion[3 * section + 1] / middle), 0.0) << section;
}

TEST(DecayRatesOfSmallFibers, AngularModesAreAllMotionsOfTheWholeFiber) {
  FiberConfig config;
  config.sections = 4;
  config.nodes_per_section = 6;
  config.blob = 0.003;
  constexpr double viscosity = 1.7;
  const auto points = dense::make_straight_tube(config);
  const auto whole =
      solve<Eigen::MatrixXd>(dense::make_mobility(points, config.blob, viscosity), dense::make_stiffness(config))
          .first.eigenvalues()
          .eval();
  std::vector<double> together;
  for (int mode = 0; mode < 6; ++mode) {
    const Decay decay = decay_of_mode(config, viscosity, mode);
    together.insert(together.end(), decay.rate.begin(), decay.rate.end());
  }
  std::sort(together.begin(), together.end());
  ASSERT_EQ(static_cast<Eigen::Index>(together.size()), whole.size());
  for (Eigen::Index i = 0; i < whole.size(); ++i) EXPECT_NEAR(together[i], whole[i], 1e-10 * whole.tail<1>()[0]);
}

TEST(DecayRatesOfSmallFibers, RatesScaleWithStiffnessOverViscosity) {
  FiberConfig config;
  config.sections = 6;
  const Decay once = decay_of_mode(config, 0.7, 2);
  config.spring_stiffness *= 5.0;
  const Decay stiffer = decay_of_mode(config, 1.4, 2);
  for (Eigen::Index i = 0; i < once.rate.size(); ++i)
    EXPECT_NEAR(stiffer.rate[i], 2.5 * once.rate[i], 1e-9 * once.rate[i]);
}

// By which Euler's stability is judged, whatever the fiber is made of.
TEST(SpectralRadius, IsTheLargestRate) {
  for (const int nodes : {3, 4, 6, 9})
    for (const double blob_ratio : {0.5, 1.0, 1.4})
      for (const double stiffness : {0.0112, 0.0409, 3.0}) {
        SceneConfig scene;
        scene.flows = {};
        scene.fluid.viscosity = 1.7;
        FiberConfig fiber;
        fiber.sections = 12;
        fiber.nodes_per_section = nodes;
        fiber.spring_stiffness = stiffness;
        fiber.blob = std::min(0.0049, blob_ratio * make_fibers({fiber})[0].spacing());
        scene.fibers = {fiber};
        double largest = 0.0;
        for (int mode = 0; mode <= nodes / 2; ++mode)
          largest = std::max(largest, decay_of_mode(fiber, scene.fluid.viscosity, mode).rate.maxCoeff());
        Physics physics = make_physics(scene);
        FiberDynamics dynamics(physics);
        const Vectors position = to_device("position", make_surface_nodes(physics.fibers));
        const auto find = [&](const PowerIterationLimits& limits) {
          return find_spectral_radius_at(physics, dynamics, 0.0, position, 1, limits);
        };
        EXPECT_NEAR(find(exact_radius), largest, 0.01 * largest) << nodes << " nodes, blob " << fiber.blob;
        EXPECT_NEAR(find(rough_radius), 0.93 * largest, 0.1 * largest) << nodes << " nodes, blob " << fiber.blob;
      }
}

}  // namespace
}  // namespace skein
