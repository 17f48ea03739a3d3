#include <skein/core/error.hpp>
#include <skein/physics/rigid_tube.hpp>

#include "kernels/regularized_stokeslet.hpp"

#include <Eigen/Dense>
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>

namespace skein {
namespace {

/// Shares of the fields that make up one angular mode: outwards, along growing angle, along the tube.
using Cylindrical = std::array<double, 3>;
using Block = std::array<Cylindrical, 3>;

Vec3 stokeslet(const Vec3 d, const double blob_squared, const Vec3 f) {
  const auto weight = regularized_stokeslet::weights(d.x, d.y, d.z, blob_squared);
  Vec3 u;
  regularized_stokeslet::add(weight, d.x, d.y, d.z, f.x, f.y, f.z, u.x, u.y, u.z);
  return u;
}

/// How many nodes a field of a mode counts for: the sum of its squares over a section.
double square_of(const FiberConfig& config, const int mode) {
  return mode == 0 ? config.nodes_per_section : 0.5 * config.nodes_per_section;
}

/// <field a, velocities at the nodes of one section due to forces of field b on another>, the sections `along` apart.
/// The fields of mode 0 are the same for all nodes of a section; those of mode 1 go with the cosine of their angle, the
/// one along growing angle with its sine. All targets see alike, so that the one at angle 0 tells.
Block make_block(const FiberConfig& config, const int mode, const double along, const double scale) {
  const int n = config.nodes_per_section;
  constexpr int around = 1;  // the field with the sine
  Block block{};
  for (int source = 0; source < n; ++source) {
    const double angle = 2.0 * std::numbers::pi * source / n, c = std::cos(angle), s = std::sin(angle);
    const Vec3 d{config.radius * (1.0 - c), -config.radius * s, along};
    const Vec3 force[3] = {{c, s, 0.0}, {-s, c, 0.0}, {0.0, 0.0, 1.0}};
    for (int b = 0; b < 3; ++b) {
      const Vec3 u = stokeslet(d, config.blob * config.blob, force[b]);
      const double part[3] = {u.x, u.y, u.z};
      for (int a = 0; a < 3; ++a) {
        const double phase = mode == 0 ? 1.0 : (a == around) == (b == around) ? c : b == around ? s : -s;
        block[a][b] += scale * square_of(config, mode) * phase * part[a];
      }
    }
  }
  return block;
}

/// The mobility of one mode, [3 N_f, 3 N_f], symmetric: the same block for sections as far apart.
Eigen::MatrixXd make_mobility(const Fiber& fiber, const int mode, const double viscosity) {
  const int n = fiber.config.sections;
  Eigen::MatrixXd mobility(3 * n, 3 * n);
  for (int distance = 0; distance < n; ++distance) {
    const Block block =
        make_block(fiber.config, mode, distance * fiber.spacing(), regularized_stokeslet::scale(viscosity));
    for (int s = distance; s < n; ++s)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
          mobility(3 * s + a, 3 * (s - distance) + b) = block[a][b];
          mobility(3 * (s - distance) + b, 3 * s + a) = block[a][b];
        }
  }
  return mobility;
}

/// Velocities of all sections in one mode, times the squares of the basis summed over a section's nodes, as
/// `mobility` gives them: [3 N_f]. @param at  place along the tube -> shares of the three fields
template <class Field>
Eigen::VectorXd project(const Fiber& fiber, const int mode, const Field& at) {
  const int n = fiber.config.sections;
  const double square = square_of(fiber.config, mode);
  Eigen::VectorXd values(3 * n);
  for (int s = 0; s < n; ++s) {
    const Cylindrical shares = at((s - 0.5 * (n - 1)) * fiber.spacing());
    for (int a = 0; a < 3; ++a) values[3 * s + a] = square * shares[a];
  }
  return values;
}

Eigen::LLT<Eigen::MatrixXd> factor(const Fiber& fiber, const int mode, const double viscosity) {
  const Eigen::LLT<Eigen::MatrixXd> factor(make_mobility(fiber, mode, viscosity));
  // The square of the ratio of pivots is about the condition number.
  constexpr double least_pivot = 1e-7;
  const auto pivots = factor.matrixLLT().diagonal();
  if (factor.info() != Eigen::Success || !(pivots.minCoeff() > least_pivot * pivots.maxCoeff()))
    throw Error(ExitCode::scene_error,
                fmt::format("blob {:g} is too large for nodes {:g} apart: rounding decides which forces hold a rigid "
                            "tube. Use a smaller blob or fewer nodes.",
                            fiber.config.blob, fiber.spacing()));
  return factor;
}

/// @param forces  of mode 1 that hold the tube in a shear along it
double find_couple_within(const Fiber& fiber, const Eigen::VectorXd& forces) {
  const int n = fiber.config.sections, middle = n / 2;
  const double square = 0.5 * fiber.config.nodes_per_section;
  // Forces across, (cos, -sin) as for a shift, on the sections before; they and the couple change slowly here.
  double across = 0.0;
  for (int s = 0; s < middle; ++s) across += square * (forces[3 * s] - forces[3 * s + 1]);
  across += 0.5 * square * (forces[3 * middle] - forces[3 * middle + 1]);
  return square * fiber.config.radius * forces[3 * middle + 2] / fiber.spacing() + across;
}

}  // namespace

double RigidTubeDrag::effective_aspect_ratio() const { return std::sqrt(torque_across / torque_along); }

RigidTubeDrag measure_rigid_tube(const Fiber& fiber, const double viscosity) {
  SKEIN_REQUIRE(fiber.config.nodes_per_section >= 3, "a ring of less than three nodes is no tube");
  const double radius = fiber.config.radius;
  RigidTubeDrag drag;

  const auto along = factor(fiber, 0, viscosity);
  const Eigen::VectorXd slide = project(fiber, 0, [](double) { return Cylindrical{0.0, 0.0, 1.0}; });
  const Eigen::VectorXd spin = project(fiber, 0, [&](double) { return Cylindrical{0.0, radius, 0.0}; });
  drag.axial = slide.dot(along.solve(slide));
  drag.spinning = spin.dot(along.solve(spin));

  // Along x, u = (cos, -sin, 0); about y, with the tube along z, u = (z, 0, -x).
  const auto across = factor(fiber, 1, viscosity);
  const Eigen::VectorXd shift = project(fiber, 1, [](double) { return Cylindrical{1.0, -1.0, 0.0}; });
  const Eigen::VectorXd grows_along = project(fiber, 1, [](const double z) { return Cylindrical{z, -z, 0.0}; });
  const Eigen::VectorXd grows_across = project(fiber, 1, [&](double) { return Cylindrical{0.0, 0.0, radius}; });
  const Eigen::VectorXd turn = grows_along - grows_across;
  const Eigen::VectorXd forces = across.solve(turn);
  drag.transverse = shift.dot(across.solve(shift));
  drag.turning = turn.dot(forces);
  drag.torque_across = grows_along.dot(forces);
  drag.torque_along = -grows_across.dot(forces);
  drag.couple_within = find_couple_within(fiber, across.solve(grows_across));
  return drag;
}

}  // namespace skein
