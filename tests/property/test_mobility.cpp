#include <skein/hydro/direct_mobility.hpp>
#include <skein/hydro/fmm_mobility.hpp>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "tests/property/random_fluid.hpp"
#include "tests/reference/gauss_rule.hpp"
#include "tests/reference/point_cloud.hpp"
#include "tests/reference/regularized_stokeslet_reference.hpp"

#include <cmath>
#include <functional>
#include <memory>
#include <numbers>

// What every Mobility must do. An implementation joins by a row in the table at the end.

namespace skein {
namespace {

using reference::Cloud;
using reference::PointForces;
using reference::relative_error;

struct Row {
  const char* name;
  std::function<std::unique_ptr<Mobility>(double viscosity)> make;
  double tolerance;  ///< error of a velocity over the largest velocity
};

std::ostream& operator<<(std::ostream& out, const Row& row) { return out << row.name; }

class MobilityProperties : public ::testing::TestWithParam<Row> {
 protected:
  double tolerance() const { return GetParam().tolerance; }

  /// Velocities at other points than the sources' own array, even where these are equal.
  std::vector<Vec3> compute_at(const PointForces& from, const std::vector<Vec3>& target, const double viscosity) const {
    const auto mobility = GetParam().make(viscosity);
    const Vectors velocity("test::velocity", target.size());
    mobility->add_velocity(on_device(from), to_device("test::target", target), velocity);
    return to_host(velocity);
  }

  /// Velocities of the sources: the targets are the same array.
  std::vector<Vec3> compute(const PointForces& from, const double viscosity) const {
    const auto mobility = GetParam().make(viscosity);
    const Sources sources = on_device(from);
    const Vectors velocity("test::velocity", from.position.size());
    mobility->add_velocity(sources, sources.position, velocity);
    return to_host(velocity);
  }

  static Sources on_device(const PointForces& from) {
    return {to_device("test::position", from.position), to_device("test::force", from.force),
            to_device("test::blob", from.blob)};
  }
};

TEST_P(MobilityProperties, AgreesWithTheReferenceSumAtTheSources) {
  EXPECT_TRUE(rc::check([this] {
    const Fluid fluid = draw_fluid(800, *rc::gen::arbitrary<bool>());
    const double error =
        relative_error(compute(fluid.sources, fluid.viscosity),
                       reference::compute_stokeslet_velocity(fluid.sources, fluid.sources.position, fluid.viscosity));
    RC_LOG() << "error " << error << '\n';
    RC_ASSERT(error <= tolerance());
  }));
}

TEST_P(MobilityProperties, AgreesWithTheReferenceSumAtOtherTargets) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(300, false);
    const int n_targets = 1 + static_cast<int>(fluid.random.bits() % 500);
    const Vec3 near = fluid.sources.position.front() + fluid.random.in_cube(fluid.size);
    const auto target = reference::make_cloud(Cloud::cube, n_targets, near, 2.0 * fluid.size, fluid.random);
    const double error = relative_error(compute_at(fluid.sources, target, fluid.viscosity),
                                        reference::compute_stokeslet_velocity(fluid.sources, target, fluid.viscosity));
    RC_LOG() << "error " << error << '\n';
    RC_ASSERT(error <= tolerance());
  }));
}

TEST_P(MobilityProperties, DoesNotMindWhetherTargetsAreTheSourcesOwnArray) {
  EXPECT_TRUE(rc::check([this] {
    const Fluid fluid = draw_fluid(800, true);
    RC_ASSERT(relative_error(compute(fluid.sources, fluid.viscosity),
                             compute_at(fluid.sources, fluid.sources.position, fluid.viscosity)) <= 2.0 * tolerance());
  }));
}

TEST_P(MobilityProperties, IsSymmetric) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(800, true);
    PointForces other = fluid.sources;
    other.force = reference::make_random_vectors(static_cast<int>(other.force.size()), 0.7, fluid.random);
    const auto u = compute(fluid.sources, fluid.viscosity), v = compute(other, fluid.viscosity);
    const double g_m_f = reference::inner_product(other.force, u),
                 f_m_g = reference::inner_product(fluid.sources.force, v);
    RC_ASSERT(std::abs(g_m_f - f_m_g) <=
              tolerance() * (norm_of(other.force) * norm_of(u) + norm_of(fluid.sources.force) * norm_of(v)));
  }));
}

