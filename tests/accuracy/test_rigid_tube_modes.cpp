// Resistances by angular modes against those by all nodes at once, solved without any symmetry.
#include <skein/core/error.hpp>
#include <skein/physics/rigid_tube.hpp>

#include "tests/accuracy/dense_operators.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace skein {
namespace {

using Eigen::Vector3d;

Eigen::VectorXd at_nodes(const dense::Points& points, const std::function<Vector3d(const Vector3d&)>& velocity) {
  Eigen::VectorXd values(3 * points.size());
  for (std::size_t i = 0; i < points.size(); ++i) values.segment<3>(3 * i) = velocity(points[i]);
  return values;
}

TEST(RigidTubeDrag, OfAllNodesAtOnceIsThatOfTheModes) {
  for (const int n_nodes : {3, 4, 5, 8}) {
    FiberConfig config;
    config.sections = 11;
    config.nodes_per_section = n_nodes;
    config.radius = 0.4;
    config.blob = 0.2;
    if (n_nodes == 5) config.spacing = 0.7;
    const double viscosity = 1.7;
    const RigidTubeDrag drag = measure_rigid_tube(make_fibers({config})[0], viscosity);

    const dense::Points points = dense::make_straight_tube(config);  // along x
    const Eigen::LLT<Eigen::MatrixXd> mobility(dense::make_mobility(points, config.blob, viscosity));
    const auto product = [&](const std::function<Vector3d(const Vector3d&)>& a,
                             const std::function<Vector3d(const Vector3d&)>& b) {
      return at_nodes(points, a).dot(mobility.solve(at_nodes(points, b)));
    };
    const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
    const auto turn = [&](const Vector3d& p) -> Vector3d { return z.cross(p); };
    const auto slide = [&](const Vector3d&) { return x; };
    const auto shift = [&](const Vector3d&) { return y; };
    const auto spin = [&](const Vector3d& p) -> Vector3d { return x.cross(p); };
    const auto across = [&](const Vector3d& p) -> Vector3d { return p.x() * y; };
    const auto along = [&](const Vector3d& p) -> Vector3d { return -p.y() * x; };
    const auto expect_same = [](const double found, const double known) {
      EXPECT_NEAR(found, known, 1e-11 * std::abs(known));
    };
    expect_same(drag.axial, product(slide, slide));
    expect_same(drag.transverse, product(shift, shift));
    expect_same(drag.spinning, product(spin, spin));
    expect_same(drag.turning, product(turn, turn));
    expect_same(drag.torque_across, product(turn, across));
    expect_same(drag.torque_along, product(turn, along));
    expect_same(drag.turning, drag.torque_across + drag.torque_along);

    // By parts: forces F across at x turn like couples of minus the sum of those before.
    const Eigen::VectorXd forces = mobility.solve(at_nodes(points, along));
    const int middle = config.sections / 2;
    double couple = 0.0, across_before = 0.0;
    for (int s = 0; s <= middle; ++s)
      for (int i = s * n_nodes; i < (s + 1) * n_nodes; ++i) {
        across_before += (s < middle ? 1.0 : 0.5) * forces[3 * i + 1];
        if (s == middle) couple -= points[i].y() * forces[3 * i];
      }
    expect_same(drag.couple_within, couple / make_fibers({config})[0].spacing() - across_before);
  }
}

// The values of tests/reference/rigid_tube.py.
TEST(RigidTubeDrag, OfThePapersTube) {
  const RigidTubeDrag drag = measure_rigid_tube(make_fibers({FiberConfig{}})[0], 1.0);
  EXPECT_NEAR(drag.axial, 0.378051, 4e-6);
  EXPECT_NEAR(drag.transverse, 0.535584, 5e-6);
  EXPECT_NEAR(drag.turning, 1.50017e-3, 1.5e-8);
  EXPECT_NEAR(drag.effective_aspect_ratio(), 8.7345, 9e-5);
}

// A long tube of radius R drags like a slender body: Batchelor's expansion in 1 / ln(2 l / R), J. Fluid Mech. 44, 419
// (1970), for a cylinder of half length l.
TEST(RigidTubeDrag, OfALongTubeIsThatOfASlenderBody) {
  FiberConfig config;
  config.sections = 600;
  config.nodes_per_section = 6;
  config.radius = 0.005;
  config.blob = 0.00285;
  const Fiber fiber = make_fibers({config})[0];
  const RigidTubeDrag drag = measure_rigid_tube(fiber, 1.0);
  const double length = fiber.length(), e = 1.0 / std::log(length / config.radius), pi = EIGEN_PI;
  const double axial = 2 * pi * length * e / (1 - e * (1.5 - std::log(2.0))),
               transverse = 4 * pi * length * e / (1 - e * (0.5 - std::log(2.0)));
  EXPECT_NEAR(drag.axial / axial, 1.0, 0.05);
  EXPECT_NEAR(drag.transverse / transverse, 1.0, 0.05);
}

TEST(RigidTubeDrag, GoesWithViscosityAndLength) {
  FiberConfig config;
  config.sections = 12;
  config.nodes_per_section = 7;
  FiberConfig larger = config;
  larger.radius *= 3.0;
  larger.blob *= 3.0;
  const RigidTubeDrag one = measure_rigid_tube(make_fibers({config})[0], 0.7),
                      other = measure_rigid_tube(make_fibers({larger})[0], 2.1);
  EXPECT_NEAR(other.axial, 9.0 * one.axial, 1e-11 * other.axial);
  EXPECT_NEAR(other.torque_along, 81.0 * one.torque_along, 1e-10 * other.torque_along);
}

TEST(RigidTubeDrag, IsRefusedWhereRoundingDecides) {
  FiberConfig config;
  config.blob = 0.05;
  EXPECT_THROW(measure_rigid_tube(make_fibers({config})[0], 1.0), Error);
}

}  // namespace
}  // namespace skein
