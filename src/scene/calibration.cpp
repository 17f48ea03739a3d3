#include <cmath>
#include <numbers>
#include <skein/core/error.hpp>
#include <skein/scene/calibration.hpp>

namespace skein {
namespace {

/// Curvature times radius at which EI is taken as its limit: EI falls by 0.055 (curvature R)^2 of itself, here
/// by 1.4e-8, while strains are far above rounding.
constexpr double small_bend = 5e-4;

/// Second derivative of the energy of the springs from one section to the next by a strain of the beam, per length of
/// beam. `stretch(angle between the nodes, rest length)` is the change of a spring's length per strain.
template <class Stretch>
double sum_links(const Fiber& fiber, const Stretch& stretch) {
  const SpringStencil stencil = make_spring_network(fiber).stencil;
  const int n = stencil.nodes_per_section;
  double sum = 0.0;
  for (int node = 0; node < n; ++node) {
    const int entry = stencil.entry(1, node);
    const double change = stretch(2.0 * std::numbers::pi * node / n, stencil.rest_length[entry]);
    // d2E/dr2 = k / l at rest; every node of a section has this spring.
    sum += n * stencil.stiffness[entry] / stencil.rest_length[entry] * change * change;
  }
  return sum / fiber.spacing();
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
  // Sections stay rigid, so all energy is in the N_f - 1 links, alike along an arc.
  stiffness.infinite_bending = stiffness.bending * fiber.config.sections / (fiber.config.sections - 1);
  stiffness.axial = sum_links(fiber, [&](double, const double length) { return spacing * spacing / length; });
  stiffness.torsional = sum_links(fiber, [&](const double angle, const double length) {
    return spacing * radius * radius * std::sin(angle) / length;
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