// A force at A moves B as the same force at B moves A, also where A are sources and B targets.
TEST_P(MobilityProperties, IsSymmetricBetweenTwoSetsOfPoints) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(400, true);
    PointForces other = fluid.sources;
    const int n_others = 1 + static_cast<int>(fluid.random.bits() % 300);
    other.position =
        reference::make_cloud(Cloud::tube, n_others, fluid.sources.position.front(), fluid.size, fluid.random);
    other.force = reference::make_random_vectors(n_others, 0.7, fluid.random);
    other.blob.assign(n_others, fluid.sources.blob.front());
    const auto u = compute_at(fluid.sources, other.position, fluid.viscosity);
    const auto v = compute_at(other, fluid.sources.position, fluid.viscosity);
    RC_ASSERT(std::abs(reference::inner_product(other.force, u) - reference::inner_product(fluid.sources.force, v)) <=
              tolerance() * (norm_of(other.force) * norm_of(u) + norm_of(fluid.sources.force) * norm_of(v)));
  }));
}

// Opposite forces on near neighbours dissipate least: forces alternate, and points come in pairs less than a blob
// apart.
TEST_P(MobilityProperties, DissipatesForDistinctPoints) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(400, true);
    PointForces& nodes = fluid.sources;
    const double blob = nodes.blob.front();
    const bool in_pairs = *rc::gen::arbitrary<bool>();
    for (std::size_t i = 1; in_pairs && i < nodes.position.size(); i += 2) {
      nodes.position[i] = nodes.position[i - 1] + 0.5 * blob * fluid.random.direction();
      nodes.force[i] = -nodes.force[i - 1];
    }
    const double power = reference::inner_product(nodes.force, compute(nodes, fluid.viscosity));
    RC_ASSERT(power > 0.0);
  }));
}

// Forces that cancel at each point do nothing at all: zero but for rounding, which may have any sign.
TEST_P(MobilityProperties, NeverGainsEnergyFromCoincidentPoints) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(400, true);
    PointForces& nodes = fluid.sources;
    const bool cancelling = *rc::gen::arbitrary<bool>();
    for (std::size_t i = 1; i < nodes.position.size(); i += 2) {
      nodes.position[i] = nodes.position[i - 1];
      if (cancelling) nodes.force[i] = -nodes.force[i - 1];
    }
    const auto u = compute(nodes, fluid.viscosity);
    const double power = reference::inner_product(nodes.force, u);
    // What the same forces would do without cancelling sets the scale of rounding.
    double scale = 0.0;
    for (const Vec3 f : nodes.force)
      scale += dot(f, f) / (4.0 * std::numbers::pi * fluid.viscosity * nodes.blob.front());
    RC_ASSERT(std::isfinite(power));
    RC_ASSERT(power >= -10.0 * tolerance() * scale);
    if (!cancelling) RC_ASSERT(power > 0.0);
  }));
}

TEST_P(MobilityProperties, TurnsAndMovesWithItsNodes) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(700, *rc::gen::arbitrary<bool>());
    const RigidMotion motion(fluid.random, fluid.size);
    PointForces moved = fluid.sources;
    moved.position = motion.move(moved.position);
    moved.force = motion.turn(moved.force);
    const auto velocity = compute(moved, fluid.viscosity);
    // Moving the nodes rounds their positions: blobs of 1e-3 sizes see that as some 1e-12 of a velocity.
    RC_ASSERT(relative_error(velocity, motion.turn(compute(fluid.sources, fluid.viscosity))) <=
              2.0 * tolerance() + 1e-11);
  }));
}

