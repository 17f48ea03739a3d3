#include "tests/accuracy/dense_operators.hpp"

#include <gtest/gtest.h>

#include <cmath>

// A fiber held rigid: forces on the nodes that give them the velocity of a rigid body, or hold them in a flow. The
// numbers are those of tests/reference/rigid_tube.py.

namespace skein {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double rate = 2.5;

/// A velocity at each node.
template <class Velocity>
Eigen::VectorXd at_nodes(const dense::Points& points, const Velocity& velocity) {
  Eigen::VectorXd values(3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i) values.segment<3>(3 * i) = velocity(points[i]);
  return values;
}

/// The six rigid motions: translations along x, y, z, then rotations about them, [3 n, 6].
Eigen::MatrixXd rigid_motions(const dense::Points& points) {
  Eigen::MatrixXd motions(3 * points.size(), 6);
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d unit = Vector3d::Unit(axis);
    motions.col(axis) = at_nodes(points, [&](const Vector3d&) { return unit; });
    motions.col(3 + axis) = at_nodes(points, [&](const Vector3d& x) -> Vector3d { return unit.cross(x); });
  }
  return motions;
}

/// The rigid tube in a fluid: resistance to its motions, and what a linear flow does to it.
class RigidTube {
 public:
  explicit RigidTube(const FiberConfig& config, const double viscosity)
      : points_(dense::make_straight_tube(config)),
        motions_(rigid_motions(points_)),
        mobility_(dense::make_mobility(points_, config.blob, viscosity)),
        factor_(mobility_) {
    EXPECT_EQ(factor_.info(), Eigen::Success) << "the mobility is not positive definite";
    resistance_ = motions_.transpose() * factor_.solve(motions_);
  }

  /// [6, 6]: force and torque about the middle per velocity and angular velocity.
  const Eigen::MatrixXd& resistance() const { return resistance_; }

  /// Angular velocity of the tube along x when it floats free of force and torque in u = gradient x.
  Vector3d angular_velocity(const Matrix3d& gradient) const {
    const Eigen::VectorXd flow = at_nodes(points_, [&](const Vector3d& x) -> Vector3d { return gradient * x; });
    const Eigen::VectorXd load = motions_.transpose() * factor_.solve(flow);
    return resistance_.ldlt().solve(load).tail<3>();
  }

 private:
  dense::Points points_;
  Eigen::MatrixXd motions_;
  Eigen::MatrixXd mobility_;
  Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factor_;  // in place of mobility_: 150 MB for the whole tube
  Eigen::MatrixXd resistance_;
};

/// u = (rate y, 0, 0) in the frame of a tube that stands at this angle from x in the x-y plane.
Matrix3d shear_seen_from(const double angle) {
  Matrix3d shear = Matrix3d::Zero();
  shear(0, 1) = rate;
  const Matrix3d turn = Eigen::AngleAxisd(angle, Vector3d::UnitZ()).toRotationMatrix();
  return turn.transpose() * shear * turn;
}

double turning_rate(const RigidTube& tube, const double angle) {
  return tube.angular_velocity(shear_seen_from(angle)).z();
}

/// Jeffery: the rates of turning across and along the flow are as r_e^2 to 1.
double effective_aspect_ratio(const RigidTube& tube) {
  return std::sqrt(turning_rate(tube, 0.5 * EIGEN_PI) / turning_rate(tube, 0.0));
}

class RigidTubeOfThePaper : public ::testing::Test {
 protected:
  static void SetUpTestSuite() { tube_ = new RigidTube(FiberConfig{}, 1.0); }
  static void TearDownTestSuite() { delete tube_; }
  static void expect_close(const double found, const double known) { EXPECT_NEAR(found, known, 1e-5 * known); }
  static RigidTube* tube_;
};
RigidTube* RigidTubeOfThePaper::tube_ = nullptr;

TEST_F(RigidTubeOfThePaper, ResistsMotion) {
  const Eigen::MatrixXd& resistance = tube_->resistance();
  expect_close(resistance(0, 0), 0.378051);
  expect_close(resistance(1, 1), 0.535584);
  expect_close(resistance(2, 2), 0.535584);
  expect_close(resistance(5, 5), 1.50017e-3);
  expect_close(resistance(4, 4), 1.50017e-3);
}

TEST_F(RigidTubeOfThePaper, MotionsDoNotCouple) {
  const Eigen::MatrixXd resistance = tube_->resistance();
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      if (i == j) continue;
      const double size = std::sqrt(resistance(i, i) * resistance(j, j));
      EXPECT_NEAR(resistance(i, j) / size, 0.0, 1e-10) << i << ' ' << j;
    }
}

TEST_F(RigidTubeOfThePaper, TurnsAsAnEllipsoidInShear) {
  const double aspect_ratio = effective_aspect_ratio(*tube_);
  expect_close(aspect_ratio, 8.7345);
  expect_close(EIGEN_PI * (aspect_ratio + 1.0 / aspect_ratio) / rate, 11.120);

  // In between as Jeffery's orbit says, though the tube is no ellipsoid: -rate (r^2 sin^2 + cos^2)/(r^2 + 1).
  const double square = aspect_ratio * aspect_ratio;
  for (const double angle : {0.3, 1.1, 2.0}) {
    const double sine = std::sin(angle), cosine = std::cos(angle);
    const double jeffery = -rate * (square * sine * sine + cosine * cosine) / (square + 1.0);
    EXPECT_NEAR(turning_rate(*tube_, angle), jeffery, 1e-9) << angle;
  }
}

TEST(RigidTube, ResistanceIsProportionalToViscosity) {
  FiberConfig config;
  config.sections = 12;
  config.nodes_per_section = 7;
  const Eigen::MatrixXd once = RigidTube(config, 0.7).resistance();
  EXPECT_LT((RigidTube(config, 2.1).resistance() - 3.0 * once).norm(), 1e-10 * once.norm());
}

}  // namespace
}  // namespace skein
