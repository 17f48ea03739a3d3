#include <skein/core/error.hpp>
#include <skein/fibers/calibration.hpp>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

// The numbers are those of tests/reference/beam_stiffness.py.

namespace skein {
namespace {

Fiber make_fiber(const int sections, const double stiffness = 0.0112) {
  FiberConfig config;
  config.sections = sections;
  config.spring_stiffness = stiffness;
  return make_fibers({config})[0];
}

/// mu_bar of LaGrone, Cortez, Yan, Fauci 2019, as printed, by number of sections.
const std::vector<std::pair<int, double>> printed_numbers = {
    {80, 5.35e2}, {113, 1.97e3}, {301, 8.22e4}, {536, 7.51e5}, {1313, 2.37e7}};

double elasto_viscous_number(const Fiber& fiber) {
  const double bending = measure_beam_stiffness(fiber).bending;
  return compute_elasto_viscous_numbers(fiber, 1.0, 2.5, bending).with_log_4e_over_rho2;
}

TEST(Calibration, BendingRigidityOfAnInfiniteFiber) {
  for (const int sections : {2, 80, 113})
    EXPECT_NEAR(measure_beam_stiffness(make_fiber(sections)).infinite_bending, 4.88344e-6, 5e-12) << sections;
}

TEST(Calibration, AFiberHasOneLinkLessThanSections) {
  for (const int sections : {2, 80, 1313}) {
    const BeamStiffness stiffness = measure_beam_stiffness(make_fiber(sections));
    EXPECT_NEAR(stiffness.bending / 4.88344e-6, (sections - 1.0) / sections, 1e-6) << sections;
  }
}

TEST(Calibration, RigidityFallsWithCurvature) {
  const std::vector<std::pair<double, double>> known = {
      {0.1, 4.88344e-6}, {10, 4.88275e-6}, {50, 4.86646e-6}, {100, 4.81715e-6}};
  for (const int sections : {80, 301})
    for (const auto& [curvature, rigidity] : known)
      EXPECT_NEAR(measure_bending_rigidity(make_fiber(sections), curvature) * sections / (sections - 1), rigidity,
                  1e-5 * rigidity)
          << curvature;
}

TEST(Calibration, RigidityIsProportionalToTheStiffness) {
  const double once = measure_beam_stiffness(make_fiber(20, 0.01)).bending;
  EXPECT_NEAR(measure_beam_stiffness(make_fiber(20, 0.03)).bending, 3.0 * once, 1e-12 * once);
}

TEST(Calibration, PlaneSectionModuli) {
  const BeamStiffness stiffness = measure_beam_stiffness(make_fiber(80));
  EXPECT_NEAR(stiffness.axial, 0.415912, 1e-5 * 0.415912);
  EXPECT_NEAR(stiffness.torsional, 1.19214e-5, 1e-5 * 1.19214e-5);
}

TEST(Calibration, ModuliAreSecondDerivativesOfTheEnergy) {
  const Fiber fiber = make_fiber(6);
  const SpringNetwork network = make_spring_network(fiber);
  const auto straight = make_surface_nodes({fiber});
  const double links = 5 * fiber.spacing();
  const BeamStiffness stiffness = measure_beam_stiffness(fiber);
  constexpr double strain = 1e-5;
  constexpr double twist = 1e-2;  // angle per length

  std::vector<Vec3> stretched = straight, twisted = straight;
  for (Vec3& x : stretched) x.x *= 1.0 + strain;
  for (Vec3& x : twisted) {
    const double angle = twist * x.x;
    x = {x.x, std::cos(angle) * x.y - std::sin(angle) * x.z, std::sin(angle) * x.y + std::cos(angle) * x.z};
  }
  EXPECT_NEAR(2.0 * compute_spring_energy(network, stretched) / (strain * strain * links), stiffness.axial,
              1e-4 * stiffness.axial);
  EXPECT_NEAR(2.0 * compute_spring_energy(network, twisted) / (twist * twist * links), stiffness.torsional,
              1e-4 * stiffness.torsional);
}

TEST(Calibration, ModuliFollowFamiliesProfileAndReach) {
  const BeamStiffness plain = measure_beam_stiffness(make_fiber(41));
  FiberConfig config = make_fiber(41).config;
  // Plane sections: springs inside them do not stretch.
  config.stiffness_within_sections = 3.0;
  config.stiffness_between_sections = 0.5;
  BeamStiffness found = measure_beam_stiffness(make_fibers({config})[0]);
  EXPECT_NEAR(found.bending, 0.5 * plain.bending, 1e-9 * plain.bending);
  EXPECT_NEAR(found.infinite_bending, 0.5 * plain.infinite_bending, 1e-6 * plain.bending);
  EXPECT_NEAR(found.axial, 0.5 * plain.axial, 1e-12 * plain.axial);
  EXPECT_NEAR(found.torsional, 0.5 * plain.torsional, 1e-12 * plain.torsional);

  config = make_fiber(41).config;
  config.stiffness_profile = {{0.0, 1.0}, {1.0, 4.0}};  // mean 2.5
  found = measure_beam_stiffness(make_fibers({config})[0]);
  EXPECT_NEAR(found.bending, 2.5 * plain.bending, 1e-9 * plain.bending);
  EXPECT_NEAR(found.infinite_bending, 2.5 * plain.infinite_bending, 1e-6 * plain.bending);
  EXPECT_NEAR(found.axial, 2.5 * plain.axial, 1e-12 * plain.axial);

  config = make_fiber(41).config;
  config.reach_along = 3;
  config.reach_around = 5;
  const Fiber far = make_fibers({config})[0];
  found = measure_beam_stiffness(far);
  // A long fiber's ends hardly count: its EI is the infinite one, its energies give EA and GJ.
  config.sections = 600;
  const Fiber longer = make_fibers({config})[0];
  EXPECT_NEAR(measure_bending_rigidity(longer, 0.1), found.infinite_bending, 0.005 * found.infinite_bending);
  const auto energy_per_length = [&](const auto& strain) {
    auto nodes = make_surface_nodes({longer});
    for (Vec3& x : nodes) x = strain(x);
    return compute_spring_energy(make_spring_network(longer), nodes) / longer.length();
  };
  const double stretched = energy_per_length([](const Vec3 x) { return Vec3{x.x * (1.0 + 1e-5), x.y, x.z}; });
  const double twisted = energy_per_length([](const Vec3 x) {
    const double c = std::cos(1e-2 * x.x), s = std::sin(1e-2 * x.x);
    return Vec3{x.x, c * x.y - s * x.z, s * x.y + c * x.z};
  });
  EXPECT_NEAR(2.0 * stretched / 1e-10, found.axial, 0.005 * found.axial);
  EXPECT_NEAR(2.0 * twisted / 1e-4, found.torsional, 0.005 * found.torsional);
}

/// Twice the energy per length and strain squared in the middle of a tube whose first and last sections are displaced
/// by a field, and whose other nodes are free: what a longer tube has more than a shorter one. All nodes of a network
/// as one linear system, by Eigen: no symmetry is used.
template <class Field>
double measure_relaxed(const FiberConfig& config, const Field& field) {
  const auto energy_of = [&](const int sections) {
    FiberConfig longer = config;
    longer.sections = sections;
    const Fiber fiber = make_fibers({longer})[0];
    const SpringNetwork network = make_spring_network(fiber);
    const auto node = make_surface_nodes({fiber});
    const int n = 3 * static_cast<int>(node.size()), held = 3 * config.reach_along * config.nodes_per_section;
    Eigen::MatrixXd hessian = Eigen::MatrixXd::Zero(n, n);
    for_each_spring(network, [&](const int a, const int b, const int entry) {
      const Vec3 d = node[b] - node[a];
      const Eigen::Vector3d e = Eigen::Vector3d(d.x, d.y, d.z) / norm(d);
      const Eigen::Matrix3d block =
          network.stencil.stiffness[entry] / network.stencil.rest_length[entry] * e * e.transpose();
      for (const auto& [i, j, sign] : {std::tuple{a, a, 1.0}, {b, b, 1.0}, {a, b, -1.0}, {b, a, -1.0}})
        hessian.block<3, 3>(3 * i, 3 * j) += sign * block;
    });
    Eigen::VectorXd displacement(n);
    for (std::size_t i = 0; i < node.size(); ++i) {
      const Vec3 u = field(node[i]);
      displacement.segment<3>(3 * static_cast<Eigen::Index>(i)) << u.x, u.y, u.z;
    }
    const int free = n - 2 * held;
    Eigen::VectorXd fixed = displacement;
    fixed.segment(held, free).setZero();
    const Eigen::VectorXd pull = (hessian * fixed).segment(held, free);
    displacement.segment(held, free) = -hessian.block(held, held, free, free).ldlt().solve(pull);
    return 0.5 * displacement.dot(hessian * displacement);
  };
  constexpr int shorter = 20, more = 8;
  const double spacing = make_fibers({config})[0].spacing();
  return 2.0 * (energy_of(shorter + more) - energy_of(shorter)) / (more * spacing);
}

TEST(Calibration, SectionsThatAreFreeGiveWay) {
  const BeamStiffness paper = measure_beam_stiffness(make_fiber(80));
  EXPECT_NEAR(paper.relaxed_bending, 4.3952e-6, 1e-5 * 4.3952e-6);
  EXPECT_NEAR(paper.relaxed_axial, 0.378204, 1e-5 * 0.378204);
  FiberConfig other;
  other.nodes_per_section = 9;
  FiberConfig wide = other, odd = other;
  other.nodes_per_section = 6;
  other.spring_stiffness = 0.0409;
  wide.reach_along = 2;
  wide.reach_around = 2;
  wide.stiffness_within_sections = 0.3;
  odd.nodes_per_section = 5;
  odd.stiffness_between_sections = 2.5;
  for (const FiberConfig& config : {other, wide, odd}) {
    const BeamStiffness found = measure_beam_stiffness(make_fibers({config})[0]);
    const double bending = measure_relaxed(config, [](const Vec3 x) { return Vec3{-x.x * x.y, 0.5 * x.x * x.x, 0.0}; });
    const double axial = measure_relaxed(config, [](const Vec3 x) { return Vec3{x.x, 0.0, 0.0}; });
    EXPECT_NEAR(found.relaxed_bending, bending, 3e-4 * bending) << config.nodes_per_section;
    EXPECT_NEAR(found.relaxed_axial, axial, 3e-4 * axial) << config.nodes_per_section;
    EXPECT_LT(found.relaxed_bending, 0.95 * found.infinite_bending);
    EXPECT_LT(found.relaxed_axial, 0.95 * found.axial);
    // A twist deforms no section.
    const double torsional = measure_relaxed(config, [](const Vec3 x) { return Vec3{0.0, -x.x * x.z, x.x * x.y}; });
    EXPECT_NEAR(found.torsional, torsional, 1e-6 * torsional);
  }
}

// Springs between close sections lie across the fiber, and rounding decides long before lengths vanish.
TEST(Calibration, SectionsAsCloseAsAScenesMayBeBendByTheSameLaw) {
  FiberConfig config = make_fiber(41).config;
  config.spacing = 1e-2 * config.radius;
  const BeamStiffness near = measure_beam_stiffness(make_fibers({config})[0]);
  config.spacing = 1e-4 * config.radius;
  const BeamStiffness nearest = measure_beam_stiffness(make_fibers({config})[0]);
  EXPECT_NEAR(nearest.infinite_bending, near.infinite_bending, 1e-3 * near.infinite_bending);
  EXPECT_NEAR(nearest.bending, near.bending, 1e-3 * near.bending);
  EXPECT_NEAR(nearest.torsional / config.spacing, near.torsional / (1e-2 * config.radius),
              1e-3 * near.torsional / (1e-2 * config.radius));
}

TEST(Calibration, RelaxedModuliFollowTheProfileAndRigidSections) {
  FiberConfig config = make_fiber(41).config;
  const BeamStiffness plain = measure_beam_stiffness(make_fiber(41));
  config.stiffness_profile = {{0.0, 1.0}, {1.0, 4.0}};
  const BeamStiffness varied = measure_beam_stiffness(make_fibers({config})[0]);
  EXPECT_NEAR(varied.relaxed_bending, 2.5 * plain.relaxed_bending, 1e-9 * plain.bending);
  EXPECT_NEAR(varied.relaxed_axial, 2.5 * plain.relaxed_axial, 1e-9 * plain.axial);
  config = make_fiber(41).config;
  config.stiffness_within_sections = 1e9;
  const BeamStiffness rigid = measure_beam_stiffness(make_fibers({config})[0]);
  EXPECT_NEAR(rigid.relaxed_bending, plain.infinite_bending, 1e-6 * plain.bending);
  EXPECT_NEAR(rigid.relaxed_axial, plain.axial, 1e-6 * plain.axial);
}

TEST(Calibration, BentFiberKeepsItsSectionsAndItsCentrelineLength) {
  const Fiber fiber = make_fiber(40);
  constexpr double curvature = 30.0;
  const auto nodes = make_bent_nodes(fiber, curvature);
  ASSERT_EQ(nodes.size(), 720u);
  const Vec3 centre{0.0, 1.0 / curvature, 0.0};
  const auto centroid = [&](const int section) {
    Vec3 sum;
    for (int a = 0; a < 18; ++a) sum = sum + nodes[18 * section + a];
    return sum / 18.0;
  };
  const double chord = 2.0 / curvature * std::sin(0.5 * curvature * fiber.spacing());
  for (int section = 0; section < 40; ++section) {
    const Vec3 spoke = centroid(section) - centre;
    EXPECT_NEAR(norm(spoke), 1.0 / curvature, 1e-14);
    if (section > 0) {
      EXPECT_NEAR(norm(centroid(section) - centroid(section - 1)), chord, 1e-14);
    }
    for (int a = 0; a < 18; ++a) {
      const Vec3 arm = nodes[18 * section + a] - centroid(section);
      EXPECT_NEAR(norm(arm), 0.005, 1e-15);
      EXPECT_NEAR(dot(arm, cross(spoke, {0, 0, 1})), 0.0, 1e-16);
    }
  }
  EXPECT_THROW(make_bent_nodes(fiber, 0.0), Error);
}

TEST(Calibration, ElastoViscousNumbersArePrintedOnesToHalfAPercent) {
  for (const auto& [sections, printed] : printed_numbers)
    EXPECT_NEAR(elasto_viscous_number(make_fiber(sections)), printed, 0.005 * printed) << sections;
}

TEST(Calibration, ASlightlyStifferSpringGivesThePrintedNumbersToThreeDigits) {
  for (const auto& [sections, printed] : printed_numbers) {
    const double number = elasto_viscous_number(make_fiber(sections, 0.011237));
    const double digit = std::pow(10.0, std::floor(std::log10(printed)) - 2);
    EXPECT_EQ(std::round(number / digit), std::round(printed / digit)) << sections << ": " << number;
  }
}

TEST(Calibration, BothElastoViscousNumbersNameTheirLogarithm) {
  const Fiber fiber = make_fiber(80);
  const double length = fiber.length();
  const auto numbers = compute_elasto_viscous_numbers(fiber, 1.7, -0.6, 3e-6);
  const double rho = 0.005 / length;

  EXPECT_NEAR(numbers.slenderness, rho, 1e-15);
  EXPECT_NEAR(numbers.log_4e_over_rho2, std::log(4.0) + 1.0 - 2.0 * std::log(rho), 1e-13);
  EXPECT_NEAR(numbers.minus_log_rho2_e, -1.0 - 2.0 * std::log(rho), 1e-13);
  const double ratio = 8.0 * std::numbers::pi * 1.7 * 0.6 * length * length * length * length / 3e-6;
  EXPECT_NEAR(numbers.with_log_4e_over_rho2, ratio / numbers.log_4e_over_rho2, 1e-12 * ratio);
  EXPECT_NEAR(numbers.with_minus_log_rho2_e, ratio / numbers.minus_log_rho2_e, 1e-12 * ratio);
  EXPECT_THROW(compute_elasto_viscous_numbers(fiber, 1.7, 2.5, 0.0), Error);
}

}  // namespace
}  // namespace skein
