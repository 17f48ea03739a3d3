#include <skein/core/error.hpp>
#include <skein/fibers/calibration.hpp>

#include <cmath>
#include <numbers>

namespace skein {
namespace {

/// Curvature times radius at which EI is taken as its limit: EI falls by 0.055 (curvature R)^2 of itself, here
/// by 1.4e-8, while strains are far above rounding.
constexpr double small_bend = 5e-4;

/// Of springs between sections, weighed by how many there are.
double mean_factor(const SpringNetwork& network) {
  double sum = 0.0;
  for (int section = 0; section + 1 < network.n_sections; ++section) sum += network.factor(section, 1);
  return sum / (network.n_sections - 1);
}

/// Second derivative of the energy of the springs between sections by a strain of the beam, per length of beam.
/// `stretch(sections apart, angle between the nodes, rest length)` is the change of a spring's length per strain.
template <class Stretch>
double sum_links(const Fiber& fiber, const Stretch& stretch) {
  const SpringNetwork network = make_spring_network(fiber);
  const SpringStencil& stencil = network.stencil;
  const int n = stencil.nodes_per_section;
  double sum = 0.0;
  for (int offset = 1; offset <= stencil.reach; ++offset) {
    for (int node = 0; node < n; ++node) {
      const int entry = stencil.entry(offset, node);
      const double change = stretch(offset, 2.0 * std::numbers::pi * node / n, stencil.rest_length[entry]);
      // d2E/dr2 = k / l at rest; every node of a section has this spring.
      sum += n * stencil.stiffness[entry] / stencil.rest_length[entry] * change * change;
    }
  }
  return mean_factor(network) * sum / fiber.spacing();
}

/// From what one more section adds to a fiber as short as its springs allow.
double measure_infinite_bending(const Fiber& fiber, const double curvature) {
  Fiber shorter = fiber;
  shorter.config.stiffness_profile = FiberConfig{}.stiffness_profile;
  shorter.config.sections = fiber.config.reach_along + 1;
  Fiber longer = shorter;
  ++longer.config.sections;
  const auto energy = [curvature](const Fiber& bent) {
    return compute_spring_energy(make_spring_network(bent), make_bent_nodes(bent, curvature));
  };
  return mean_factor(make_spring_network(fiber)) * 2.0 * (energy(longer) - energy(shorter)) /
         (curvature * curvature * fiber.spacing());
}

}  // namespace

std::vector<Vec3> make_bent_nodes(const Fiber& fiber, const double curvature) {
  SKEIN_REQUIRE(curvature > 0.0, "the curvature of an arc is positive");
  const FiberConfig& config = fiber.config;
  std::vector<Vec3> nodes;
  nodes.reserve(fiber.n_nodes());
  for (int section = 0; section < config.sections; ++section) {
    const double turn = curvature * (section - 0.5 * (config.sections - 1)) * fiber.spacing();
    const double half_sine = std::sin(0.5 * turn);
    const Vec3 middle{std::sin(turn) / curvature, 2.0 * half_sine * half_sine / curvature, 0.0};
    const Vec3 inward{-std::sin(turn), std::cos(turn), 0.0};
    for (int node = 0; node < config.nodes_per_section; ++node) {
      const double angle = 2.0 * std::numbers::pi * node / config.nodes_per_section;
      const double height = config.radius * std::sin(angle);
      nodes.push_back(middle + config.radius * std::cos(angle) * inward + Vec3{0.0, 0.0, height});
    }
  }
  return nodes;
}

double measure_bending_rigidity(const Fiber& fiber, const double curvature) {
  const double energy = compute_spring_energy(make_spring_network(fiber), make_bent_nodes(fiber, curvature));
  return 2.0 * energy / (curvature * curvature * fiber.length());
}

BeamStiffness measure_beam_stiffness(const Fiber& fiber) {
  const double curvature = small_bend / fiber.config.radius;
  const double spacing = fiber.spacing();
  const double radius = fiber.config.radius;
  BeamStiffness stiffness;
  stiffness.bending = measure_bending_rigidity(fiber, curvature);
  stiffness.infinite_bending = measure_infinite_bending(fiber, curvature);
  stiffness.axial = sum_links(
      fiber, [&](const int apart, double, const double length) { return std::pow(apart * spacing, 2) / length; });
  stiffness.torsional = sum_links(fiber, [&](const int apart, const double angle, const double length) {
    return apart * spacing * radius * radius * std::sin(angle) / length;
  });
  return stiffness;
}

ElastoViscousNumbers compute_elasto_viscous_numbers(const Fiber& fiber, const double viscosity, const double rate,
                                                    const double bending) {
  SKEIN_REQUIRE(bending > 0.0, "the bending rigidity is positive");
  const double length = fiber.length();
  const double ratio = 8.0 * std::numbers::pi * viscosity * std::abs(rate) * std::pow(length, 4) / bending;
  ElastoViscousNumbers numbers;
  numbers.slenderness = fiber.config.radius / length;
  const double rho_squared = numbers.slenderness * numbers.slenderness;
  numbers.log_4e_over_rho2 = std::log(4.0 * std::numbers::e / rho_squared);
  numbers.with_log_4e_over_rho2 = ratio / numbers.log_4e_over_rho2;
  numbers.minus_log_rho2_e = -std::log(rho_squared * std::numbers::e);
  numbers.with_minus_log_rho2_e = ratio / numbers.minus_log_rho2_e;
  return numbers;
}

}  // namespace skein
