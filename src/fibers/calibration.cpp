#include <skein/core/error.hpp>
#include <skein/fibers/calibration.hpp>

#include <cmath>
#include <limits>
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

/// A spring of the cell that repeats itself along a fiber without ends, from angle 0 of a section on: the others follow
/// by turns of a node.
struct Link {
  double along;   ///< distance of its sections, length
  double angle;   ///< between its nodes about the axis, radians
  double length;  ///< at rest
};

/// The stiffness of a section's springs against changes of their lengths, summed per length of beam over the spring's
/// places around the section: sum of k/l * product(link, turn), `turn` the angle of the link's first node.
template <class Product>
double sum_springs(const Fiber& fiber, const Product& product) {
  const SpringNetwork network = make_spring_network(fiber);
  const SpringStencil& stencil = network.stencil;
  const int n = stencil.nodes_per_section;
  double sum = 0.0;
  for (int offset = 0; offset <= stencil.reach; ++offset) {
    // Within a section both ends name each spring.
    const double share = offset == 0 ? 0.5 : 1.0;
    for (int node = 0; node < n; ++node) {
      const int entry = stencil.entry(offset, node);
      if (stencil.stiffness[entry] == 0.0) continue;
      const Link link{offset * fiber.spacing(), 2.0 * std::numbers::pi * node / n, stencil.rest_length[entry]};
      for (int first = 0; first < n; ++first)
        sum += share * stencil.stiffness[entry] / link.length * product(link, 2.0 * std::numbers::pi * first / n);
    }
  }
  return mean_factor(network) * sum / fiber.spacing();
}

/// Twice the least energy per length of beam and strain squared. `strain(link, turn)` is how much a spring lengthens
/// per strain of the beam while sections stay rigid, `shape(link, turn)` by a unit of the only change of the sections'
/// shape that the strain calls for.
template <class Strain, class Shape>
double relax(const Fiber& fiber, const Strain& strain, const Shape& shape) {
  const auto sum = [&](const auto& a, const auto& b) {
    return sum_springs(fiber, [&](const Link& link, const double turn) { return a(link, turn) * b(link, turn); });
  };
  const double resistance = sum(shape, shape), coupling = sum(strain, shape);
  return sum(strain, strain) - (resistance > 0.0 ? coupling * coupling / resistance : 0.0);
}

/// How far the places of a link's nodes move apart along the link, in the plane of a section: by displacements of its
/// ends, each outwards and around.
double stretch_across(const Link& link, const double radius, const double out, const double around,
                      const double other_out, const double other_around) {
  // Of the second node seen from the first one's radius and tangent.
  const double cosine = std::cos(link.angle), sine = std::sin(link.angle);
  const double outwards = other_out * cosine - other_around * sine - out;
  const double sideways = other_out * sine + other_around * cosine - around;
  return radius * ((cosine - 1.0) * outwards + sine * sideways) / link.length;
}

/// A beam's curvature lengthens a link by its height over the neutral line; sections answer as cos(angle) and
/// sin(angle), outwards and around, of which a shift of the whole section is no change of shape: so the part around is
/// all that counts.
double measure_relaxed_bending(const Fiber& fiber) {
  const double radius = fiber.config.radius;
  return relax(
      fiber,
      [radius](const Link& link, const double turn) {
        const double height = 0.5 * radius * (std::cos(turn) + std::cos(turn + link.angle));
        return -link.along * link.along * height / link.length;
      },
      [radius](const Link& link, const double turn) {
        return stretch_across(link, radius, 0.0, std::sin(turn), 0.0, std::sin(turn + link.angle));
      });
}

/// A stretched section answers by growing narrower.
double measure_relaxed_axial(const Fiber& fiber) {
  const double radius = fiber.config.radius;
  return relax(
      fiber, [](const Link& link, double) { return link.along * link.along / link.length; },
      [radius](const Link& link, double) { return stretch_across(link, radius, 1.0, 0.0, 1.0, 0.0); });
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

/// A line is the beam that its keys say; it has no sections that could change, and does not twist. A rigid one that
/// says nothing is as stiff as can be.
BeamStiffness take_line_stiffness(const Fiber& fiber) {
  const double factor = mean_factor(make_spring_network(fiber));
  const bool is_unknown = fiber.config.is_rigid() && fiber.config.bending_rigidity == 0.0;
  BeamStiffness stiffness;
  stiffness.bending = stiffness.infinite_bending = stiffness.relaxed_bending =
      is_unknown ? std::numeric_limits<double>::infinity() : factor * fiber.config.bending_rigidity;
  stiffness.axial = stiffness.relaxed_axial = factor * fiber.config.spring_stiffness;
  return stiffness;
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
  if (fiber.config.is_line()) return take_line_stiffness(fiber);
  const double curvature = small_bend / fiber.config.radius;
  const double radius = fiber.config.radius;
  BeamStiffness stiffness;
  stiffness.bending = measure_bending_rigidity(fiber, curvature);
  stiffness.infinite_bending = measure_infinite_bending(fiber, curvature);
  stiffness.axial =
      sum_springs(fiber, [](const Link& link, double) { return std::pow(link.along * link.along / link.length, 2); });
  stiffness.torsional = sum_springs(fiber, [&](const Link& link, double) {
    return std::pow(link.along * radius * radius * std::sin(link.angle) / link.length, 2);
  });
  stiffness.relaxed_bending = measure_relaxed_bending(fiber);
  stiffness.relaxed_axial = measure_relaxed_axial(fiber);
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
