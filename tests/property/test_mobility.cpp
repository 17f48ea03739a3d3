#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include "tests/property/mobility_properties.hpp"
#include "tests/reference/point_cloud.hpp"
#include "tests/support/rank_team.hpp"

#include <cmath>
#include <limits>

// What every Mobility must do with the arrays that it is given. An implementation joins by a row in the table at the
// end.

namespace skein {
namespace {

using reference::Cloud;
using reference::PointForces;
using reference::relative_error;

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
    Mobility& mobility = mobility_of(fluid.viscosity);
    const ConstVectors target = to_device("test::target", all.position);
    const Vectors velocity("test::velocity", all.position.size());
    mobility.add_velocity(on_device(first), target, velocity);
    mobility.add_velocity(on_device(rest), target, velocity);
    RC_ASSERT(relative_error(to_host(velocity), compute(all, fluid.viscosity)) <= 3.0 * tolerance());
  }));
}

TEST_P(MobilityProperties, AddsToTheVelocity) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(600, *rc::gen::arbitrary<bool>());
    auto expected = compute(fluid.sources, fluid.viscosity);
    const auto before =
        reference::make_random_vectors(static_cast<int>(expected.size()), norm(expected.front()), fluid.random);
    const Sources sources = on_device(fluid.sources);
    const Vectors velocity = to_device("test::velocity", before);
    mobility_of(fluid.viscosity).add_velocity(sources, sources.position, velocity);
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
    const Sources sources = on_device(fluid.sources);
    const Vectors velocity("test::velocity", fluid.sources.position.size());
    GetParam().make(fluid.viscosity)->add_velocity(sources, sources.position, velocity);
    const bool same = to_host(velocity) == compute(fluid.sources, fluid.viscosity);
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
    Mobility& mobility = mobility_of(fluid.viscosity);
    const Vectors position = to_device("test::position", first.position), force = to_device("test::force", first.force);
    const Scalars blob = to_device("test::blob", first.blob);
    const Vectors ignored("test::velocity", n), velocity("test::velocity", n);
    mobility.add_velocity({position, force, blob}, position, ignored);
    Kokkos::deep_copy(position, to_device("test::position", changed.position));
    Kokkos::deep_copy(force, to_device("test::force", changed.force));
    Kokkos::deep_copy(blob, to_device("test::blob", changed.blob));
    mobility.add_velocity({position, force, blob}, position, velocity);
    const bool same = to_host(ConstVectors(velocity)) == compute(changed, fluid.viscosity);
    RC_ASSERT(same);
  }));
}

// A node that is nowhere: no crash, no endless tree, and the time step will see it.
TEST_P(MobilityProperties, LetsPositionsThatAreNotFiniteBeSeen) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(900, *rc::gen::arbitrary<bool>());
    const auto node = static_cast<std::size_t>(fluid.random.bits() % fluid.sources.position.size());
    const double value =
        *rc::gen::element(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                          -std::numeric_limits<double>::infinity());
    Vec3& x = fluid.sources.position[node];
    (fluid.random.bits() % 2 == 0 ? x.x : x.z) = value;
    const Vec3 u = compute(fluid.sources, fluid.viscosity)[node];
    RC_ASSERT(!std::isfinite(u.x + u.y + u.z));
  }));
}

// A step that fails may send nodes anywhere before it is given up.
TEST_P(MobilityProperties, SurvivesPositionsOfAnySize) {
  EXPECT_TRUE(rc::check([this] {
    Fluid fluid = draw_fluid(300, *rc::gen::arbitrary<bool>());
    const double factor = fluid.random.log_uniform(1e-300, 1e300);
    for (Vec3& x : fluid.sources.position)
      if (fluid.random.bits() % 4 == 0) x = factor * x;
    RC_ASSERT(compute(fluid.sources, fluid.viscosity).size() == fluid.sources.position.size());
  }));
}

TEST_P(MobilityProperties, SaysWhatItIs) { EXPECT_FALSE(GetParam().make(1.7)->describe().empty()); }

TEST_P(MobilityProperties, NoSourcesAndNoTargetsAreAllowed) {
  EXPECT_EQ(compute_at({}, {{0.1, 0.2, 0.3}}, 1.7), std::vector<Vec3>(1));
  EXPECT_TRUE(compute_at({{{0.1, 0.2, 0.3}}, {{1.0, 2.0, 3.0}}, {0.3}}, {}, 1.7).empty());
}

std::unique_ptr<Mobility> make_direct_in_double(const double viscosity) {
  return std::make_unique<DirectMobility>(viscosity, Precision::in_double, KernelPath::automatic, test::find_team());
}
std::unique_ptr<Mobility> make_direct_in_single(const double viscosity) {
  return std::make_unique<DirectMobility>(viscosity, Precision::in_single, KernelPath::automatic, test::find_team());
}
std::unique_ptr<Mobility> make_direct_on_device(const double viscosity) {
  return std::make_unique<DirectMobility>(viscosity, Precision::in_single, KernelPath::device, test::find_team());
}

/// Leaves small enough that these few nodes have a far field.
std::unique_ptr<Mobility> make_fmm(const double viscosity, const double tolerance, const FarField far_field,
                                   const KernelPath path = KernelPath::automatic) {
  FmmOptions options;
  options.path = path;
  options.tolerance = tolerance;
  options.far_field = far_field;
  options.leaf_size = 6;
  return std::make_unique<FmmMobility>(viscosity, options, test::find_team());
}
std::unique_ptr<Mobility> make_fmm_in_single(const double viscosity) {
  return make_fmm(viscosity, 1e-5, FarField::harmonic);
}
std::unique_ptr<Mobility> make_fmm_in_double(const double viscosity) {
  return make_fmm(viscosity, 3e-7, FarField::harmonic);
}
std::unique_ptr<Mobility> make_fmm_on_device(const double viscosity) {
  return make_fmm(viscosity, 1e-5, FarField::harmonic, KernelPath::device);
}
std::unique_ptr<Mobility> make_fmm_of_stokeslets(const double viscosity) {
  return make_fmm(viscosity, 1e-3, FarField::stokeslet);
}

INSTANTIATE_TEST_SUITE_P(, MobilityProperties,
                         ::testing::Values(Row{"direct_in_double", make_direct_in_double, 1e-14},
                                           Row{"direct_in_single", make_direct_in_single, 5e-6},
                                           Row{"direct_on_device", make_direct_on_device, 5e-6},
                                           Row{"fmm_in_single", make_fmm_in_single, 3e-5},
                                           Row{"fmm_in_double", make_fmm_in_double, 3e-6},
                                           Row{"fmm_on_device", make_fmm_on_device, 3e-5},
                                           Row{"fmm_of_stokeslets", make_fmm_of_stokeslets, 1e-2}),
                         ::testing::PrintToStringParamName());

}  // namespace
}  // namespace skein
