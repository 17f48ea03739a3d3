#include "runs/evaluation_time.hpp"

#include <skein/core/stopwatch.hpp>
#include <skein/dynamics/spectral_radius_at.hpp>
#include <skein/fibers/fiber.hpp>
#include <skein/physics/direct_mobility.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace skein {

double time_calls(const std::function<void()>& call) {
  std::vector<double> seconds;
  for (int repeat = 0; repeat < 6; ++repeat) {
    const auto start = WallClock::now();
    call();
    Kokkos::fence();
    const double last = seconds_since(start);
    const bool is_long = last > 1.0;  // a rough figure will do
    if (repeat > 0 || is_long) seconds.push_back(last);
    if (is_long) break;
  }
  std::nth_element(seconds.begin(), seconds.begin() + seconds.size() / 2, seconds.end());
  return seconds[seconds.size() / 2];
}

double find_spectral_radius(const SceneConfig& scene, FiberDynamics& dynamics, const double time,
                            const ConstVectors& position) {
  const PowerIterationLimits& limits = scene.time.method == TimeMethod::euler ? exact_radius : rough_radius;
  return find_spectral_radius_at(dynamics.physics(), dynamics, time, position, scene.seed, limits);
}

EvaluationCost time_evaluation(FiberDynamics& dynamics, const ConstVectors& position) {
  const Vectors velocity("skein::time_evaluation", position.extent(0));
  EvaluationCost cost;
  cost.seconds = time_calls([&] { dynamics.compute_velocity(0.0, position, velocity); });
  const Physics& physics = dynamics.physics();
  const double gain = physics.symmetry == nullptr ? 1.0 : physics.symmetry->orbits().gain();
  if (physics.mobility->error_record().n_approximate > 0)
    cost.direct_seconds = time_direct_sum(position, physics.viscosity) / gain;
  return cost;
}

double time_direct_sum(const ConstVectors& position, const double viscosity) {
  const std::size_t n = std::min<std::size_t>(position.extent(0), 4096);
  const Vectors some("skein::time_direct_sum::position", n), force("skein::time_direct_sum::force", n),
      velocity("skein::time_direct_sum::velocity", n);
  const Scalars blob("skein::time_direct_sum::blob", n);
  Kokkos::deep_copy(some, Kokkos::subview(position, std::make_pair(std::size_t{0}, n), Kokkos::ALL()));
  Kokkos::deep_copy(force, 1.0);
  Kokkos::deep_copy(blob, 1.0);
  DirectMobility direct(viscosity, Precision::in_double);
  double seconds = std::numeric_limits<double>::infinity();
  for (int repeat = 0; repeat < 3; ++repeat) {
    const auto start = WallClock::now();
    direct.add_velocity({some, force, blob}, some, velocity);
    Kokkos::fence();
    seconds = std::min(seconds, seconds_since(start));
  }
  const double ratio = static_cast<double>(position.extent(0)) / static_cast<double>(n);
  return seconds * ratio * ratio;
}

}  // namespace skein
