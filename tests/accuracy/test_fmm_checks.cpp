#include <skein/arrays/memory_snapshot.hpp>
#include <skein/core/error.hpp>
#include <skein/physics/direct_mobility.hpp>
#include <skein/physics/fmm_mobility.hpp>

#include "tests/accuracy/fmm_cases.hpp"

#include <gtest/gtest.h>

#include <cstddef>

// What the fast multipole method finds out about its own error while it is used.

namespace skein {
namespace {

using reference::PointForces;

TEST(FmmCheck, MeasuresTheErrorAndMendsOrStops) {
  const PointForces from = with_forces(make_tube(300), 1e-5, 12);
  const Sources sources = on_device(from);
  FmmOptions options;
  options.tolerance = 1e-5;
  options.check_every = 2;
  options.leaf_size = 30;
  const Vectors velocity("velocity", from.position.size()), exact("exact", from.position.size());
  DirectMobility(viscosity, Precision::in_double).add_velocity(sources, sources.position, exact);
  FmmMobility good(viscosity, options);
  good.add_velocity(sources, sources.position, velocity);
  good.add_velocity(sources, sources.position, velocity);
  good.add_velocity(sources, sources.position, velocity);
  EXPECT_EQ(good.error_record().n_checks, 2);
  EXPECT_EQ(good.error_record().n_misses, 0);
  const double all = [&] {
    auto got = to_host(velocity);
    for (Vec3& u : got) u = u / 3.0;  // accumulated three times
    return error_of(got, to_host(exact));
  }();
  EXPECT_LT(good.error_record().last, 3.0 * all);
  EXPECT_GT(good.error_record().last, all / 3.0);

  // Operators cut far too short miss on purpose.
  options.singular_cutoff = 1e-2;
  options.on_miss = OnMiss::stop;
  FmmMobility bad(viscosity, options);
  try {
    bad.add_velocity(sources, sources.position, velocity);
    FAIL() << "a miss went unseen";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::numerical);
  }
  EXPECT_EQ(bad.error_record().n_misses, 1);
}

/// Forces whose far fields add up.
PointForces align(PointForces from) {
  from.force.assign(from.force.size(), {1.0, 0.3, -0.2});
  return from;
}

/// @param cutoff  far too large, until the order is raised
FmmOptions make_options_that_miss(const double tolerance, const double cutoff) {
  FmmOptions options;
  options.tolerance = tolerance;
  options.order = 4;
  options.leaf_size = 30;
  options.singular_cutoff = cutoff;
  options.check_every = 1;
  return options;
}

TEST(FmmCheck, RaisesTheOrderAndLeavesNothingOfTheMissInTheSum) {
  const PointForces from = align(with_forces(make_tube(300), 1e-5, 12));
  const Sources sources = on_device(from);
  const Vectors velocity("velocity", from.position.size()), exact("exact", from.position.size());
  const FmmOptions options = make_options_that_miss(3e-3, 0.5);
  FmmMobility fmm(viscosity, options);
  fmm.add_velocity(sources, sources.position, velocity);
  DirectMobility(viscosity, Precision::in_double).add_velocity(sources, sources.position, exact);
  EXPECT_GE(fmm.error_record().n_misses, 1);
  EXPECT_GT(fmm.statistics().plan.order, 4);
  EXPECT_EQ(fmm.take_messages().size(), fmm.error_record().n_misses);
  EXPECT_TRUE(fmm.take_messages().empty());
  EXPECT_LT(error_of(to_host(velocity), to_host(exact)), options.tolerance);
  const auto n_misses = fmm.error_record().n_misses;
  fmm.add_velocity(sources, sources.position, velocity);
  EXPECT_EQ(fmm.error_record().n_misses, n_misses) << "the raised order is kept";
}

// Forces whose far fields add up miss; those that cancel do not.
TEST(FmmCheck, LowersTheOrderAgainWhenChecksAllowIt) {
  const PointForces random = with_forces(make_tube(300), 1e-5, 12);
  const PointForces aligned = align(random);
  const FmmOptions options = make_options_that_miss(4e-3, 0.1);
  FmmMobility fmm(viscosity, options);
  const Vectors velocity("velocity", random.position.size()), exact("exact", random.position.size());
  const auto evaluate = [&](const PointForces& from) {
    const Sources sources = on_device(from);
    Kokkos::deep_copy(velocity, 0.0);
    Kokkos::deep_copy(exact, 0.0);
    fmm.add_velocity(sources, sources.position, velocity);
    DirectMobility(viscosity, Precision::in_double).add_velocity(sources, sources.position, exact);
    return error_of(to_host(velocity), to_host(exact));
  };
  EXPECT_LT(evaluate(aligned), options.tolerance);
  ASSERT_GE(fmm.error_record().n_misses, 1);
  const int raised = fmm.error_record().order;
  ASSERT_GT(raised, 4);
  // A lower order is tried now and then, in vain, and ever more seldom.
  for (int i = 0; i < 30; ++i) EXPECT_LT(evaluate(aligned), options.tolerance);
  EXPECT_EQ(fmm.error_record().order, raised);
  EXPECT_EQ(fmm.error_record().n_misses, fmm.take_messages().size());
  const auto n_checks = fmm.error_record().n_checks;
  while (fmm.error_record().order > 4 && fmm.error_record().n_checks < n_checks + 200)
    EXPECT_LT(evaluate(random), options.tolerance);
  EXPECT_EQ(fmm.error_record().order, 4);
  EXPECT_EQ(fmm.take_messages().size(), static_cast<std::size_t>(raised - 4)) << "one for every order";
  // And up again at the next miss.
  EXPECT_LT(evaluate(aligned), options.tolerance);
  EXPECT_EQ(fmm.error_record().order, raised);
}

// A checkpoint holds what a miss has changed and when a lower order is tried next: the run that goes on from it chooses
// as the one that was not interrupted.
TEST(FmmCheck, GoesOnFromACheckpointBetweenAMissAndALowerOrder) {
  const PointForces random = with_forces(make_tube(300), 1e-5, 12);
  PointForces aligned = random;
  aligned.force.assign(aligned.force.size(), {1.0, 0.3, -0.2});
  FmmOptions options;
  options.tolerance = 4e-3;
  options.order = 4;
  options.leaf_size = 30;
  options.singular_cutoff = 0.1;  // cut far too short, until the order is raised
  options.check_every = 3;
  const auto evaluate = [](FmmMobility& fmm, const PointForces& from) {
    const Sources sources = on_device(from);
    const Vectors velocity("velocity", from.position.size());
    fmm.add_velocity(sources, sources.position, velocity);
    return to_host(velocity);
  };
  FmmMobility unbroken(viscosity, options);
  evaluate(unbroken, aligned);
  ASSERT_GE(unbroken.error_record().n_misses, 1);
  const int raised = unbroken.error_record().order;
  for (int i = 0; i < 10; ++i) evaluate(unbroken, random);
  MemorySnapshot checkpoint;
  checkpoint.take(unbroken);
  FmmMobility resumed(viscosity, options);
  checkpoint.bring_back(resumed);
  bool is_lower = false;
  for (int i = 0; i < 120; ++i) {
    const auto velocity = evaluate(unbroken, random);
    EXPECT_EQ(evaluate(resumed, random), velocity) << i;
    EXPECT_EQ(resumed.error_record().order, unbroken.error_record().order) << i;
    EXPECT_EQ(resumed.error_record().n_checks, unbroken.error_record().n_checks) << i;
    is_lower |= unbroken.error_record().order < raised;
  }
  EXPECT_TRUE(is_lower) << "nothing was lowered, so that nothing was compared";
}

}  // namespace
}  // namespace skein