TEST_P(MobilityProperties, MirrorsWithItsNodes) {
  EXPECT_TRUE(rc::check([this] {
    const Fluid fluid = draw_fluid(500, true);
    const auto mirrored = [](std::vector<Vec3> list) {
      for (Vec3& v : list) v.y = -v.y;
      return list;
    };
    PointForces image = fluid.sources;
    image.position = mirrored(image.position);
    image.force = mirrored(image.force);
    RC_ASSERT(relative_error(compute(image, fluid.viscosity), mirrored(compute(fluid.sources, fluid.viscosity))) <=
              2.0 * tolerance());
  }));
}

TEST_P(MobilityProperties, IsInverseToTheViscosity) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(500, *rc::gen::arbitrary<bool>());
    const double factor = fluid.random.log_uniform(0.01, 100.0);
    auto thick = compute(fluid.sources, factor * fluid.viscosity);
    for (Vec3& u : thick) u = factor * u;
    RC_ASSERT(relative_error(thick, compute(fluid.sources, fluid.viscosity)) <= 2.0 * tolerance());
  }));
}

// Lengths times c, forces alike: velocities over c. Nothing in the fluid has a length of its own but the blob.
TEST_P(MobilityProperties, ScalesWithLength) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(500, *rc::gen::arbitrary<bool>());
    const double factor = fluid.random.log_uniform(0.01, 100.0);
    PointForces large = fluid.sources;
    for (Vec3& x : large.position) x = factor * x;
    for (double& blob : large.blob) blob *= factor;
    auto velocity = compute(large, fluid.viscosity);
    for (Vec3& u : velocity) u = factor * u;
    RC_ASSERT(relative_error(velocity, compute(fluid.sources, fluid.viscosity)) <= 2.0 * tolerance() + 1e-11);
  }));
}

TEST_P(MobilityProperties, SuperposesForces) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(600, *rc::gen::arbitrary<bool>());
    const double a = fluid.random.uniform(-3.0, 3.0), b = fluid.random.uniform(-3.0, 3.0);
    PointForces other = fluid.sources, both = fluid.sources;
    other.force = reference::make_random_vectors(static_cast<int>(other.force.size()),
                                                 norm(fluid.sources.force.front()), fluid.random);
    for (std::size_t i = 0; i < both.force.size(); ++i) both.force[i] = a * both.force[i] + b * other.force[i];
    const auto u = compute(fluid.sources, fluid.viscosity), v = compute(other, fluid.viscosity),
               w = compute(both, fluid.viscosity);
    double difference = 0.0, scale = 0.0;
    for (std::size_t i = 0; i < w.size(); ++i) {
      difference = std::max(difference, norm(w[i] - (a * u[i] + b * v[i])));
      scale = std::max({scale, norm(a * u[i]), norm(b * v[i])});
    }
    RC_ASSERT(difference <= 4.0 * tolerance() * scale);
  }));
}

TEST_P(MobilityProperties, IsTheSumOfItsParts) {
  EXPECT_TRUE(rc::check([this] {
    const Fluid fluid = draw_fluid(600, false);
    const auto& all = fluid.sources;
    const auto cut = static_cast<std::ptrdiff_t>(all.position.size() / 3);
    const PointForces first{{all.position.begin(), all.position.begin() + cut},
                            {all.force.begin(), all.force.begin() + cut},
                            {all.blob.begin(), all.blob.begin() + cut}};
    const PointForces rest{{all.position.begin() + cut, all.position.end()},
                           {all.force.begin() + cut, all.force.end()},
                           {all.blob.begin() + cut, all.blob.end()}};
    // One after the other into the same velocities.
    const auto mobility = GetParam().make(fluid.viscosity);
    const ConstVectors target = to_device("test::target", all.position);
    const Vectors velocity("test::velocity", all.position.size());
    mobility->add_velocity(on_device(first), target, velocity);
    mobility->add_velocity(on_device(rest), target, velocity);
    RC_ASSERT(relative_error(to_host(velocity), compute(all, fluid.viscosity)) <= 3.0 * tolerance());
  }));
}

TEST_P(MobilityProperties, AddsToTheVelocity) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(600, *rc::gen::arbitrary<bool>());
    auto expected = compute(fluid.sources, fluid.viscosity);
    const auto before =
        reference::make_random_vectors(static_cast<int>(expected.size()), norm(expected.front()), fluid.random);
    const auto mobility = GetParam().make(fluid.viscosity);
    const Sources sources = on_device(fluid.sources);
    const Vectors velocity = to_device("test::velocity", before);
    mobility->add_velocity(sources, sources.position, velocity);
    for (std::size_t i = 0; i < expected.size(); ++i) expected[i] = expected[i] + before[i];
    RC_ASSERT(relative_error(to_host(velocity), expected) <= 2.0 * tolerance());
  }));
}

TEST_P(MobilityProperties, NoForceNoVelocity) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(600, *rc::gen::arbitrary<bool>());
    fluid.sources.force.assign(fluid.sources.force.size(), Vec3{});
    for (const Vec3 u : compute(fluid.sources, fluid.viscosity)) RC_ASSERT(u == Vec3{});
  }));
}

TEST_P(MobilityProperties, RepeatsItselfToTheBit) {
  EXPECT_TRUE(rc::check([this] {
    const Fluid fluid = draw_fluid(700, *rc::gen::arbitrary<bool>());
    const bool same = compute(fluid.sources, fluid.viscosity) == compute(fluid.sources, fluid.viscosity);
    RC_ASSERT(same);
  }));
}

// One object, many calls: nothing may be left over from other positions, forces, blobs or numbers of nodes.
TEST_P(MobilityProperties, RemembersNothing) {
  EXPECT_TRUE(rc::check([this] {
    const Fluid fluid = draw_fluid(500, *rc::gen::arbitrary<bool>()),
                other = draw_fluid(500, *rc::gen::arbitrary<bool>());
    const auto mobility = GetParam().make(fluid.viscosity);
    const Sources theirs = on_device(other.sources), ours = on_device(fluid.sources);
    const Vectors ignored("test::velocity", other.sources.position.size());
    mobility->add_velocity(theirs, theirs.position, ignored);
    const Vectors velocity("test::velocity", fluid.sources.position.size());
    mobility->add_velocity(ours, ours.position, velocity);
    const bool same = to_host(velocity) == compute(fluid.sources, fluid.viscosity);
    RC_ASSERT(same);
    const auto n = static_cast<double>(fluid.sources.position.size()),
               m = static_cast<double>(other.sources.position.size());
    RC_ASSERT(mobility->pairs() == n * n + m * m);
  }));
}

// The arrays are the caller's: what stands in them may change between calls.
TEST_P(MobilityProperties, SeesArraysThatChangeInPlace) {
  EXPECT_TRUE(rc::check([this] {
    const Fluid fluid = draw_fluid(600, true);
    PointForces changed = draw_fluid(600, false).sources;
    const std::size_t n = std::min(changed.position.size(), fluid.sources.position.size());
    PointForces first = fluid.sources;
    for (PointForces* forces : {&first, &changed}) {
      forces->position.resize(n);
      forces->force.resize(n);
      forces->blob.resize(n);
    }
    const auto mobility = GetParam().make(fluid.viscosity);
    const Vectors position = to_device("test::position", first.position), force = to_device("test::force", first.force);
    const Scalars blob = to_device("test::blob", first.blob);
    const Vectors ignored("test::velocity", n), velocity("test::velocity", n);
    mobility->add_velocity({position, force, blob}, position, ignored);
    Kokkos::deep_copy(position, to_device("test::position", changed.position));
    Kokkos::deep_copy(force, to_device("test::force", changed.force));
    Kokkos::deep_copy(blob, to_device("test::blob", changed.blob));
    mobility->add_velocity({position, force, blob}, position, velocity);
    const bool same = to_host(ConstVectors(velocity)) == compute(changed, fluid.viscosity);
    RC_ASSERT(same);
  }));
}

// What flows into a sphere flows out of it, wherever the forces are: inside, outside, and their blobs across its
// surface.
TEST_P(MobilityProperties, IsDivergenceFree) {
  std::vector<double> cosine, weight;
  const int n_polar = 40, n_around = 80;
  reference::make_gauss_rule(n_polar, cosine, weight);
  EXPECT_TRUE(rc::check([&, this] {
    Fluid fluid = draw_fluid(60, false);
    const double radius = fluid.size;
    const Vec3 center = fluid.random.in_cube(5.0 * radius);
    // Not nearer than 0.4 radii to the surface, where 40 rings resolve the flow to 1e-13.
    for (std::size_t i = 0; i < fluid.sources.position.size(); ++i) {
      const bool inside = fluid.random.bits() % 2 == 0;
      const double r = radius * (inside ? fluid.random.uniform(0.0, 0.6) : fluid.random.uniform(1.6, 3.0));
      fluid.sources.position[i] = center + r * fluid.random.direction();
      fluid.sources.blob[i] = radius * fluid.random.log_uniform(0.01, 1.0);
    }
    std::vector<Vec3> normal, target;
    std::vector<double> area;
    for (int i = 0; i < n_polar; ++i)
      for (int j = 0; j < n_around; ++j) {
        const double across = std::sqrt(1.0 - cosine[i] * cosine[i]), angle = 2.0 * std::numbers::pi * j / n_around;
        normal.push_back({across * std::cos(angle), across * std::sin(angle), cosine[i]});
        target.push_back(center + radius * normal.back());
        area.push_back(radius * radius * weight[i] * 2.0 * std::numbers::pi / n_around);
      }
    const auto velocity = compute_at(fluid.sources, target, fluid.viscosity);
    double flux = 0.0, through = 0.0;
    for (std::size_t k = 0; k < target.size(); ++k) {
      flux += area[k] * dot(velocity[k], normal[k]);
      through += area[k] * norm(velocity[k]);
    }
    RC_LOG() << "flux " << flux / through << '\n';
    RC_ASSERT(std::abs(flux) <= (2.0 * tolerance() + 1e-13) * through);
  }));
}

TEST_P(MobilityProperties, SaysWhatItIs) { EXPECT_FALSE(GetParam().make(1.7)->describe().empty()); }

TEST_P(MobilityProperties, NoSourcesAndNoTargetsAreAllowed) {
  EXPECT_EQ(compute_at({}, {{0.1, 0.2, 0.3}}, 1.7), std::vector<Vec3>(1));
  EXPECT_TRUE(compute_at({{{0.1, 0.2, 0.3}}, {{1.0, 2.0, 3.0}}, {0.3}}, {}, 1.7).empty());
}

std::unique_ptr<Mobility> make_direct_in_double(const double viscosity) {
  return std::make_unique<DirectMobility>(viscosity, Precision::in_double);
}
std::unique_ptr<Mobility> make_direct_in_single(const double viscosity) {
  return std::make_unique<DirectMobility>(viscosity, Precision::in_single);
}

/// Leaves small enough that these few nodes have a far field.
std::unique_ptr<Mobility> make_fmm(const double viscosity, const double tolerance, const FarField far_field) {
  FmmOptions options;
  options.tolerance = tolerance;
  options.far_field = far_field;
  options.leaf_size = 6;
  return std::make_unique<FmmMobility>(viscosity, options);
}
std::unique_ptr<Mobility> make_fmm_in_single(const double viscosity) {
  return make_fmm(viscosity, 1e-5, FarField::harmonic);
}
std::unique_ptr<Mobility> make_fmm_in_double(const double viscosity) {
  return make_fmm(viscosity, 3e-7, FarField::harmonic);
}
std::unique_ptr<Mobility> make_fmm_of_stokeslets(const double viscosity) {
  return make_fmm(viscosity, 1e-3, FarField::stokeslet);
}

INSTANTIATE_TEST_SUITE_P(, MobilityProperties,
                         ::testing::Values(Row{"direct_in_double", make_direct_in_double, 1e-14},
                                           Row{"direct_in_single", make_direct_in_single, 5e-6},
                                           Row{"fmm_in_single", make_fmm_in_single, 3e-5},
                                           Row{"fmm_in_double", make_fmm_in_double, 3e-6},
                                           Row{"fmm_of_stokeslets", make_fmm_of_stokeslets, 1e-2}),
                         ::testing::PrintToStringParamName());

}  // namespace
}  // namespace skein
